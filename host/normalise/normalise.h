// Normalisation of planes whose depth is planar view-space z already.
#pragma once

#include <optional>

#include "gloam/frame.h"
#include "gloam/normalise.h"

namespace gloam {

/// What `normalise` does, for a frame whose `depth` has already been through `to_view_depth`. `as_stored`: only depths are
/// cleaned and padding is filled (see ReadOptions).
void normalise_planes(Frame& frame, std::optional<float> background, bool as_stored = false);

}  // namespace gloam
