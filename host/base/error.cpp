#include "gloam/error.h"

#include <algorithm>
#include <cctype>
#include <tuple>

#include "base/words.h"

namespace gloam {
namespace {

char lower(char c) { return char(std::tolower(static_cast<unsigned char>(c))); }

/// Number of letters left out, added, replaced or swapped with their neighbour (optimal string alignment), without regard to case.
size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<size_t>> d(a.size() + 1, std::vector<size_t>(b.size() + 1));
  const auto same = [&](size_t i, size_t j) { return lower(a[i - 1]) == lower(b[j - 1]); };
  for (size_t i = 0; i <= a.size(); ++i) {
    for (size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same(i, j) ? 0 : 1)});
      if (i > 1 && j > 1 && same(i, j - 1) && same(i - 1, j)) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::string_view without_dashes(std::string_view name) {
  return name.substr(std::min(name.find_first_not_of('-'), name.size()));
}

/// A name in lower case and without word separators; "plus" and "+" are the same: "HBAO_plus" and "hbao+".
std::string folded(std::string_view name) {
  std::string text;
  for (const char c : name) {
    if (c != '-' && c != '_' && c != ' ' && c != '.') text += lower(c);
  }
  for (size_t at = text.find("plus"); at != std::string::npos && at > 0; at = text.find("plus", at + 1))
    text.replace(at, 4, "+");
  return text;
}

bool abbreviates(std::string_view name, std::string_view candidate) {
  const std::string_view start = without_dashes(name), whole = without_dashes(candidate);
  return start.size() >= 2 && start.size() < whole.size() &&
         std::equal(start.begin(), start.end(), whole.begin(), [](char a, char b) { return lower(a) == lower(b); });
}

}  // namespace

std::string printable(std::string_view text) {
  constexpr size_t longest_line = 4000;  ///< bytes; names and values come from files of anybody
  return shortened(on_one_line(text), longest_line);
}

std::string suggestion(std::string_view name, const std::vector<std::string>& candidates) {
  constexpr size_t longest_name =
      100;  // nothing that has a name here is longer, and a distance takes the product of the lengths
  if (name.size() > longest_name) return "";
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || (c & 0x80) != 0; };
  if (std::none_of(name.begin(), name.end(), is_letter)) return "";
  // Up to a third of the letters wrong, or two swapped, counts as a typing error; an abbreviation counts as one error.
  const size_t letters = without_dashes(name).size(), farthest = letters <= 3 ? 1 : std::max<size_t>(2, letters / 3);
  const std::string plain = folded(name);
  std::tuple<size_t, bool, size_t> best = {farthest + 1, false, 0};
  const std::string* nearest = nullptr;
  for (const std::string& candidate : candidates) {
    const size_t distance = std::min(edit_distance(name, candidate), edit_distance(plain, folded(candidate)));
    const bool cut_short = abbreviates(name, candidate);
    const std::tuple key(cut_short ? std::min<size_t>(distance, 1) : distance, !cut_short, distance);
    if (key >= best) continue;
    best = key;
    nearest = &candidate;
  }
  return nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : "";
}

std::string enumerate(const std::vector<std::string>& items) {
  std::string text;
  for (size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 == items.size() ? " and " : ", ";
    text += items[i];
  }
  return text;
}

}  // namespace gloam
