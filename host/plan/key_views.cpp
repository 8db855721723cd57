#include "plan/key_views.h"

#include <algorithm>
#include <cstdlib>

namespace gloam {
namespace {

std::vector<int> key_views(int count, int spacing) {
  std::vector<int> keys;
  for (int i = std::min(spacing / 2, count - 1); i < count; i += spacing) keys.push_back(i);
  if (count - 1 - keys.back() > spacing / 2) keys.push_back(count - 1);
  return keys;
}

}  // namespace

std::vector<KeyViewRole> key_view_roles(int count, int spacing) {
  std::vector<KeyViewRole> roles(static_cast<size_t>(count));
  const std::vector<int> keys = key_views(count, spacing);
  for (int i = 0; i < count; ++i) {
    KeyViewRole& role = roles[size_t(i)];
    const auto after = std::lower_bound(keys.begin(), keys.end(), i);
    role.is_key = after != keys.end() && *after == i;
    if (role.is_key) continue;
    const int right = after == keys.end() ? keys.back() : *after, left = after == keys.begin() ? right : *(after - 1);
    const bool is_right_nearer = right > i && right - i < std::abs(i - left);
    role.nearest = is_right_nearer ? right : left;
    role.far = is_right_nearer ? left : right;
  }
  return roles;
}

}  // namespace gloam
