// Decodes an EXR part into channels of floats: all rows of a frame, or some of them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "exr/file.h"
#include "gloam/frame.h"

namespace gloam {

/// The targets of one channel of the file: it is decoded into the first and copied into the others (a part that views share).
struct Decoding {
  std::vector<Channel*> targets;
  float outside = 0;
};
using PartDecoding = std::map<std::string, Decoding>;  // by channel name

/// Throws Error for a channel without a value for every pixel.
void check_sampling(const Imf::Header& header, const PartDecoding& decoding);

/// Decodes the pixels of a part in `window`, which all targets cover. The window is at least as wide as the part's data window, and
/// has any rows. Pixels beyond the data window are set to `outside`.
void decode_part(const ExrFile& file, int part, PartDecoding& decoding, const Window& window);

/// Number of NaN and infinite values of a channel that covers `window`, inside the data window: the file has no others.
long long count_nonfinite(const Channel& channel, const Box& data, const Window& window);

}  // namespace gloam
