#include "gloam/error.h"

#include <algorithm>
#include <cctype>
#include <tuple>

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

/// Length of the UTF-8 character that `text` begins with, bytes; 0 for an invalid or a control character.
size_t printable_length(std::string_view text) {
  const auto byte = [&](size_t i) { return i < text.size() ? unsigned(static_cast<unsigned char>(text[i])) : 0u; };
  const unsigned first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7f;
  const size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  unsigned code = first & (0x7fu >> length);
  for (size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3f);
  }
  constexpr unsigned smallest[] = {0, 0, 0xa0, 0x800, 0x10000};  // U+0080 to U+009F are control characters too
  const bool known = first >= 0xc2 && first < 0xf5 && code >= smallest[length] && code <= 0x10ffff;
  const bool surrogate = code >= 0xd800 && code < 0xe000, line_end = code == 0x2028 || code == 0x2029;
  const bool turns_text = (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  return known && !surrogate && !line_end && !turns_text ? length : 0;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const size_t length = printable_length(text);
    if (length == 0)
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    else
      result += text.substr(0, length);
    text.remove_prefix(std::max<size_t>(length, 1));
  }
  return result;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& candidates) {
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
