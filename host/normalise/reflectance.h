// Reflectance of which a renderer writes 1 where it knows none.
#pragma once

#include "gloam/frame.h"

namespace gloam {

/// Pixels of the foreground where all components of a plane are exactly 1.
struct WhitePixels {
  long long white = 0, surfaces = 0;
  /// `depth` has been through `to_view_depth`, and is of the whole image where `plane` has its rows from `first_row` on.
  void add(const Plane& plane, const Channel& depth, int first_row);
  /// Of the foreground; 0 where there is none.
  double share() const { return surfaces > 0 ? double(white) / double(surfaces) : 0; }
};

}  // namespace gloam
