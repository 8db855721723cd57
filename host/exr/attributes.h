// The attributes of EXR headers, looked at before OpenEXR reads them.
#pragma once

#include <filesystem>

#include "exr/stream.h"

namespace gloam {

/// OpenEXR makes room for what an attribute claims before it reads it, and reads types that it knows by their own size,
/// whatever the file says, so that the next attribute may be any bytes. Goes through the headers from where the stream
/// stands, and back there. Throws Error naming the file and the attribute for one that claims more than the file has or
/// other than its type takes, and what the stream throws at its end.
void check_attributes(const std::filesystem::path& path, ExrInput& stream, bool is_multipart);

}  // namespace gloam
