// Normals from depth against the normals of surfaces known in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "support/estimate.h"

namespace gloam::test::normals_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

Frame normals_of(const Shot& shot, const Scene& scene) {
  Frame frame = shoot(shot, scene, false);
  return outputs_of(find_technique("normals"), frame, {}, {.math = Math::precise});
}

glm::dvec3 normal_at(const Frame& frame, int x, int y) { return vector_at(frame, "normal", x, y); }

/// Radians; exact for small angles too.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Whether a pixel has a surface on either side along both axes: otherwise the tilt along one is unknown.
bool has_neighbours(const Frame& frame, int x, int y) {
  const auto seen = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < frame.width() && y < frame.height() && glm::length(normal_at(frame, x, y)) > 0;
  };
  return (seen(x - 1, y) || seen(x + 1, y)) && (seen(x, y - 1) || seen(x, y + 1));
}

double worst_on_plane(const Shot& shot, double tilt, double turn) {
  const Scene plane = tilted_plane(3, tilt, turn);
  const Frame out = normals_of(shot, plane);
  double worst = 0;
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      const auto seen = plane(ray_through(shot, x + 0.5, y + 0.5));
      if (!seen || !has_neighbours(out, x, y)) continue;
      const double off = angle_between(normal_at(out, x, y), seen->normal);
      worst = std::max(worst, off);
    }
  }
  return worst;
}

/// Each depth is rounded by up to 6e-8 of itself: two of them over the width of a pixel, on two axes. Away from the axis of view,
/// a pixel's ray is longer than its depth, most in the corner of the image.
double rounding_bound(const Shot& shot, double depth) {
  const double per_axis = 1.2e-7 * shot.camera.fx * (shot.camera.orthographic ? depth : 1);
  return std::sqrt(2.0) * per_axis * glm::length(ray_through(shot, 0, 0).direction);
}

TEST(NormalsFromDepth, PlaneAtAnyTilt) {
  for (const Shot& shot : {perspective(160, 120), orthographic(160, 120, 0.05), perspective(1920, 6)}) {
    double worst = 0;
    for (const double tilt : {0.0, 20.0, 45.0, 70.0, 85.0, 89.0}) {
      for (const double turn : {0.0, 30.0, 90.0, 200.0})
        worst = std::max(worst, worst_on_plane(shot, tilt * degree, turn * degree));
    }
    const double bound = rounding_bound(shot, 3);
    std::printf(
        "normals, plane tilted up to 89 degrees, %d pixels across, %s: largest error %.2g rad, bound %.2g from the "
        "rounding of depths\n",
        shot.width, shot.camera.orthographic ? "orthographic" : "perspective", worst, bound);
    EXPECT_LE(worst, bound);
    if (shot.width == 160 && !shot.camera.orthographic) {
      EXPECT_LE(worst, 1e-4);
    }
  }
}

TEST(NormalsFromDepth, Ball) {
  const Shot shot = orthographic(200, 200, 2.5);
  const Scene ball = [](const EyeRay& ray) -> std::optional<Surface> {
    const double square = 1 - ray.origin.x * ray.origin.x - ray.origin.y * ray.origin.y;
    if (square <= 0) return {};
    return Surface{3 - std::sqrt(square), {ray.origin.x, ray.origin.y, std::sqrt(square)}};
  };
  const Frame out = normals_of(shot, ball);
  double worst = 0, largest = 0;
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      const auto seen = ball(ray_through(shot, x + 0.5, y + 0.5));
      if (!seen || seen->normal.z < 0.5) continue;
      // A chord from the pixel to its neighbour is tangent halfway: half a pixel off on each axis, and a steeper pixel covers
      // more of the ball.
      const double half_pixel = 0.5 / shot.camera.fx, bound = std::sqrt(2.0) * half_pixel / seen->normal.z;
      const double error = angle_between(normal_at(out, x, y), seen->normal);
      worst = std::max(worst, error / bound);
      largest = std::max(largest, error);
    }
  }
  std::printf(
      "normals, ball of radius 80 pixels, up to 60 degrees from facing: largest error %.2g rad, %.2f of half a pixel\n",
      largest, worst);
  EXPECT_LE(worst, 1.05);
}

}  // namespace
}  // namespace gloam::test::normals_test
