// Memory for decoding a file, and the number of rows to decode at once.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "exr/file.h"

namespace gloam {

/// Bytes of the planes of all views, with `rows` rows.
uint64_t plane_bytes(const ExrFile& file, const std::vector<std::string>& planes, int rows);

/// Bytes that the decoder needs besides these planes, for the part that needs most.
uint64_t decoder_bytes(const ExrFile& file, const std::vector<std::string>& planes);

/// Number of rows for which no chunk is decoded much more than once and all planes take about 4 MiB, or more if one chunk does.
int rows_at_once(const ExrFile& file, const std::vector<std::string>& planes);

}  // namespace gloam
