#include "exr/holdings.h"

#include <algorithm>

#include "gloam/error.h"

namespace gloam {

std::string first_names(std::vector<std::string> names) {
  const size_t most = 16;
  const std::string rest = names.size() > most ? fmt::format(" and {} more", names.size() - most) : "";
  names.resize(std::min(names.size(), most));
  return fmt::format("{}{}", fmt::join(names, ", "), rest);
}

std::string holdings(const FrameFile& file) {
  const std::vector<std::string> names = file.all_channels();
  const std::string name = file.path().filename().string();
  return names.empty() ? name + " has no channels" : fmt::format("{} has only {}", name, first_names(names));
}

std::string holdings(const FrameFiles& files) {
  std::vector<std::string> words;
  for (const FrameFile& file : files.files()) words.push_back(holdings(file));
  return enumerate(words);
}

}  // namespace gloam
