// Differences between the two views of a result where both see the same surface.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

/// Result of looking up a pixel of one view in the other.
enum class StereoPixel : unsigned char {
  background,  ///< no surface: nothing to compare
  outside,     ///< its point, or a neighbour of that point, is not in the other image
  hidden,      ///< the back-check failed: the other view sees another surface there
  edge,        ///< a neighbour is background, or its normal fails the normal-check
  counted,
};

struct StereoOptions {
  /// Largest angle between the normals of a pixel and of its neighbours in the other view, degrees; none: no check.
  std::optional<double> normal_check = 6;
};

/// Figures over the counted pixels of one view or of both; errors are in the unit of the plane compared.
struct StereoFigures {
  long long surfaces = 0;                       ///< pixels that are not background
  long long outside = 0, hidden = 0, edge = 0;  ///< surfaces that do not count, by reason
  long long counted = 0;
  double mean = 0;  ///< of E; 0, like all that follows, if nothing is counted
  double rmse = 0;
  double p99 = 0;  ///< the smallest error that 99 % of the counted pixels do not exceed
  double max = 0;
  /// Share of the surfaces that do not count; 0 if there are none.
  double rejected_share() const { return surfaces > 0 ? 1 - double(counted) / double(surfaces) : 0; }
};

/// The errors of one view, pixel by pixel.
struct StereoErrors {
  Channel error;                    ///< E; NaN where a pixel does not count
  std::vector<StereoPixel> pixels;  ///< row by row, without padding
  StereoFigures figures;
};

struct StereoInconsistency {
  std::array<StereoErrors, 2> views;   ///< in the order of the frame's views
  StereoFigures both;                  ///< over the pixels of both views
  std::optional<double> normal_check;  ///< degrees; none if it was not asked for or a view has no normals
};

/// The stereo inconsistency error of Shi, Billeter and Eisemann 2022 ("Stereo-consistent screen-space ambient
/// occlusion", section 4.1) for a plane of a frame with two views, each with depth and a camera with a pose.
///
/// The point of each pixel p with a surface is projected into the other view. E(p) = |A(p) - I(p)|: A is the plane at p, I the
/// other view's plane, interpolated bilinearly at the position of that point. For a plane of several components, E is the length
/// of the difference; unit vectors are turned into the other view's space first.
///
/// p counts if both views see it (section 3.1): the pixel that p lands in, projected back by its own depth, is within 1 pixel of
/// p. All neighbours that I is made from must also be surfaces inside the image, with normals within `normal_check` of p's; a
/// normal of zero length fails. A position within 1/1000 pixel of the middle of a row or column is moved there, and the
/// neighbours beyond have no weight: two eyes side by side share their rows, and rounding must not choose another row.
///
/// Computed in double, from the difference of the cameras' positions: accurate far from the world's origin too. Throws Error for a
/// number of views other than two; for a view without a depth, the plane, or a camera with a pose; for planes whose size is not the
/// frame's; if nothing counts in either view; and for a counted pixel whose error is not finite.
StereoInconsistency stereo_inconsistency(const Frame& frame, const std::string& plane,
                                         const StereoOptions& options = {});

}  // namespace gloam
