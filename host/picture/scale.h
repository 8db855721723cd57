// The scales of the pictures for people: from the values of tiles to the ends of their colours, one scale for what is to be
// compared.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "picture/tile.h"

namespace gloam {

/// Of the values that are drawn of one component.
struct Range {
  double low = 0, high = 0;    ///< of all finite values
  double first = 0, last = 0;  ///< ends of the colours
  long long finite = 0;        ///< pixels

  /// 0 to 1; a scale without extent has its middle only.
  double position(double v) const;
};

/// One for each component that is drawn, over tiles of one style and plane.
std::vector<Range> ranges_of(const std::vector<const Tile*>& tiles);

/// Tiles of one key share a scale: all depths, and one plane in several views.
std::string scale_key(const Tile& tile);

using Scales = std::map<std::string, std::vector<Range>>;
Scales scales_of(const std::vector<Tile>& tiles);
/// That of the depths, in logarithms; none where none is drawn.
const Range* depth_scale(const Scales& scales);

}  // namespace gloam
