// Chunks that hold all that their rows need: OpenEXR takes what is missing from memory that it used before, and does not complain.
#pragma once

#include <OpenEXR/ImfInputPart.h>

#include <cstdint>

#include "exr/file.h"

namespace gloam {

/// Throws std::runtime_error, as OpenEXR does for damage, if a chunk with rows of [first, last) holds less than these. For the compressions whose chunks have any size: none, RLE,
/// ZIP and ZIPS; the others complain by themselves.
void check_whole_chunks(Imf::InputPart& input, int64_t first, int64_t last);

/// The same for a tiled part: its tiles at full resolution in rows of tiles from `first` to `last`, both included.
void check_whole_tiles(const ExrFile& file, int part, int64_t first, int64_t last);

}  // namespace gloam
