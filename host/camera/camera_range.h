// Which intrinsics a camera can have.
#pragma once

namespace gloam {

/// Beyond these no picture was taken, and what kernels compute from it leaves the range or the digits of a float.
bool is_sensible_scale(double pixels, bool orthographic);

/// That range in words, for messages.
const char* sensible_scale(bool orthographic);

/// Pixels from the corner of the image: what lies further to the side is no place that a lens shift or a crop leads to.
inline constexpr double farthest_centre = 1e6;

}  // namespace gloam
