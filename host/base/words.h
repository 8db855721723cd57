// Words: in small letters, and those that stand for values, as flags and arguments take them.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gloam {

/// A text in small letters, of ASCII alone.
std::string lower(std::string_view text);

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
