// The colours of a tile, by its style and scale.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "picture/scale.h"
#include "picture/tile.h"

namespace gloam {

/// The plane at full size, CV_8UC3. Values that are not finite are magenta; background is left unchanged.
cv::Mat colours_of(const Tile& tile, const std::vector<Range>& scale);

/// Colour of a depth by its position on the scale, 0 (near, bright) to 1.
cv::Vec3b depth_colour(double position);

}  // namespace gloam
