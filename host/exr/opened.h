// An EXR file whose headers are checked before OpenEXR believes them.
#pragma once

#include <OpenEXR/ImfMultiPartInputFile.h>

#include <cstdint>
#include <filesystem>
#include <memory>

#include "exr/stream.h"

namespace gloam {

struct OpenedExr {
  std::unique_ptr<ExrInput> stream;
  std::unique_ptr<Imf::MultiPartInputFile> parts;
  uint64_t end_of_headers = 0;  ///< bytes from the start
};

/// Throws Error naming the file, as `check_headers` does, and what OpenEXR throws: call it in `guarded` (errors.h).
OpenedExr open_parts(std::unique_ptr<ExrInput> stream, const std::filesystem::path& path, long long most_pixels);

}  // namespace gloam
