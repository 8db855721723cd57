// From an EXR part to channels of floats: all rows of a frame, or some of them.
#pragma once

#include <OpenEXR/ImfMultiPartInputFile.h>

#include <map>
#include <string>
#include <vector>

#include "exr/box.h"
#include "gloam/frame.h"

namespace gloam {

/// Where one channel of the file goes: the first is decoded into, the rest are copies (a part that views share).
struct Decoding {
  std::vector<Channel*> targets;
  float outside = 0;
};
using PartDecoding = std::map<std::string, Decoding>;  // by channel name

/// Throws Error for a channel that has not a value for every pixel.
void check_sampling(const Imf::Header& header, const PartDecoding& decoding);

/// Decodes what of a part lies in `window`, which all targets cover: as wide as the part's data window or wider, of any rows. What
/// the data window leaves out is set to `outside`.
void decode_part(Imf::MultiPartInputFile& file, int part, PartDecoding& decoding, const Window& window);

/// NaN and infinite values of a channel that covers `window`, inside the data window: the rest is not in the file.
long long count_nonfinite(const Channel& channel, const Box& data, const Window& window);

}  // namespace gloam
