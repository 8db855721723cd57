#include "base/command_line.h"

#include <filesystem>
#include <fstream>

namespace gloam {
namespace {

std::string without_folders(const std::string& word) {
  if (word.empty() || word.front() != '/') return word;
  const std::filesystem::path path = (std::filesystem::path(word) / "").lexically_normal().parent_path();
  return (path.parent_path().filename() / path.filename()).generic_string();
}

}  // namespace

std::vector<std::string> command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(without_folders(word));
  if (!words.empty()) words.front() = std::filesystem::path(words.front()).filename().string();
  return words;
}

}  // namespace gloam
