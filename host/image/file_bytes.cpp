#include "image/file_bytes.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "base/file_ledger.h"
#include "base/files.h"
#include "gloam/error.h"

namespace gloam {
namespace {
/// Four doubles, and a header: no image takes more.
constexpr unsigned long long most_bytes_per_pixel = 32, most_bytes_of_header = 1 << 20;
}  // namespace

std::string bytes_of_image(const std::filesystem::path& file, long long most_pixels) {
  check_regular(file);
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream) throw Error("{}: cannot read: {}", file.string(), std::strerror(errno));
  opens_file(file);
  const auto size = (unsigned long long)stream.tellg();
  if (size / most_bytes_per_pixel > (unsigned long long)most_pixels + most_bytes_of_header)
    throw Error("{}: has {} bytes, more than an image of {} pixels", file.string(), size, most_pixels);
  std::string bytes(size, '\0');
  stream.seekg(0);
  if (size > 0 && !stream.read(bytes.data(), std::streamsize(size)))
    throw Error("{}: cannot read: {}", file.string(), std::strerror(errno));
  return bytes;
}

}  // namespace gloam
