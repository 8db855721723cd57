// The colours of a tile: by its style, on a scale.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "picture/scale.h"
#include "picture/tile.h"

namespace gloam {

/// The plane at full size, CV_8UC3. Values that are not finite are magenta; background is left as it is.
cv::Mat colours_of(const Tile& tile, const std::vector<Range>& scale);

/// Of a depth at a position on its scale, 0 (near, bright) to 1.
cv::Vec3b depth_colour(double position);

}  // namespace gloam
