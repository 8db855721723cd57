#include "picture/picture_path.h"

#include <fmt/format.h>

#include <cctype>

namespace gloam {
namespace {

/// A view's name comes from a file. Characters that mean a folder in a path or a command on a terminal, or that a file system does
/// not accept, are written as their numbers, so that no two views share a name.
std::string as_file_name(const std::string& view) {
  std::string name;
  for (const char c : view) {
    const unsigned char byte = static_cast<unsigned char>(c);
    const bool is_plain = std::isalnum(byte) || byte >= 0x80 || c == '_' || c == '-' || c == '.' || c == ' ';
    name += is_plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return name;
}

}  // namespace

std::filesystem::path picture_path(const std::string& path, const std::string& view, bool several) {
  if (!several) return path;
  std::filesystem::path with_view = path;
  return with_view.replace_extension(as_file_name(view) + std::filesystem::path(path).extension().string());
}

}  // namespace gloam
