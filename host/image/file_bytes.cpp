#include "image/file_bytes.h"

#include <system_error>

#include "base/files.h"
#include "gloam/error.h"

namespace gloam {
namespace {
/// Four doubles, and a header: no image takes more.
constexpr unsigned long long most_bytes_per_pixel = 32, most_bytes_of_header = 1 << 20;
}  // namespace

std::string bytes_of_image(const std::filesystem::path& file, long long most_pixels) {
  std::error_code unknown;
  const auto size = std::filesystem::file_size(file, unknown);
  if (!unknown && size / most_bytes_per_pixel > (unsigned long long)most_pixels + most_bytes_of_header)
    throw Error("{}: has {} bytes, more than an image of {} pixels", file.string(), size, most_pixels);
  return read_text(file);
}

}  // namespace gloam
