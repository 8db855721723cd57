// Sizes that the attributes of EXR headers state, checked before OpenEXR reads them.
#pragma once

#include <filesystem>

#include "exr/stream.h"

namespace gloam {

/// OpenEXR allocates memory of an attribute's stated size before it reads the attribute. It reads types that it knows by their own
/// size, whatever the file states, and then takes the wrong bytes for the next attribute. This function goes through the headers
/// from the stream's position, and returns the stream there. Returns where the headers end. Throws Error naming the file and the
/// attribute for a size that is larger than the file or does not match the attribute's type; throws the stream's error at the end of
/// the file.
uint64_t check_attribute_sizes(const std::filesystem::path& path, ExrInput& stream, bool is_multipart);

}  // namespace gloam
