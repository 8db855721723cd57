// Checks of a frame before anything is computed from it.
#pragma once

#include "gloam/frame.h"

namespace gloam {

/// Throws Error for a frame without views or pixels.
void check_window(const Frame& frame);

/// Throws Error if a plane has not one channel per component, each with memory and the frame's size, or, of a plane of every n-th pixel
/// (`resolution_in`), the size of that.
void check(const Plane& plane, const Frame& frame);

}  // namespace gloam
