// Allowed intrinsics of a camera.
#pragma once

namespace gloam {

/// Whether a scale is plausible. Beyond these limits no picture was taken, and kernels would run out of float's range or digits.
bool is_sensible_scale(double pixels, bool orthographic);

/// The allowed range in words, for messages.
const char* sensible_scale(bool orthographic);

/// Largest distance of the principal point, pixels from the corner of the image: no lens shift or crop leads further.
inline constexpr double farthest_centre = 1e6;

}  // namespace gloam
