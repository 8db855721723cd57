#include "base/command_line.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/words.h"
#include "gloam/error.h"

namespace gloam {
namespace {

bool is_of_system(const std::string& path) {
  return path.starts_with("/usr/") || path.starts_with("/bin/") || path.starts_with("/dev/");
}

/// Of an absolute path the last folder and the name; of the system's own, which others have as well, all.
std::string without_folders(const std::string& word) {
  if (word.empty() || word.front() != '/' || is_of_system(word)) return word;
  const std::filesystem::path path = (std::filesystem::path(word) / "").lexically_normal().parent_path();
  return (path.parent_path().filename() / path.filename()).generic_string();
}

}  // namespace

std::string command_without_folders(const std::string& command) {
  std::string made;
  for (size_t at = 0; at < command.size();) {
    const size_t end = std::min(command.find_first_of(" '\"=", at), command.size());
    made += without_folders(command.substr(at, end - at));
    if (end < command.size()) made += command[end];
    at = end + 1;
  }
  return made;
}

namespace {

std::string argument_without_folders(const std::string& word, const std::string& before) {
  const std::string of_command = "--command";
  if (before == of_command || word.starts_with(of_command + "=")) return command_without_folders(word);
  const size_t equals = word.starts_with("--") ? word.find('=') : std::string::npos;
  if (equals == std::string::npos) return without_folders(word);
  return word.substr(0, equals + 1) + without_folders(word.substr(equals + 1));
}

}  // namespace

std::vector<std::string> command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  std::string before;
  for (std::string word; std::getline(file, word, '\0');) {
    words.push_back(argument_without_folders(word, before));
    before = word;
  }
  if (!words.empty()) words.front() = std::filesystem::path(words.front()).filename().string();
  return words;
}

namespace {

/// A word as every POSIX shell makes it, of printable characters alone. Line ends at its end are lost: such a file is not found.
std::string made_by_printf(const std::string& word) {
  std::string format = word.starts_with("-") ? "\\055" : "";  // no option of printf
  for (const char c : word.substr(format.empty() ? 0 : 1))
    format += c == '%' ? "%%" : c == '\\' ? "\\\\" : c == '\'' ? "\\047" : std::string(1, c);
  return "\"$(printf '" +
         without_unprintables(format, [](unsigned char byte) { return fmt::format("\\{:03o}", byte); }) + "')\"";
}

}  // namespace

std::string quoted_for_shell(const std::string& word) {
  if (on_one_line(word) != word) return made_by_printf(word);
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
