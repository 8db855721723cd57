// Colour and albedo of a file whose values are no light.
#pragma once

#include "exr/file.h"
#include "gloam/frame.h"
#include "normalise/radiance.h"

namespace gloam {

/// Adds notes on the values counted, and on a header that calls the colour of one of the frame's views other than linear.
void note_light(const ExrFile& file, const LightCounts& counts, Frame& frame);

}  // namespace gloam
