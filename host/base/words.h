// Words: in small letters, and those that stand for values, as flags and arguments take them.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gloam {

/// A text in small letters, of ASCII alone.
std::string lower(std::string_view text);

/// A character of UTF-8.
struct Character {
  char32_t code;
  size_t length;  ///< bytes
};

/// The character that a text begins with, which is not empty; U+FFFD for a byte that begins none.
Character first_character(std::string_view text);

/// A text in which each byte that has no place in one line of a terminal is replaced: control characters (line ends too), characters that
/// change the direction of text, and bytes that are not UTF-8.
std::string without_unprintables(std::string_view text, const std::function<std::string(unsigned char)>& shown);

/// The same, with \xNN for each of these bytes.
std::string on_one_line(std::string_view text);

/// A text of at most `most` bytes: of a longer one the beginning and the end, and how many are left out between.
std::string shortened(std::string_view text, size_t most);

/// Words and the values that they stand for.
template <typename Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// Throws UsageError for a word that is not allowed. `flag`: what it was given for, for the message.
[[noreturn]] void refuse_word(const std::string& word, const std::string& flag, const std::vector<std::string>& words);

template <typename Value>
std::vector<std::string> words_of(const Choices<Value>& choices) {
  std::vector<std::string> words;
  for (const auto& [word, value] : choices) words.push_back(word);
  return words;
}

template <typename Value>
Value value_of(const std::string& word, const std::string& flag, const Choices<Value>& choices) {
  for (const auto& [name, value] : choices) {
    if (name == word) return value;
  }
  refuse_word(word, flag, words_of(choices));
}

template <typename Value>
std::string word_for(const Value& value, const Choices<Value>& choices) {
  for (const auto& [name, known] : choices) {
    if (known == value) return name;
  }
  return "";
}

}  // namespace gloam
