// Checks of EXR headers, before memory is allocated for sizes that they may overstate.
#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <cstdint>
#include <filesystem>

#include "exr/box.h"
#include "exr/stream.h"

namespace gloam {

/// Throws Error naming the file for a window that is empty, overflows or has more than `most_pixels` pixels.
void check_size(const std::filesystem::path& path, const Box& box, const char* what, long long most_pixels);

/// Checks the attributes and windows of all headers before OpenEXR allocates memory for them. OpenEXR itself refuses headers that
/// cannot be parsed. Returns where the headers end and the tables of chunks begin.
uint64_t check_headers(const std::filesystem::path& path, ExrInput& stream, long long most_pixels);

/// Whether a part has many samples per pixel.
bool is_deep(const Imf::Header& header);

/// Throws Error for a file of deep parts alone, and for windows that `check_size` refuses.
void check_parts(const std::filesystem::path& path, const Imf::MultiPartInputFile& file, long long most_pixels);

/// Throws Error for a part whose header overstates its size: a file of `file_size` bytes cannot hold so many pixels.
void check_plausible(const std::filesystem::path& path, const Imf::Header& header, uint64_t file_size);

}  // namespace gloam
