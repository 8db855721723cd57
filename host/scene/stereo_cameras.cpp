#include "gloam/scene/stereo_cameras.h"

#include <cmath>

#include "gloam/error.h"
#include "gloam/option.h"
#include "scene/turned_pose.h"

namespace gloam {
namespace {

/// As in a camera JSON: a principal point farther off makes no sense.
constexpr double largest_shift = 1e6;

void check(const Camera& middle, const StereoRig& rig) {
  if (!(rig.interpupillary_distance >= 0) || std::isinf(rig.interpupillary_distance))
    throw UsageError("eyes {:g} scene units apart are not allowed; a finite distance of 0 or more is",
                     rig.interpupillary_distance);
  if (rig.convergence && !(*rig.convergence > 0))
    throw UsageError("a convergence depth of {:g} is not in front of the eyes; give more than 0", *rig.convergence);
  if (rig.toe_in && !rig.convergence)
    throw UsageError("toe-in turns the eyes towards a depth; give the convergence depth too");
  if (middle.orthographic && !rig.toe_in)
    throw UsageError(
        "two eyes side by side see the same through an orthographic camera ({}); give {} {}, which turns them, or a "
        "perspective camera",
        middle.source, option("convergence", "D"), option("toe-in"));
}

/// Distance that the principal point of each eye moves outwards, pixels.
double shift_of(const Camera& middle, const StereoRig& rig) {
  if (!rig.convergence || rig.toe_in) return 0;
  const double shift = middle.fx * 0.5 * rig.interpupillary_distance / *rig.convergence;
  if (shift <= largest_shift) return shift;
  throw UsageError(
      "eyes {:g} scene units apart that converge at depth {:g} shift their images by {:g} pixels; at most {:g} make "
      "sense, give a larger depth or a smaller distance",
      rig.interpupillary_distance, *rig.convergence, shift, largest_shift);
}

}  // namespace

double toe_in_degrees(const StereoRig& rig) {
  return rig.toe_in ? glm::degrees(std::atan2(0.5 * rig.interpupillary_distance, *rig.convergence)) : 0;
}

std::array<Camera, 2> stereo_cameras(const Camera& middle, const StereoRig& rig) {
  check(middle, rig);
  const double shift = shift_of(middle, rig), degrees = toe_in_degrees(rig);
  const auto eye = [&](const char* name, double side) {
    Camera camera = middle;
    camera.pose = moved(*middle.pose, {0.5 * side * rig.interpupillary_distance, 0, 0}, side * degrees);
    camera.cx += side * shift;
    camera.source = fmt::format("{}, {} eye", middle.source, name);
    return camera;
  };
  return {eye("left", -1), eye("right", 1)};
}

}  // namespace gloam
