#include "exr/errors.h"

#include <algorithm>

namespace gloam {
namespace {

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::replace(text.begin(), text.end(), '\r', ' ');
  return text;
}

}  // namespace

std::string cause(const std::exception& error, const std::filesystem::path& path) {
  const std::string text = one_line(error.what()), quoted = '"' + path.string() + "\". ";
  const size_t at = text.find(quoted);
  return at == std::string::npos ? text : text.substr(at + quoted.size());
}

}  // namespace gloam
