// Scales of pictures: from the values of tiles to the ends of their colours. Tiles that are to be compared share a scale.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "picture/tile.h"

namespace gloam {

/// Range of the drawn values of one component.
struct Range {
  double low = 0, high = 0;    ///< of all finite values
  double first = 0, last = 0;  ///< ends of the colours
  long long finite = 0;        ///< pixels

  /// 0 to 1; 0.5 on a scale without extent.
  double position(double v) const;
};

/// One range per drawn component, over tiles of one style and plane.
std::vector<Range> ranges_of(const std::vector<const Tile*>& tiles);

/// Tiles with the same key share a scale: all depths, and one plane in several views.
std::string scale_key(const Tile& tile);

using Scales = std::map<std::string, std::vector<Range>>;
Scales scales_of(const std::vector<Tile>& tiles);
/// The scale of the depths, in logarithms; null if none is drawn.
const Range* depth_scale(const Scales& scales);

}  // namespace gloam
