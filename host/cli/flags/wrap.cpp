#include "cli/flags/wrap.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace gloam::cli {
namespace {

constexpr size_t least_columns = 24;

std::optional<size_t> columns_of(int file) {
  winsize size{};
  if (!isatty(file) || ioctl(file, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return {};
  return size.ws_col;
}

}  // namespace

std::optional<size_t> line_width() {
  if (const char* columns = std::getenv("COLUMNS"))
    if (const int given = std::atoi(columns); given > 0) return given;
  const std::optional<size_t> own = columns_of(STDOUT_FILENO);
  return own ? own : columns_of(STDERR_FILENO);  // standard output may go through a pager
}

bool has_room_from(size_t column) {
  const std::optional<size_t> width = line_width();
  return !width || column + least_columns <= *width;
}

std::string wrapped(const std::string& text, size_t begin, size_t indent) {
  const std::optional<size_t> width = line_width();
  if (!width) return text;
  const size_t end = std::max(*width, indent + least_columns);
  std::string result;
  size_t column = begin;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const bool is_first = result.empty();
    if (!is_first && column + 1 + word.size() > end) {
      result += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!is_first) {
      result += " ";
      ++column;
    }
    result += word;
    column += word.size();
  }
  return result;
}

}  // namespace gloam::cli
