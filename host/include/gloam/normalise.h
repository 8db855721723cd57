// Normalisation: every frame is brought to one convention, whether read from a file or made in memory.
#pragma once

#include <optional>

#include "gloam/frame.h"

namespace gloam {

/// Depth that is NaN, infinite, zero, negative, equal to a known `far`, or `background` (where given, else 1e10 and more)
/// becomes +inf; normals become unit, or zero where they are NaN, infinite, zero or on background; padding is set to each
/// plane's `outside` value. Frames that are read are normalised already; frames that are made in memory have to be before
/// `run`.
void normalise(Frame& frame, std::optional<float> background = {});

}  // namespace gloam
