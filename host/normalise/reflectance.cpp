#include "normalise/reflectance.h"

#include <algorithm>

namespace gloam {

void WhitePixels::add(const Plane& plane, const Channel& depth, int first_row) {
  const Layout& layout = plane.channels.front().layout();
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      if (is_background(depth.at(x, first_row + y))) continue;
      ++surfaces;
      white +=
          std::all_of(plane.channels.begin(), plane.channels.end(), [&](const Channel& c) { return c.at(x, y) == 1; });
    }
  }
}

}  // namespace gloam
