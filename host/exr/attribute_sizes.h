// Sizes that the attributes of EXR headers state, checked before OpenEXR reads them.
#pragma once

#include <filesystem>

#include "exr/stream.h"

namespace gloam {

/// OpenEXR allocates what an attribute states as its size before OpenEXR reads it, and reads types that it knows by their own
/// size, whatever the file states, so that the next attribute may be any bytes. Goes through the headers from where the stream
/// stands, and back there. Throws Error naming the file and the attribute for a size that is larger than the file or not that of
/// the attribute's type, and what the stream throws at its end.
void check_attribute_sizes(const std::filesystem::path& path, ExrInput& stream, bool is_multipart);

}  // namespace gloam
