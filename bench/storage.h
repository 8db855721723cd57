// What keeping planes in half precision costs in accuracy.
#pragma once

#include "gloam/frame.h"

namespace gloam::bench {

/// The nearest number that a half holds; beyond the largest, the largest. Infinite values and NaN stay.
float as_half(float value);

/// A plane as if it had been kept in half.
void store_in_half(Plane& plane);

/// A frame as if its depths, unit vectors and shares had been kept in half: depths in relation to the median depth of the
/// view's surfaces, so that no unit overflows. Other planes stay. They are floats in scene units afterwards: kernels read
/// nothing else, so this says what half costs in accuracy and nothing about time.
Frame stored_in_half(const Frame& frame);

}  // namespace gloam::bench
