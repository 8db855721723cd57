// Normalisation of planes whose depth is planar view-space z already.
#pragma once

#include <optional>

#include "gloam/frame.h"
#include "gloam/normalise.h"

namespace gloam {

/// As `normalise`, for a frame whose `depth` has been through `to_view_depth`. `as_stored`: only cleans depths and fills padding
/// (see ReadOptions).
void normalise_planes(Frame& frame, std::optional<float> background, bool as_stored = false);

}  // namespace gloam
