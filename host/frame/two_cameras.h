// Where the pixels of one camera lie in the image of another: two eyes, or two frames of a shot.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "gloam/frame.h"

namespace gloam {

/// Positions this near to the middle of a pixel count as the middle, pixels: cameras and motion in single precision, as OpenEXR's M44f,
/// are off by some 1e-4 pixels.
inline constexpr double on_centre = 1e-3;

/// One eye as looking into the other needs it.
struct Eye {
  const Camera& camera;
  const Window& window;
  const Channel& depth;

  bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < window.width() && y < window.height(); }
};

/// From the view space of one camera to that of another.
struct CameraMotion {
  glm::dmat3 rotation{1.0};
  glm::dvec3 translation{0.0};
  glm::dvec3 of_point(const glm::dvec3& p) const { return rotation * p + translation; }
};

/// Positions are subtracted first: they may be far from the origin, and near each other.
CameraMotion motion_between(const Pose& from, const Pose& to);

/// The point that the centre of a pixel shows, view space; NaN where the camera sees nothing there.
glm::dvec3 point_of(const Eye& eye, int x, int y);

/// Pixel of a point, relative to the corner of the window; NaN for a point that the camera does not show.
glm::dvec2 pixel_of(const Eye& eye, const glm::dvec3& point);

/// Whether a place, as `pixel_of` gives it, lies in the image; not for NaN.
bool is_inside(const Eye& eye, const glm::dvec2& place);

/// The back-check of Shi, Billeter and Eisemann 2022 (section 3.1): whether `other` sees the point of pixel (x, y) of `own`, which has
/// the position `place` there. `back`: from `other` to `own`.
bool comes_back(const Eye& own, const Eye& other, const CameraMotion& back, int x, int y, const glm::dvec2& place);

/// A plane of a view. Throws Error if it is missing, or if its size is not that of the frame.
const Plane& plane_in(const View& view, const std::string& name, const Layout& layout);

/// Throws Error for a view without a camera with a pose, and as `plane_in` does for its depth.
void check_eye(const View& view, const Layout& layout);

/// Whether the other view sees the surface of any pixel of one of two views, by the back-check. Throws Error as `check_eye` does.
bool have_surface_in_common(const Frame& frame);

}  // namespace gloam
