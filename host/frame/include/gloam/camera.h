// A camera as gloam uses it: intrinsics in pixels, extrinsics in double.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>

namespace gloam {

/// The camera's position and rotation in the world. Right-handed, looking along -z, y up.
struct Pose {
  glm::dmat3 world_to_view{1.0};  ///< rotation: view = world_to_view * (world - position)
  glm::dvec3 position{0.0};       ///< of the camera in the world, scene units, kept in double
};

/// How an optical module of a light-field display lights the eyes of its observers (light_field.h): each of its rays meets two
/// slits, the upright line through the module and the line along which the observers stand. Physical space: x along the observer
/// line, y up, z out of the screen towards the observers, origin in the middle of the screen; in the display's units.
///
/// The origin of view space lies on the observer line and is the same for all modules of a display: a depth is the distance from
/// the plane of the observers.
struct TwoSlits {
  /// physical = to_physical * view + (0, observer_height, observer_distance). The last row is (0, 0, s), s > 0.
  glm::dmat3 to_physical{1.0};
  double observer_height = 0, observer_distance = 1;
  double screen_width = 1, screen_height = 1;
  std::optional<double> screen_radius;  ///< if the screen is part of an upright cylinder, convex to the observers
  glm::dvec3 module{0.0, 0.0, -1.0};    ///< physical; behind the screen, z < 0
  glm::dmat3 turn{1.0};                 ///< the module's axes in physical space; columns: right, up, along its light
  std::shared_ptr<const std::string> display;  ///< the whole display as JSON, for headers
};

/// Intrinsics and, where known, the pose.
///
/// A point (X, Y, -depth) in view space lands at
///   x = cx + fx * X / depth,  y = cy - fy * Y / depth     (perspective)
///   x = cx + fx * X,          y = cy - fy * Y             (orthographic)
/// in EXR pixel coordinates: row 0 on top, pixel centres at +0.5, origin that of the file's display window coordinates (not of the
/// data window). With `slits`, the module is a projector, and (right, up, ahead) is the way from it to a point of the screen:
///   x = cx + fx * right / ahead,  y = cy - fy * up / ahead.
struct Camera {
  bool orthographic = false;
  double fx = 0, fy = 0;  ///< pixels per unit at depth 1 (perspective), pixels per scene unit (orthographic); > 0
  double cx = 0, cy = 0;  ///< principal point, pixels
  std::optional<double> near, far;        ///< clipping planes, scene units, where known
  std::optional<Pose> pose;               ///< none: world-space planes cannot be used
  std::shared_ptr<const TwoSlits> slits;  ///< of a light-field display's module; null: perspective or orthographic
  std::string source;  ///< where it came from: "header", a file's name, the option (option.h), "assumed ..."
};

/// Throws Error if fx or fy is not a finite number above 0, or the principal point or the pose is not finite.
void check(const Camera& camera);

}  // namespace gloam
