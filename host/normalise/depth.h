// Brings a file's depth to planar view-space z.
#pragma once

#include <string>
#include <vector>

#include "gloam/camera.h"
#include "gloam/conventions.h"
#include "gloam/frame.h"
#include "normalise/told_depth.h"

namespace gloam {

/// Converts depth as found in the file to planar view-space z, in place, and background to +inf.
///
/// `ray` is the distance from the eye; it needs the camera. `ndc` is window depth d in 0..1, 0 at near and 1 at far, as
/// OpenGL (after its default depth range) and Direct3D write it: z = n f / (f - d (f - n)). `reversed` is 1 at near and
/// 0 at far: z = n f / (n + d (f - n)), or n / d for an infinite far plane. `inverse` is 1 / z. With `stated.scale` s and `stated.offset` o what is stored
/// becomes s d + o first; background is what is stored, but for the far plane. Both are linear for an orthographic camera. They need
/// near; ndc and orthographic cameras also need far. Both come from `stated` or else from the camera; without far, reversed
/// depth is taken to have an infinite one. `automatic` is what `normals`, or else plane surfaces, tell (told_depth.h), unless the frame is of a
/// shot; else z.
///
/// Background: NaN, infinite, 0 and anything below 1e-30 (no denormals reach a kernel), 1e10 and more; before conversion, the far
/// plane if it is known (to float rounding) and exactly `stated.background`. ndc: d < 0 or d >= 1; reversed: d <= 0 or d > 1.
/// Negative depth is background, unless all surfaces are negative: then the plane is "negative z" and is flipped. `alpha`, if
/// given, tells a surface on the near plane of ndc (d = 0) from a pixel that was never drawn (d = 0 and alpha 0). Where it does not, and the
/// user states no background, a share of pixels exactly on the near plane is background, and so are those of 65504 (stored_depth.h).
///
/// `told`, if given, gets how a depth of `automatic` was read.
///
/// Returns the convention used ("z", "ray", "ndc", "reversed", "negative z") and appends the assumptions made.
/// Throws Error naming what is missing or out of range (near, far).
std::string to_view_depth(Channel& depth, const Channel* alpha, const Window& window, const Camera& camera,
                          const StatedDepth& stated, std::vector<std::string>& assumed,
                          const NormalsBeside* normals = nullptr, FoundDepth* told = nullptr);

}  // namespace gloam
