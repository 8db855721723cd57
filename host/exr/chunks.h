// Chunks of an EXR part: the rows, or the tile, that are packed together and so are unpacked together.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <cstdint>

namespace gloam {

/// Of all channels of the part, before compression.
int64_t bytes_per_pixel(const Imf::Header& header);

int64_t pixels_per_chunk(const Imf::Header& header);
int64_t rows_per_chunk(const Imf::Header& header);

/// What OpenEXR holds beside the frame while OpenEXR decodes a part: chunks packed and unpacked, two for each thread.
uint64_t decoder_bytes(const Imf::Header& header);

}  // namespace gloam
