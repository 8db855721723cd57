// The cost in accuracy of planes in half precision.
#pragma once

#include "gloam/frame.h"

namespace gloam::bench {

/// The nearest value of half; beyond the largest, the largest. Infinite values and NaN stay.
float as_half(float value);

/// Rounds a plane to half.
void store_in_half(Plane& plane);

/// Rounds a frame's depths, unit vectors and shares to half: depths relative to the median depth of the view's surfaces, so that
/// no unit overflows. Other planes stay. The results are floats in scene units, since kernels read nothing else: this shows the
/// cost of half in accuracy, not in time.
Frame stored_in_half(const Frame& frame);

}  // namespace gloam::bench
