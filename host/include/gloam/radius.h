// The radius of ambient occlusion where nobody gives one, and what a radius covers on the screen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gloam/frame.h"
#include "gloam/parameters.h"
#include "gloam/plan.h"

namespace gloam {

/// The default radius covers this share of the image's longer side at the median depth. Radii chosen by hand for 13 frames
/// (docs/accuracy.md) cover .031 to .108 of it, in the median .065.
inline constexpr double default_radius_share = 1.0 / 16;

/// Whether a parameter is a radius in scene units, whose default is made from the frame.
bool is_radius(const Parameter& parameter);

/// Where a radius comes from: somebody gave it, the truth was made with it, the scene has it (`aoRadius` in the header of the
/// frame, or a built-in scene), or it is made from the frame.
enum class RadiusSource { flag, truth, scene, frame };
/// "flag", "truth", "scene" or "frame".
const char* name_of(RadiusSource source);

struct Radius {
  double value = 0;  ///< scene units; may be infinite
  RadiusSource from = RadiusSource::frame;
};

/// Pixels that one scene unit across takes at the median depth of the surfaces of all views. None where no view has a depth, a
/// camera and a surface.
std::optional<double> pixels_at_median_depth(const Frame& frame);

/// The radius that covers `default_radius_share` at the median depth, in scene units, to two digits. None as above.
std::optional<double> radius_made_from(const Frame& frame);

/// `stated`: what the frame's header or scene says, if anything. A frame without a surface gets a radius of 1, which has nothing
/// to reach.
Radius default_radius(const Frame& frame, std::optional<double> stated);

/// The radius that a plan works with: of its first pass that has one; none where no pass has. `request`: what the plan was made
/// of, with the default radius `from`.
std::optional<Radius> radius_of(const Plan& plan, const PlanRequest& request, RadiusSource from);

/// The share of the image's width that caps a plan's radius on the screen (`max_reach`); none where the plan has no cap.
std::optional<double> cap_of(const Plan& plan);

/// What is wrong with a radius on a frame, with a way out; empty where nothing is. It covers too few pixels to find anything,
/// or more than `cap`, a share of the image's width; it is 0 or infinite. A radius made from the frame is never wrong.
std::string warning_about(const Radius& radius, const Frame& frame, std::optional<double> cap);

/// "radius 0.4 scene units (made from the frame): 62.2 pixels at the median depth"
std::string in_words(const Radius& radius, const Frame& frame);

}  // namespace gloam
