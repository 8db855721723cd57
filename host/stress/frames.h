// Frames made from closed forms: what a pixel shows is solved for in double and rounded once to float.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam::analytic {
struct Scene;
}

namespace gloam::stress {

/// A camera at the origin of view space, and the size of its image.
struct Shot {
  Camera camera;
  int width = 0, height = 0;
};

/// `fov` is horizontal, degrees.
Shot perspective(int width, int height, double fov = 60);
/// `units_across`: scene units from the left to the right border.
Shot orthographic(int width, int height, double units_across);

// OpenCL on a CPU compiles each kernel anew for each combination of settings, lanes, mathematics and size of image, which takes
// a hundred times as long as computing a small image. What is compiled is kept on disk and serves all cases that use it. So
// the cases share few sizes, and few samples where they hold for any number.

/// 80x60, through a perspective and an orthographic camera.
std::vector<Shot> usual_shots();
/// 144x108: as fine as fits into what a CPU compiles for small images (`group_size` in run/launch.cpp).
Shot fine_shot();
/// 93x61: no multiple of any number of lanes.
std::vector<Shot> odd_shots();

/// Where the eye looks through a point of the image (pixels): origin + depth * direction; direction.z = -1. Not a number where a
/// light-field display shows nothing.
struct EyeRay {
  glm::dvec3 origin, direction;
};
EyeRay ray_through(const Shot& shot, double x, double y);

/// What is seen there.
struct Surface {
  double depth;
  glm::dvec3 normal;  ///< unit, view space
};
using Scene = std::function<std::optional<Surface>(const EyeRay&)>;

/// A plane through (0, 0, -depth), turned away from the eye by `tilt`, downhill towards `turn`; radians.
Scene tilted_plane(double depth, double tilt, double turn);
/// The part of a scene that lies in the box |x| <= half_x, |y| <= half_y.
Scene within(Scene scene, double half_x, double half_y);
/// Solids in view space.
Scene solids(const analytic::Scene& scene);
/// A scene seen by an eye that looks down by `angle`, radians.
Scene looking_down(Scene scene, double angle);
/// Two walls, a floor with a ball and a step on it, and nothing beyond the open side, between depth 1 and 4: whatever
/// reads a radius of half a unit finds occluders in much of the image, through either camera (orthographic: 4 units across).
Scene room();

/// An image without planes.
Frame blank(const Shot& shot);
/// Depth and, if wanted, exact normals; has passed the door. `background`: the value that stands for it, as --background has it;
/// without, depths of 1e10 and more do.
Frame shoot(const Shot& shot, const Scene& scene, bool with_normals = true, std::optional<float> background = {});
/// A view's plane of that name, added (zero, or what lies outside for one of the known kinds) if it is not there.
Plane& plane_of(View& view, const Layout& layout, const std::string& name);
/// The named plane of the first view, added (zero, or what lies outside for one of the known kinds) if it is not there.
Plane& plane_of(Frame& frame, const std::string& name);
std::vector<std::string> plane_names(const Frame& frame);
/// Planes are move-only: a copy has to be asked for.
Frame clone(const Frame& frame);
/// The same views of the same scene with another unit: every length times 2^k. Light-field modules are left as they are.
Frame in_other_unit(const Frame& frame, int k);

/// Gives every view a plane of that name with values that its kind allows and that show some variety: further depth
/// layers lie behind the visible surface, positions fit the depth, colours are a pattern. A stack is three layers, the
/// first of them the depth. The frame has depth.
void invent_plane(Frame& frame, const std::string& name);

}  // namespace gloam::stress
