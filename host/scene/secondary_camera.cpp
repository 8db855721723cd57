#include "gloam/scene/secondary_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <vector>

#include "gloam/error.h"
#include "scene/turned_pose.h"

namespace gloam {
namespace {

using glm::dvec2;
using glm::dvec3;

/// Largest angle between an image border and the axis, degrees.
constexpr double widest_degrees = 60;
/// Ratio of the image to the part that it must hold.
constexpr double spare = 1.01;

using Corners = std::array<dvec3, 8>;

/// Corners of the part of the first camera's frustum that holds the visible surfaces; relative to the pivot, along the axes of
/// the turned camera: z points at its eye.
Corners turned_corners(const Camera& first, int width, int height, const VisibleDepths& depths, double degrees) {
  Corners corners;
  size_t i = 0;
  const glm::dmat3 to_turned = glm::transpose(turn(degrees));
  for (const double depth : {depths.nearest, depths.farthest}) {
    const double reach = first.orthographic ? 1 : depth;
    for (const double x : {0.0, double(width)}) {
      for (const double y : {0.0, double(height)}) {
        const dvec3 corner(reach * (x - first.cx) / first.fx, reach * (first.cy - y) / first.fy, depths.median - depth);
        corners[i++] = to_turned * corner;
      }
    }
  }
  return corners;
}

double nearest_to_eye(const Corners& corners) {
  double z = corners[0].z;
  for (const dvec3& corner : corners) z = std::max(z, corner.z);
  return z;
}

/// `camera` with the focal lengths and the principal point that bring all corners into the image, at a distance at which all lie
/// in front.
Camera fitted(Camera camera, int width, int height, const Corners& corners, double distance) {
  dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const dvec3& corner : corners) {
    const dvec2 seen = dvec2(corner) / (camera.orthographic ? 1 : distance - corner.z);
    low = glm::min(low, seen);
    high = glm::max(high, seen);
  }
  const double shape = camera.fy / camera.fx;
  const dvec2 size = spare * (high - low), middle = 0.5 * (low + high);
  camera.fx = std::min(width / size.x, height / (size.y * shape));
  camera.fy = camera.fx * shape;
  camera.cx = 0.5 * width - camera.fx * middle.x;
  camera.cy = 0.5 * height + camera.fy * middle.y;
  return camera;
}

bool is_too_wide(const Camera& camera, int width, int height) {
  const double most = std::tan(glm::radians(widest_degrees));
  return std::max(camera.cx, width - camera.cx) > most * camera.fx ||
         std::max(camera.cy, height - camera.cy) > most * camera.fy;
}

/// The least distance from the pivot, at least `distance`, from which the corners are visible.
double fitting_distance(const Camera& camera, int width, int height, const Corners& corners, double distance) {
  const double nearest = nearest_to_eye(corners);
  if (camera.orthographic) {
    double farthest = nearest;
    for (const dvec3& corner : corners) farthest = std::min(farthest, corner.z);
    return std::max(distance, nearest + (spare - 1) * (nearest - farthest));
  }
  const auto fits = [&](double at) {
    return at > nearest && !is_too_wide(fitted(camera, width, height, corners, at), width, height);
  };
  double far = distance;
  while (!fits(far)) far *= 2;
  if (far == distance) return distance;
  double near = 0.5 * far;
  for (int i = 0; i < 50; ++i) (fits(0.5 * (near + far)) ? far : near) = 0.5 * (near + far);
  return far;
}

}  // namespace

std::optional<VisibleDepths> visible_depths(const Channel& depth) {
  std::vector<float> depths;
  for (int y = 0; y < depth.layout().height; ++y) {
    for (int x = 0; x < depth.layout().width; ++x) {
      if (!is_background(depth.at(x, y))) depths.push_back(depth.at(x, y));
    }
  }
  if (depths.empty()) return {};
  const auto percentile = [&](int percent) {
    const auto at = depths.begin() + std::ptrdiff_t(size_t(percent) * (depths.size() - 1) / 100);
    std::nth_element(depths.begin(), at, depths.end());
    return double(*at);
  };
  return VisibleDepths{percentile(2), percentile(50), percentile(98)};
}

Camera secondary_camera(const Camera& first, int width, int height, const VisibleDepths& depths, double degrees) {
  const Corners corners = turned_corners(first, width, height, depths, degrees);
  const double distance = fitting_distance(first, width, height, corners, depths.median);
  Camera second = fitted(first, width, height, corners, distance);
  const dvec3 eye = dvec3(0, 0, -depths.median) + turn(degrees) * dvec3(0, 0, distance);
  second.pose = moved(*first.pose, eye, degrees);
  second.near.reset();
  second.far.reset();
  second.source = fmt::format("{}, turned {:g} degrees", first.source, degrees);
  return second;
}

}  // namespace gloam
