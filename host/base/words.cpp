#include "base/words.h"

#include <cctype>

#include "gloam/error.h"

namespace gloam {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = char(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

void refuse_word(const std::string& word, const std::string& flag, const std::vector<std::string>& words) {
  throw UsageError("{} {} is not allowed{}; {} are", flag, word, suggestion(word, words), enumerate(words));
}

}  // namespace gloam
