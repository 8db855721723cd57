// Recognises a plane that a renderer filled with one value because it has none.
#pragma once

#include "gloam/frame.h"

namespace gloam {

/// Counts foreground pixels in which all components of a plane are exactly a value.
struct FilledPixels {
  float value = 0;
  long long filled = 0, surfaces = 0;
  /// `depth`: after `to_view_depth`, the whole image; `plane`: its rows from `first_row` on.
  void add(const Plane& plane, const Channel& depth, int first_row);
  /// Share of the foreground; 0 if there is none.
  double share() const { return surfaces > 0 ? double(filled) / double(surfaces) : 0; }
};

}  // namespace gloam
