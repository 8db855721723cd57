#include "base/words.h"

#include "gloam/error.h"

namespace gloam {

void refuse_word(const std::string& word, const std::string& flag, const std::vector<std::string>& words) {
  throw UsageError("{} {} is not allowed{}; {} are", flag, word, suggestion(word, words), enumerate(words));
}

}  // namespace gloam
