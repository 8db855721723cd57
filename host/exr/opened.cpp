#include "exr/opened.h"

#include <utility>

#include "exr/validation.h"

namespace gloam {

OpenedExr open_parts(std::unique_ptr<ExrInput> stream, const std::filesystem::path& path, long long most_pixels) {
  OpenedExr opened;
  opened.end_of_headers = check_headers(path, *stream, most_pixels);
  opened.parts = std::make_unique<Imf::MultiPartInputFile>(*stream);
  opened.stream = std::move(stream);
  return opened;
}

}  // namespace gloam
