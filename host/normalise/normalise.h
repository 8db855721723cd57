// Normalisation of planes whose depth is planar view-space z already.
#pragma once

#include <functional>
#include <optional>

#include "gloam/frame.h"
#include "gloam/normalise.h"

namespace gloam {

/// As `normalise`, for a frame whose `depth` has been through `to_view_depth`. `as_stored`: only cleans depths and fills padding
/// (see ReadOptions).
void normalise_planes(Frame& frame, std::optional<float> background, bool as_stored = false);

/// `normalise` of one view whose values are still to be made: `fill(y)` makes those of a row, which is then cleaned while it is near. All
/// planes have this layout.
void normalise_while_filling(View& view, const Layout& layout, const std::function<void(int y)>& fill,
                             std::optional<float> background = {});

}  // namespace gloam
