// Two eyes in the place of one camera.
#pragma once

#include <array>
#include <optional>

#include "gloam/camera.h"

namespace gloam {

/// Placement of two eyes. Lengths are in scene units.
struct StereoRig {
  double interpupillary_distance = 0;  ///< from eye to eye; 0 or more, and 0 makes two equal eyes
  std::optional<double> convergence;   ///< depth with a disparity of 0, more than 0; none: parallel eyes
  bool toe_in = false;                 ///< eyes turned towards that depth, instead of frusta shifted off their axes
};

/// Angle by which each eye of a rig with toe-in is turned inwards, degrees.
double toe_in_degrees(const StereoRig& rig);

/// The left and the right eye, each half the distance from `middle`, which needs a pose, along its x axis, with its intrinsics and
/// clipping planes. With parallel perspective eyes a point at depth d lies fx * distance / d pixels farther to the right in the
/// left image than in the right one (disparity).
///
/// With a convergence depth D the principal points move by fx * distance / 2 / D, left in the left eye and right in the right one,
/// which subtracts fx * distance / D from every disparity. With toe-in both eyes instead look at the point of the middle's axis at
/// that depth, and keep their principal points.
///
/// Throws UsageError for values out of range, toe-in without a convergence depth, a principal point moved by more than 1e6
/// pixels, and an orthographic camera without toe-in: side by side, both eyes would see the same picture.
std::array<Camera, 2> stereo_cameras(const Camera& middle, const StereoRig& rig);

}  // namespace gloam
