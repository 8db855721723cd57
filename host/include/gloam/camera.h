// A camera as gloam uses it: intrinsics in pixels, extrinsics in double.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>

namespace gloam {

/// Where the camera stands. Right-handed, looking along -z, y up.
struct Pose {
  glm::dmat3 world_to_view{1.0};  ///< rotation: view = world_to_view * (world - position)
  glm::dvec3 position{0.0};       ///< of the camera in the world, scene units, kept in double
};

/// How one optical module of a light-field display lights the eyes of its observers (light_field.h): each of its rays meets
/// two slits, the upright line through the module and the line along which the observers stand. Physical space: x along the
/// observer line, y up, z out of the screen towards the observers, the screen's middle at the origin; in the display's units.
///
/// View space lies with its origin on the observer line and is the same for all modules of a display: a depth is the
/// distance from the plane of the observers.
struct TwoSlits {
  /// physical = to_physical * view + (0, observer_height, observer_distance). The last row is (0, 0, s), s > 0.
  glm::dmat3 to_physical{1.0};
  double observer_height = 0, observer_distance = 1;
  double screen_width = 1, screen_height = 1;
  std::optional<double> screen_radius;  ///< of a screen that is a part of an upright cylinder, convex to the observers
  glm::dvec3 module{0.0, 0.0, -1.0};    ///< physical; behind the screen, z < 0
  glm::dmat3 turn{
      1.0};  ///< of the module: its columns are to the right, up and the way its light goes, in physical space
  std::shared_ptr<const std::string> display;  ///< the whole display as JSON, for headers
};

/// Intrinsics and, where known, the pose.
///
/// A point (X, Y, -depth) in view space lands at
///   x = cx + fx * X / depth,  y = cy - fy * Y / depth     (perspective)
///   x = cx + fx * X,          y = cy - fy * Y             (orthographic)
/// in EXR pixel coordinates: row 0 on top, pixel centres at +0.5, origin that of the file's display window
/// coordinates (not of the data window). With `slits` they are those of the module, as a projector: a point of the screen in
/// the directions (right, up, ahead) from it has the pixel
///   x = cx + fx * right / ahead,  y = cy - fy * up / ahead.
struct Camera {
  bool orthographic = false;
  double fx = 0, fy = 0;  ///< pixels per unit at depth 1 (perspective), pixels per scene unit (orthographic); > 0
  double cx = 0, cy = 0;  ///< principal point, pixels
  std::optional<double> near, far;  ///< clipping planes, scene units, where known
  std::optional<Pose> pose;         ///< none: world-space planes cannot be used
  std::shared_ptr<const TwoSlits>
      slits;           ///< of a module of a light-field display; null: rays meet in one point, or none
  std::string source;  ///< where it came from: "header", a file's name, "--fov", "assumed ..."
};

/// Throws Error for a camera that gives no pixel a place in space: fx or fy that is not a finite number above 0, a principal
/// point or a pose that is not finite.
void check(const Camera& camera);

}  // namespace gloam
