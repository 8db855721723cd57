// What of a frame is looked at before anything is computed of it.
#pragma once

#include "gloam/frame.h"

namespace gloam {

/// Throws Error for a frame without views or pixels.
void check_window(const Frame& frame);

/// Throws Error for a plane that has not one channel for each component, each with memory and of the frame's size.
void check(const Plane& plane, const Frame& frame);

}  // namespace gloam
