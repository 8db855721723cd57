// How far the two views of a result are from each other where both see the same surface.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

/// What becomes of a pixel of one view when it is looked up in the other.
enum class StereoPixel : unsigned char {
  background,  ///< no surface: nothing to compare
  outside,     ///< its point, or one of the neighbours there, is not in the other image
  hidden,      ///< the back-check failed: the other view sees another surface there
  edge,        ///< one of the neighbours is background, or its normal differs by more than the normal-check allows
  counted,
};

struct StereoOptions {
  /// Largest angle between the normal of a pixel and those of its neighbours in the other view, degrees; none: no check.
  std::optional<double> normal_check = 6;
};

/// Figures of the counted pixels of one view or of both; errors have the unit of the plane compared.
struct StereoFigures {
  long long surfaces = 0;                       ///< pixels that are not background
  long long outside = 0, hidden = 0, edge = 0;  ///< surfaces that do not count, by reason
  long long counted = 0;
  double mean = 0;  ///< of E; 0, like all that follows, where nothing is counted
  double rmse = 0;
  double p99 = 0;  ///< the smallest error that 99 % of the counted pixels do not exceed
  double max = 0;
  /// Share of the surfaces that do not count; 0 where there are none.
  double rejected_share() const { return surfaces > 0 ? 1 - double(counted) / double(surfaces) : 0; }
};

/// The errors of one view, pixel by pixel.
struct StereoErrors {
  Channel error;                    ///< E; NaN where a pixel does not count
  std::vector<StereoPixel> pixels;  ///< row by row, without padding
  StereoFigures figures;
};

struct StereoInconsistency {
  std::array<StereoErrors, 2> views;   ///< in the order of the frame's
  StereoFigures both;                  ///< over the pixels of both views
  std::optional<double> normal_check;  ///< degrees; none where it was not asked for or a view has no normals
};

/// The stereo inconsistency error of Shi, Billeter and Eisemann 2022 ("Stereo-consistent screen-space ambient
/// occlusion", section 4.1) for a plane of a frame with two views, each with depth and a camera with a pose.
///
/// The point of each pixel p with a surface is projected into the other view. E(p) = |A(p) - I(p)|: A is the plane at p,
/// I the other view's, bilinear at the place that p lands on. A plane of several components gives the length of the
/// difference; unit vectors are turned into the other view's space first.
///
/// p counts where both views see it (section 3.1): the pixel that p lands in, taken back by its own depth, comes to lie
/// within 1 pixel of p. Moreover all neighbours that I is made of have to be surfaces inside the image, with normals
/// within `normal_check` of that of p; a normal of zero length fails. A place within 1/1000 pixel of the middle of a row
/// or column is taken to be there, and the neighbours beyond have no weight and are not looked at: two eyes side by side
/// share their rows, and rounding must not choose which other row has a say.
///
/// Computed in double, with the difference of the cameras' places taken first: the same far from the world's origin.
/// Throws Error for other than two views, a view without a camera's pose, depth or the plane, planes of other sizes than
/// the frame's, nothing that counts in either view, and a counted pixel whose error is not finite.
StereoInconsistency stereo_inconsistency(const Frame& frame, const std::string& plane,
                                         const StereoOptions& options = {});

/// Whether there is a pixel of one of two views whose surface the other sees as well, by the back-check. Both have depth and
/// a camera with a pose.
bool have_surface_in_common(const Frame& frame);

}  // namespace gloam
