// Rows compressed as ZIP or ZIPS, decoded in less than half the time that OpenEXR 3.1 takes.
#pragma once

#include <OpenEXR/ImfInputPart.h>

#include <cstdint>

#include "exr/decode.h"

namespace gloam {

/// Decodes rows [first, last) of a part, which lie in `window` and in the part's data window, on the threads of OpenEXR. False,
/// with the targets in any state, for what it does not know (another compression, tiles, subsampled or integer channels) and
/// for data that it cannot decode: OpenEXR then decodes them, or says what is wrong.
bool decode_zip_rows(Imf::InputPart& input, const PartDecoding& decoding, const Window& window, int64_t first,
                     int64_t last);

}  // namespace gloam
