#include "normalise/normal_axes.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "gloam/error.h"

namespace gloam {
namespace {

double det(const NormalAxes& axes) {
  glm::dmat3 m(0.0);
  for (int i : {0, 1, 2}) m[i][std::abs(axes[size_t(i)]) - 1] = axes[size_t(i)] < 0 ? -1 : 1;
  return glm::determinant(m);
}

}  // namespace

double departure_of(const NormalAxes& axes) {
  double flips = 0, moves = 0;
  for (size_t i = 0; i < 3; ++i) flips += axes[i] < 0, moves += std::abs(axes[i]) != plain_axes[i];
  return flips + 2 * moves + (moves > 0 && det(axes) < 0 ? 0.5 : 0);
}

const std::vector<NormalAxes>& all_axes() {
  static const std::vector<NormalAxes> all = [] {
    std::vector<NormalAxes> found;
    NormalAxes order = plain_axes;
    do {
      for (int signs = 0; signs < 8; ++signs) {
        NormalAxes axes = order;
        for (size_t i = 0; i < 3; ++i)
          if (signs >> i & 1) axes[i] = -axes[i];
        found.push_back(axes);
      }
    } while (std::next_permutation(order.begin(), order.end()));
    return found;
  }();
  return all;
}

std::string in_words(const NormalAxes& axes) {
  std::string words;
  for (const int axis : axes)
    words += fmt::format("{}{}{}", words.empty() ? "" : ",", axis < 0 ? "-" : "", " xyz"[std::abs(axis)]);
  return words;
}

std::optional<NormalAxes> parse_normal_axes(const std::string& text, const std::string& flag) {
  if (text == "auto") return {};
  for (const NormalAxes& axes : all_axes())
    if (text == in_words(axes)) return axes;
  throw UsageError("{} {}: is not allowed; 'auto' is, or the axis of each component, such as x,-y,z", flag, text);
}

}  // namespace gloam
