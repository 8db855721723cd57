// Chunks of an EXR part: the rows, or the tile, that are compressed as one block.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <cstdint>

namespace gloam {

/// Over all channels of the part, before compression.
int64_t bytes_per_pixel(const Imf::Header& header);

int64_t pixels_per_chunk(const Imf::Header& header);
int64_t rows_per_chunk(const Imf::Header& header);

/// Memory that OpenEXR needs besides the frame to decode a part: compressed and decompressed chunks, two for each thread.
uint64_t decoder_bytes(const Imf::Header& header);

}  // namespace gloam
