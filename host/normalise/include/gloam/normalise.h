// Normalisation: every frame is brought to one convention, whether read from a file or made in memory.
#pragma once

#include <optional>

#include "gloam/frame.h"

namespace gloam {

/// Depth that is NaN, infinite, zero, negative, equal to a known `far`, or `background` (without it, 1e10 or more) becomes +inf;
/// normals become unit, or zero where they are NaN, infinite, zero or on background; padding is set to each plane's `outside`
/// value. Notes on values of color and albedo that are no light go to `Frame::assumed`. Frames from `FrameFile::read` and `frame_from` are normalised; other frames need it before `run`.
void normalise(Frame& frame, std::optional<float> background = {});

}  // namespace gloam
