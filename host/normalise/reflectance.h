// Recognises a reflectance that a renderer filled with 1 because it has none.
#pragma once

#include "gloam/frame.h"

namespace gloam {

/// Counts foreground pixels in which all components of a plane are exactly 1.
struct WhitePixels {
  long long white = 0, surfaces = 0;
  /// `depth`: after `to_view_depth`, the whole image; `plane`: its rows from `first_row` on.
  void add(const Plane& plane, const Channel& depth, int first_row);
  /// Share of the foreground; 0 if there is none.
  double share() const { return surfaces > 0 ? double(white) / double(surfaces) : 0; }
};

}  // namespace gloam
