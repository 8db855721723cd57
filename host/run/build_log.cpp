#include "run/build_log.h"

#include <fmt/format.h>

#include <regex>
#include <sstream>

#include "base/files.h"
#include "gloam/error.h"
#include "run/kept_folders.h"

namespace gloam {
namespace {

constexpr size_t longest_line = 300, shortest_error = 60;

std::string cut(const std::string& text, size_t most) {
  return text.size() <= most ? text : text.substr(0, most - 3) + "...";
}

/// The file that now holds the log; empty where it cannot be written.
std::string written(const std::string& kernel, const std::string& text) {
  if (cache_folder().folder.empty()) return "";
  const std::filesystem::path folder = cache_folder().folder / "build-logs", file = folder / (kernel + ".log");
  std::error_code ignored;
  std::filesystem::create_directories(folder, ignored);
  make_way(file);
  try {
    write_atomically(
        file, [&](NewFile& out) { out.append(text); }, FileFor::cache);
  } catch (const Error&) {  // the line is told without it
    return "";
  }
  return file.string();
}

}  // namespace

std::string first_error(const std::string& log) {
  // "gtao/gtao.cl:12:5: error: what", as clang has it; PoCL and others put words before it.
  static const std::regex clang(R"(([^\s:"]+):(\d+)(:\d+)?:\s*(fatal )?error:\s*(.*))", std::regex::icase);
  static const std::regex any(R"(\berror\b)", std::regex::icase);
  std::istringstream lines(log);
  std::string first, with_error;
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    line = line.substr(0, 2000);  // std::regex recurses once for each character
    if (std::regex_search(line, found, clang))
      return fmt::format("{}:{}: {}", found.str(1), found.str(2), found.str(5));
    if (with_error.empty() && std::regex_search(line, any)) with_error = line;
    if (first.empty() && line.find_first_not_of(" \t\r") != std::string::npos) first = line;
  }
  return !with_error.empty() ? with_error : !first.empty() ? first : "the compiler says nothing";
}

std::string build_failure(const std::string& device, const std::string& kernel, const std::string& options,
                          const std::string& log) {
  const std::string start = fmt::format("'{}': kernel {} does not build: ", cut(device, 80), kernel);
  const std::string file = written(kernel, fmt::format("{}\n{}\n{}\n", device, options, log));
  std::string end = file.empty() ? "" : fmt::format("; whole log: {}", file);
  if (start.size() + shortest_error + end.size() > longest_line)
    end = "; whole log: see build-logs in the cache folder";
  return start +
         cut(first_error(log), longest_line - std::min(longest_line - shortest_error, start.size() + end.size())) + end;
}

}  // namespace gloam
