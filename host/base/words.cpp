#include "base/words.h"

#include <algorithm>
#include <cctype>

#include "gloam/error.h"

namespace gloam {
namespace {

constexpr char32_t no_character = 0xfffd;

/// Length of the character that `text` begins with, bytes; 0 for one that does not stay in its line and for what is no character.
size_t printable_length(std::string_view text) {
  const auto [code, length] = first_character(text);
  const bool control = code < 0x20 || (code >= 0x7f && code < 0xa0), line_end = code == 0x2028 || code == 0x2029;
  const bool turns_text = (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  const bool invalid = code == no_character && length == 1;
  return invalid || control || line_end || turns_text ? 0 : length;
}

/// Whether a byte goes on a character of UTF-8 that others began.
bool goes_on(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

}  // namespace

Character first_character(std::string_view text) {
  const auto byte = [&](size_t i) { return i < text.size() ? unsigned(static_cast<unsigned char>(text[i])) : 0u; };
  const unsigned first = byte(0);
  if (first < 0x80) return {first, 1};
  const size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  char32_t code = first & (0x7fu >> length);
  for (size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {no_character, 1};
    code = code << 6 | (byte(i) & 0x3f);
  }
  constexpr char32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool known = first >= 0xc2 && first < 0xf5 && code >= smallest[length] && code <= 0x10ffff;
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  return known && !surrogate ? Character{code, length} : Character{no_character, 1};
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = char(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::string without_unprintables(std::string_view text, const std::function<std::string(unsigned char)>& shown) {
  std::string result;
  while (!text.empty()) {
    const size_t length = printable_length(text);
    if (length == 0)
      result += shown(static_cast<unsigned char>(text.front()));
    else
      result += text.substr(0, length);
    text.remove_prefix(std::max<size_t>(length, 1));
  }
  return result;
}

std::string on_one_line(std::string_view text) {
  return without_unprintables(text, [](unsigned char byte) { return fmt::format("\\x{:02x}", byte); });
}

std::string shortened(std::string_view text, size_t most) {
  if (text.size() <= most) return std::string(text);
  constexpr size_t room = 60;  // for the words between
  const size_t kept = most > room ? most - room : 0;
  size_t head = kept - kept / 4, tail = text.size() - kept / 4;
  while (head > 0 && goes_on(text[head])) --head;
  while (tail < text.size() && goes_on(text[tail])) ++tail;
  return fmt::format("{} ... ({} bytes left out) ... {}", text.substr(0, head), tail - head, text.substr(tail));
}

void refuse_word(const std::string& word, const std::string& flag, const std::vector<std::string>& words) {
  throw UsageError("{} {} is not allowed{}; {} are", flag, word, suggestion(word, words), enumerate(words));
}

}  // namespace gloam
