// Memory that decoding a file takes, and how many rows to decode at once.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "exr/file.h"

namespace gloam {

/// Of planes with so many rows, of all views.
uint64_t plane_bytes(const ExrFile& file, const std::vector<std::string>& planes, int rows);

/// What the decoder holds beside these planes, of the part that takes most.
uint64_t decoder_bytes(const ExrFile& file, const std::vector<std::string>& planes);

/// So many that no chunk is decoded much more than once, and that all planes take some 4 MiB; more where that is in one chunk.
int rows_at_once(const ExrFile& file, const std::vector<std::string>& planes);

}  // namespace gloam
