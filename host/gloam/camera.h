// A camera as gloam uses it: intrinsics in pixels, extrinsics in double.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

namespace gloam {

/// Where the camera stands. Right-handed, looking along -z, y up.
struct Pose {
  glm::dmat3 world_to_view{1.0};  ///< rotation: view = world_to_view * (world - position)
  glm::dvec3 position{0.0};       ///< of the camera in the world, scene units, kept in double
};

/// Intrinsics and, where known, the pose.
///
/// A point (X, Y, -depth) in view space lands at
///   x = cx + fx * X / depth,  y = cy - fy * Y / depth     (perspective)
///   x = cx + fx * X,          y = cy - fy * Y             (orthographic)
/// in EXR pixel coordinates: row 0 on top, pixel centres at +0.5, origin that of the file's display window
/// coordinates (not of the data window).
struct Camera {
  bool orthographic = false;
  double fx = 0, fy = 0;  ///< pixels per unit at depth 1 (perspective), pixels per scene unit (orthographic); > 0
  double cx = 0, cy = 0;  ///< principal point, pixels
  std::optional<double> near, far;  ///< clipping planes, scene units, where known
  std::optional<Pose> pose;         ///< none: world-space planes cannot be used
  std::string source;               ///< where it came from: "header", a file's name, "--fov", "assumed ..."
};

}  // namespace gloam
