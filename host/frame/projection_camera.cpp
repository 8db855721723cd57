#include "gloam/projection_camera.h"

#include <cmath>
#include <glm/matrix.hpp>
#include <limits>
#include <string>

#include "gloam/error.h"

namespace gloam {
namespace {

/// Elements of a projection as it is written: row first.
struct ProjectionMatrix {
  glm::dmat4 columns;
  ClipSpace clip;
  double operator()(int row, int column) const { return columns[column][row]; }
  /// An element's name, as the matrix is written: Unreal's is for row vectors.
  std::string name(int row, int column) const {
    return clip == ClipSpace::unreal ? fmt::format("projection[{}, {}]", column, row)
                                     : fmt::format("projection[{}, {}]", row, column);
  }
};

const char* name_of(ClipSpace clip) {
  return clip == ClipSpace::opengl ? "'opengl'" : clip == ClipSpace::vulkan ? "'vulkan'" : "'unreal'";
}

/// What a matrix of float32 may be off by.
constexpr double rounding = 1e-6;
bool is_near(double value, double other) { return std::abs(value - other) <= rounding; }

bool is_parallel(const ProjectionMatrix& m) { return is_near(m(3, 2), 0) && is_near(m(3, 3), 1); }
bool is_perspective(const ProjectionMatrix& m) { return is_near(std::abs(m(3, 2)), 1) && is_near(m(3, 3), 0); }

/// The first element that has to be 0 and is not, as the start of a sentence; empty if there is none.
std::string fault_of_zeros(const ProjectionMatrix& m) {
  const int column =
      is_parallel(m) ? 2 : 3;  // where a perspective matrix has no shift, and an orthographic one no slant
  const int zeros[][2] = {{3, 0}, {3, 1}, {0, 1}, {1, 0}, {2, 0}, {2, 1}, {0, column}, {1, column}};
  for (const auto& [row, column] : zeros) {
    if (!is_near(m(row, column), 0)) return fmt::format("{} is {:g}", m.name(row, column), m(row, column));
  }
  return "";
}

bool is_projection(const ProjectionMatrix& m) {
  return (is_parallel(m) || is_perspective(m)) && fault_of_zeros(m).empty();
}

void check_form(const ProjectionMatrix& m) {
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      if (!std::isfinite(m(row, column)))
        throw UsageError("{} is {}; a finite number is allowed", m.name(row, column), m(row, column));
    }
  }
  if (is_projection(m)) return;
  if (is_projection({glm::transpose(m.columns), m.clip}))
    throw UsageError("projection is transposed: {} has matrices for {} vectors; give projection.T", name_of(m.clip),
                     m.clip == ClipSpace::unreal ? "row" : "column");
  if (!is_parallel(m) && !is_perspective(m))
    throw UsageError(
        "projection has the last {} {:g}, {:g}, {:g}, {:g}; 0, 0, -1, 0 or 0, 0, 1, 0 is allowed, and 0, 0, 0, 1 of "
        "an "
        "orthographic camera: give the projection alone, without the view",
        m.clip == ClipSpace::unreal ? "column" : "row", m(3, 0), m(3, 1), m(3, 2), m(3, 3));
  throw UsageError(
      "{}, where a projection without a turn, a shear and an oblique near plane has 0; give the projection alone, "
      "without the view",
      fault_of_zeros(m));
}

/// Which way the view space of a matrix points.
struct ViewAxes {
  double ahead = -1;  ///< the sign of z before the camera
  bool is_y_down = false;
};

ViewAxes view_axes(const ProjectionMatrix& m, ClipSpace clip) {
  if (!(m(0, 0) > 0))
    throw UsageError("projection[0, 0] is {:g}, which mirrors the image; a number above 0 is allowed", m(0, 0));
  const double up = m(1, 1);
  if (up == 0) throw UsageError("projection[1, 1] is 0, which flattens the image; another number is allowed");
  const bool is_vulkan = clip == ClipSpace::vulkan;
  ViewAxes axes;
  axes.ahead = is_perspective(m) ? std::round(m(3, 2)) : clip == ClipSpace::unreal || (is_vulkan && up > 0) ? 1 : -1;
  axes.is_y_down = is_vulkan && up > 0;
  if (axes.is_y_down && axes.ahead < 0)
    throw UsageError(
        "projection[1, 1] is {:g}, above 0, so that y is up in the image, where Vulkan has it down; negate row 1 if "
        "the viewport's height is "
        "negative, or say 'opengl' of a matrix of OpenGL",
        up);
  if (!is_vulkan && up < 0)
    throw UsageError(
        "projection[1, 1] is {:g}, below 0, so that the image stands on its head; negate row 1 if the rows of the "
        "planes go from the top, or "
        "say 'vulkan' of a matrix of Vulkan",
        up);
  const double wanted = clip == ClipSpace::unreal ? 1 : -1;
  if (!is_vulkan && axes.ahead != wanted)
    throw UsageError("{} is {:g}, of a camera that looks along {}z; {} looks along {}z", m.name(3, 2), m(3, 2),
                     axes.ahead > 0 ? "+" : "-", wanted > 0 ? "'unreal'" : "'opengl'", wanted > 0 ? "+" : "-");
  return axes;
}

/// The planes at which clip z over w is `first` and `last`.
struct ClippingPlanes {
  double near, far;
};

/// Of a camera whose z over w is a + b / depth.
ClippingPlanes perspective_planes(double a, double b, double lowest, double highest) {
  const auto depth_at = [&](double z) {
    const bool is_infinite = std::abs(z - a) <= 2e-7 * std::max(1.0, std::abs(a));
    return is_infinite ? std::numeric_limits<double>::infinity() : b / (z - a);
  };
  return b < 0 ? ClippingPlanes{depth_at(lowest), depth_at(highest)}
               : ClippingPlanes{depth_at(highest), depth_at(lowest)};
}

/// Of a camera whose z is a depth + b.
ClippingPlanes orthographic_planes(double a, double b, double lowest, double highest) {
  const double first = (lowest - b) / a, last = (highest - b) / a;
  return a > 0 ? ClippingPlanes{first, last} : ClippingPlanes{last, first};
}

ClippingPlanes clipping_planes(const ProjectionMatrix& m, ClipSpace clip, double ahead) {
  const bool orthographic = is_parallel(m);
  const double a = ahead * m(2, 2), b = m(2, 3);
  if ((orthographic ? a : b) == 0)
    throw UsageError("{} is 0, so that all depths become one; another number is allowed",
                     m.name(2, orthographic ? 2 : 3));
  // A reversed z in OpenGL is of use from 1 to 0 alone. From 1 to -1 it would end at or below -1.
  const bool is_reversed = orthographic ? a < 0 : b > 0;
  const double at_far = orthographic ? b : a;
  const bool is_symmetric = clip == ClipSpace::opengl && !(is_reversed && !orthographic && at_far > -1 + rounding);
  const double lowest = is_symmetric ? -1 : 0;
  const ClippingPlanes planes =
      orthographic ? orthographic_planes(a, b, lowest, 1) : perspective_planes(a, b, lowest, 1);
  const bool is_before_the_camera =
      orthographic ? std::isfinite(planes.near) : planes.near > 0 && std::isfinite(planes.near);
  if (!is_before_the_camera || !(planes.far > planes.near))
    throw UsageError(
        "projection has its near plane at {:g} and its far plane at {:g}; a near plane before the camera and a far "
        "plane behind it are "
        "allowed: is its z from {}, as {} has it?",
        planes.near, planes.far, is_symmetric ? "-1 to 1" : "0 to 1",
        clip == ClipSpace::opengl   ? "'opengl'"
        : clip == ClipSpace::vulkan ? "'vulkan'"
                                    : "'unreal'");
  return planes;
}

}  // namespace

ProjectedCamera camera_from_projection(const glm::dmat4& projection, ClipSpace clip, int width, int height) {
  if (width < 1 || height < 1 || width > 65536 || height > 65536)
    throw UsageError("an image of {} x {} pixels is not allowed; 1 to 65536 each way are", width, height);
  const ProjectionMatrix m{projection, clip};
  check_form(m);
  const ViewAxes axes = view_axes(m, clip);
  const ClippingPlanes planes = clipping_planes(m, clip, axes.ahead);
  const bool orthographic = is_parallel(m);
  // Of the middle of the image from the principal point, in halves of the image: by depth, or always.
  const double shift_x = orthographic ? m(0, 3) : axes.ahead * m(0, 2);
  const double shift_y = orthographic ? m(1, 3) : axes.ahead * m(1, 2);
  const double down = clip == ClipSpace::vulkan ? 1 : -1;
  ProjectedCamera made;
  made.camera.orthographic = orthographic;
  made.camera.fx = width / 2.0 * m(0, 0);
  made.camera.fy = height / 2.0 * std::abs(m(1, 1));
  made.camera.cx = width / 2.0 * (1 + shift_x);
  made.camera.cy = height / 2.0 * (1 + down * shift_y);
  made.camera.near = planes.near;
  made.camera.far = planes.far;
  made.camera.source = "projection";
  made.axes = {1, axes.is_y_down ? -1 : 1, -axes.ahead};
  return made;
}

}  // namespace gloam
