#include "normalise/filled.h"

#include <algorithm>

namespace gloam {

void FilledPixels::add(const Plane& plane, const Channel& depth, int first_row) {
  const Layout& layout = plane.channels.front().layout();
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      if (is_background(depth.at(x, first_row + y))) continue;
      ++surfaces;
      filled += std::all_of(plane.channels.begin(), plane.channels.end(),
                            [&](const Channel& c) { return c.at(x, y) == value; });
    }
  }
}

}  // namespace gloam
