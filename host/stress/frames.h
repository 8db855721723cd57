// Frames from closed forms: the point that a pixel shows is solved for in double and rounded once to float.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam::analytic {
struct Scene;
}

namespace gloam::stress {

inline constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// A camera at the origin of view space, and the size of its image.
struct Shot {
  Camera camera;
  int width = 0, height = 0;
};

/// `fov` is horizontal, degrees.
Shot perspective(int width, int height, double fov = 60);
/// `units_across`: scene units from the left to the right border.
Shot orthographic(int width, int height, double units_across);

// OpenCL on a CPU compiles each kernel separately for each combination of settings, lanes, mathematics and image size, which
// takes a hundred times as long as computing a small image. Compiled kernels are kept on disk for all cases. So the cases share
// few sizes, and few samples if a property holds for any number of them.

/// 80x60, through a perspective and an orthographic camera.
std::vector<Shot> usual_shots();
/// 144x108: the largest size compiled like small images on a CPU (`group_size` in run/launch.cpp).
Shot fine_shot();
/// 93x61: not a multiple of any number of lanes.
std::vector<Shot> odd_shots();

/// The ray through a position in the image (pixels): origin + depth * direction; direction.z = -1. NaN where a light-field
/// display shows nothing.
struct EyeRay {
  glm::dvec3 origin, direction;
};
EyeRay ray_through(const Shot& shot, double x, double y);

/// The surface that a ray meets.
struct Surface {
  double depth;
  glm::dvec3 normal;  ///< unit, view space
};
using Scene = std::function<std::optional<Surface>(const EyeRay&)>;

/// A plane through (0, 0, -depth), turned away from the eye by `tilt`, falling away towards `turn`; radians.
Scene tilted_plane(double depth, double tilt, double turn);
/// The part of a scene that lies in the box |x| <= half_x, |y| <= half_y.
Scene within(Scene scene, double half_x, double half_y);
/// Solids in view space.
Scene solids(const analytic::Scene& scene);
/// A scene seen by an eye that looks down by `angle`, radians.
Scene looking_down(Scene scene, double angle);
/// Two walls, a floor with a ball and a step on it, and an open side, between depths 1 and 4: with a radius of half a unit,
/// occluders are found in much of the image, with either camera (orthographic: 4 units across).
Scene room();

/// An image without planes.
Frame blank(const Shot& shot);
/// Depth and, if wanted, exact normals, normalised (gloam/normalise.h). `background`: the value for it, as for --background;
/// none: 1e10 and more.
Frame shoot(const Shot& shot, const Scene& scene, bool with_normals = true, std::optional<float> background = {});
/// A view's plane of this name, added if it is missing: zero, or the value outside the image for a known kind.
Plane& plane_of(View& view, const Layout& layout, const std::string& name);
/// The first view's plane of this name, added as above.
Plane& plane_of(Frame& frame, const std::string& name);
std::vector<std::string> plane_names(const Frame& frame);
/// Planes are move-only: this makes a copy.
Frame clone(const Frame& frame);
/// The same views in another unit: every length times 2^k. Light-field modules are left unchanged.
Frame in_other_unit(const Frame& frame, int k);

/// Gives every view a plane of this name with varied values that its kind allows: further depth layers lie behind the visible
/// surface, positions fit the depth, colours are a pattern. A stack gets three layers, the first of them the depth. The frame has
/// depth.
void invent_plane(Frame& frame, const std::string& name);

}  // namespace gloam::stress
