#include "gloam/camera.h"

#include <cmath>

#include "gloam/error.h"

namespace gloam {
namespace {

void check_number(const char* name, double value) {
  if (!std::isfinite(value)) throw Error("camera: {} is {}; a finite number is allowed", name, value);
}

void check_focal_length(const char* name, const Camera& camera, double value) {
  if (!(std::isfinite(value) && value > 0))
    throw Error("camera: {} is {}; a number above 0 is allowed, pixels per {}", name, value,
                camera.orthographic ? "scene unit" : "unit at depth 1");
}

void check_pose(const Pose& pose) {
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(pose.position[i]))
      throw Error("camera: component {} of its position is {}; a finite number is allowed", i, pose.position[i]);
    for (int j = 0; j < 3; ++j) {
      if (!std::isfinite(pose.world_to_view[i][j]))
        throw Error("camera: element [{}][{}] of world_to_view is {}; a finite number is allowed", i, j,
                    pose.world_to_view[i][j]);
    }
  }
}

}  // namespace

void check(const Camera& camera) {
  check_focal_length("fx", camera, camera.fx);
  check_focal_length("fy", camera, camera.fy);
  check_number("cx", camera.cx);
  check_number("cy", camera.cy);
  if (camera.pose) check_pose(*camera.pose);
}

}  // namespace gloam
