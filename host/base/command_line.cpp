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

std::string quoted_for_shell(const std::string& word) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + quoted_for_shell(word);
  return line;
}

}  // namespace gloam
