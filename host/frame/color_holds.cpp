#include "gloam/color_holds.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/words.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {
namespace {

constexpr const char* nothing = "none";

const Choices<bool ColorHolds::*>& parts() {
  static const Choices<bool ColorHolds::*> all = {{"ambient", &ColorHolds::ambient},
                                                  {"shadows", &ColorHolds::shadows},
                                                  {"ao", &ColorHolds::ao},
                                                  {"indirect", &ColorHolds::indirect},
                                                  {"reflection", &ColorHolds::reflection}};
  return all;
}

[[noreturn]] void refuse(const std::string& item, const std::string& text, const std::string& what) {
  const std::vector<std::string> words = words_of(parts());
  throw UsageError("{} {}: '{}' is not known{}; a list of {} is allowed, or {}", what, text, item,
                   suggestion(item, words), enumerate(words), nothing);
}

/// The text between commas, without spaces around.
std::vector<std::string> items_of(const std::string& text) {
  std::vector<std::string> items(1);
  for (const char c : text) {
    if (c == ',') items.emplace_back();
    if (c != ',' && c != ' ') items.back() += c;
  }
  return items;
}

}  // namespace

ColorHolds parse_color_holds(const std::string& text, const std::string& what) {
  ColorHolds holds{false, false, false, false, false};
  if (text == nothing) return holds;
  for (const std::string& item : items_of(text)) {
    const auto known =
        std::find_if(parts().begin(), parts().end(), [&](const auto& part) { return part.first == item; });
    if (known == parts().end()) refuse(item, text, what);
    holds.*known->second = true;
  }
  if (holds.ao && !holds.ambient)
    throw UsageError("{} {}: ao is occlusion of ambient light; write ambient too", what, text);
  return holds;
}

std::string in_words(const ColorHolds& holds) {
  std::vector<std::string> words;
  for (const auto& [word, member] : parts()) {
    if (holds.*member) words.push_back(word);
  }
  return words.empty() ? nothing : fmt::format("{}", fmt::join(words, ","));
}

std::string note_on_assumed_holds() {
  return fmt::format("color: what it holds beside direct light is not stated ({}); taken as {} ({})",
                     color_holds_attribute, in_words(ColorHolds()), option("color-holds", "LIST"));
}

}  // namespace gloam
