// The default radius of ambient occlusion, and the size of a radius on the screen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gloam/frame.h"
#include "gloam/parameters.h"
#include "gloam/plan.h"

namespace gloam {

/// The default radius covers this share of the image's longer side at the median depth. Radii that people chose for 13 frames
/// (docs/accuracy.md) cover .031 to .108 of it, with a median of .065.
inline constexpr double default_radius_share = 1.0 / 16;

/// Whether a parameter is a radius in scene units, whose default comes from the frame: `radius`, or `length` of a ray.
bool is_radius(const Parameter& parameter);
/// The name of the parameter that is a radius; empty if there is none.
std::string radius_parameter(const ParameterList& parameters);

/// Where a radius comes from: a flag or setting, the truth that a result is compared with, the scene (`aoRadius` in the frame's
/// header, or a built-in scene), or the frame's depths.
enum class RadiusSource { flag, truth, scene, frame };
/// "flag", "truth", "scene" or "frame".
const char* name_of(RadiusSource source);

struct Radius {
  double value = 0;  ///< scene units; may be infinite
  RadiusSource from = RadiusSource::frame;
  std::string name = "radius";  ///< of the parameter
};

/// Width in pixels of one scene unit at the median depth of the surfaces of all views, in the picture: of a margin only where the picture shows
/// none. None if no view has a depth, a camera and a
/// surface.
std::optional<double> pixels_at_median_depth(const Frame& frame);

/// The radius that covers `default_radius_share` at the median depth, in scene units, to two digits. None as for
/// `pixels_at_median_depth`.
std::optional<double> radius_made_from(const Frame& frame);

/// The radius that a frame's header states (`aoRadius`), scene units.
std::optional<double> stated_radius(const Frame& frame);

/// `stated`: the radius in the frame's header or of its scene, if any. A frame without a surface gets a radius of 1, which has no
/// effect.
Radius default_radius(const Frame& frame, std::optional<double> stated);

/// The radius of a plan's first pass that has one; none if no pass has. `request`: the request of the plan, with the default radius
/// from `from`.
std::optional<Radius> radius_of(const Plan& plan, const PlanRequest& request, RadiusSource from);

/// The cap on a plan's radius on the screen (`max_reach`), as a share of the image's width; none if the plan has no cap.
std::optional<double> cap_of(const Plan& plan);

/// A warning about a radius on a frame, with a remedy; empty if there is none. It covers too few pixels to find anything, or more
/// than `cap`, a share of the image's width; or it is 0 or infinite. A radius made from the frame gets no warning.
std::string warning_about(const Radius& radius, const Frame& frame, std::optional<double> cap);

/// "radius 0.4 scene units (made from the frame): 62.2 pixels at the median depth"
std::string in_words(const Radius& radius, const Frame& frame);

}  // namespace gloam
