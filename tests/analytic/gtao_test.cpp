// gtao and bitmask against the integrals that their samples estimate, in double.
//
// Slices about the line from the point to the eye divide the hemisphere. In each, every surface seen along the slice's line on
// the screen, and within the radius, has an elevation above the tangent. gtao closes everything below the highest one on each
// side; bitmask closes the range between each elevation and that of the point `thickness` further from the eye. AO is the
// remaining mass,
//   1/pi * integral over slices and angles of max(0, n.d) |sin(angle to the eye)|.
//
// Once over the surface of the pixels, each as deep as its centre: the estimate converges to that everywhere, also beside
// outlines. Once over the smooth surface itself: this includes the error of reading pixel centres.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "support/integral.h"
#include "support/long.h"

namespace gloam::test::gtao_test {
namespace {

constexpr double radius = 0.8, pi = std::numbers::pi;

/// A pixel, and a slice through its point. Angles count from the line to the eye, positive towards `tangent`.
struct Slice {
  Receiver receiver;
  glm::dvec3 to_eye, tangent;
  const glm::dvec3& normal() const { return receiver.surface.normal; }
  double depth() const { return receiver.surface.depth; }
  /// The tangent, moved along the line to the eye into the plane of the point's depth.
  glm::dvec3 on_screen() const { return tangent - to_eye * (tangent.z / to_eye.z); }
};

/// Closed parts of -pi .. pi, by small bins.
constexpr int bins = 4096;
using Closed = std::vector<char>;

/// Closes the bins whose centres lie between two angles.
void close(Closed& closed, double from, double to) {
  const auto first_above = [](double angle) { return int(std::ceil((angle + pi) / (2 * pi) * bins - 0.5)); };
  const int first = std::max(0, first_above(std::min(from, to))), end = std::min(bins, first_above(std::max(from, to)));
  std::fill(closed.begin() + std::min(first, end), closed.begin() + end, 1);
}

/// Position of a visible surface in the slice: towards the tangent, and towards the eye.
using Place = std::function<std::optional<glm::dvec2>(const Slice&, double x, double y)>;

/// For the smooth surface: exactly on the slice.
Place on_surface(const IntegralCase& test) {
  return [&test](const Slice& slice, double x, double y) -> std::optional<glm::dvec2> {
    const auto v = towards(test, slice.receiver, {x, y});
    if (!v) return {};
    return glm::dvec2(glm::dot(*v, slice.tangent), glm::dot(*v, slice.to_eye));
  };
}

/// For the surface of the pixels: a pixel's centre lies beside the slice, and is moved into it along the tangent plane.
Place on_pixels(const IntegralCase& test, const Channel& depths) {
  return [&test, &depths](const Slice& slice, double x, double y) -> std::optional<glm::dvec2> {
    const int px = int(std::floor(x)), py = int(std::floor(y));
    if (px < 0 || py < 0 || px >= test.shot.width || py >= test.shot.height || is_background(depths.at(px, py)))
      return {};
    const EyeRay ray = ray_through(test.shot, px + 0.5, py + 0.5);
    const glm::dvec3 v = point_at(ray, depths.at(px, py)) - slice.receiver.point;
    // The pixel's centre in the plane of the point's depth, projected onto the slice's line there.
    const glm::dvec3 line = slice.on_screen(), offset = point_at(ray, slice.depth()) - slice.receiver.point;
    const double grown = test.shot.camera.orthographic ? 1 : depths.at(px, py) / slice.depth();
    const double along = grown * glm::dot(offset, line) / glm::dot(line, line);
    const double height = glm::dot(slice.normal(), v) - along * glm::dot(slice.normal(), slice.tangent);
    return glm::dvec2(along, height / glm::dot(slice.normal(), slice.to_eye));
  };
}

void look(Closed& closed, const IntegralCase& test, glm::ivec2 pixel, const Slice& slice, double side,
          const Place& place, std::optional<double> thickness) {
  const glm::dvec3 line = slice.on_screen();
  const double reach = pixels_across(test.shot, radius, slice.depth());
  const double tangent_part = glm::dot(slice.normal(), slice.tangent),
               eye_part = glm::dot(slice.normal(), slice.to_eye);
  constexpr int steps = 1500;
  for (int k = 0; k < steps; ++k) {
    const double t = side * reach * (k + 0.5) / steps;
    const auto v = place(slice, pixel.x + 0.5 + t * line.x, pixel.y + 0.5 - t * line.y);
    if (!v || glm::length(*v) >= radius || v->x * tangent_part + v->y * eye_part <= 1e-6) continue;
    const double front = std::atan2(v->x, v->y);
    close(closed, front, thickness ? std::atan2(v->x, v->y - *thickness) : side * pi);
  }
}

/// Cosine-weighted share of the hemisphere that is open, and sum and weight of open directions by solid angle.
struct Open {
  double share = 0, weight = 0;
  glm::dvec3 sum{0.0};
};

Open open_part(const IntegralCase& test, glm::ivec2 pixel, const Place& place, std::optional<double> thickness) {
  const Receiver here = receiver_at(test, pixel);
  const glm::dvec3 to_eye = glm::normalize(-here.ray.direction);
  const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), to_eye)), y = glm::cross(to_eye, x);
  constexpr int slices = 128;
  Open open;
  for (int i = 0; i < slices; ++i) {
    const double turn = pi * (i + 0.5) / slices;
    const Slice slice{here, to_eye, std::cos(turn) * x + std::sin(turn) * y};
    Closed closed(bins, 0);
    for (const double side : {1.0, -1.0}) look(closed, test, pixel, slice, side, place, thickness);
    for (int k = 0; k < bins; ++k) {
      if (closed[size_t(k)]) continue;
      const double angle = -pi + 2 * pi * (k + 0.5) / bins;
      const glm::dvec3 direction = std::cos(angle) * slice.to_eye + std::sin(angle) * slice.tangent;
      const double cosine = glm::dot(direction, here.surface.normal);
      if (cosine <= 0) continue;
      const double solid_angle = std::abs(std::sin(angle)) * 2 * pi / bins * pi / slices;
      open.share += cosine * solid_angle / pi;
      open.sum += solid_angle * direction;
      open.weight += solid_angle;
    }
  }
  return open;
}

double integral(const IntegralCase& test, glm::ivec2 pixel, const Place& place, std::optional<double> thickness) {
  return open_part(test, pixel, place, thickness).share;
}

Settings converged(int steps) {
  return {{"radius", "0.8"}, {"directions", "32"}, {"steps", std::to_string(steps)}, {"bias", "0"}};
}

/// A smaller image, and half as many sample positions.
IntegralCase coarse(IntegralCase test) {
  constexpr int factor = 4;
  Camera& camera = test.shot.camera;
  for (double* length : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *length /= factor;
  test.shot.width /= factor;
  test.shot.height /= factor;
  for (size_t i = 0; 2 * i < test.pixels.size(); ++i) test.pixels[i] = test.pixels[2 * i] / factor;
  test.pixels.resize(test.pixels.size() / 2);
  return test;
}

void expect_on_pixels(const std::string& technique, const Settings& more, std::optional<double> thickness) {
  for (IntegralCase test : integral_cases()) {
    test = coarse(test);
    const Frame frame = shoot(test.shot, test.scene);
    const Channel& depths = frame.views[0].planes.at("depth").channels[0];
    expect_integral(
        test, technique, joined(converged(512), more),
        [&](const IntegralCase& c, glm::ivec2 pixel) { return integral(c, pixel, on_pixels(c, depths), thickness); },
        {}, 64);
  }
}

TEST(GtaoIntegral, HorizonsOfWhatPixelsShow) { expect_on_pixels("gtao", {}, {}); }

TEST(GtaoIntegral, SectorsOfWhatPixelsShow) {
  ONLY_IN_LONG_RUN();
  expect_on_pixels("bitmask", {{"thickness", "0.1"}}, 0.1 * radius);
  expect_on_pixels("bitmask", {}, 0.4 * radius);
}

TEST(GtaoIntegral, BentNormalsAndCones) {
  ONLY_IN_LONG_RUN();
  for (const bool bitmask : {false, true}) {
    const std::string technique = bitmask ? "bitmask" : "gtao";
    const std::optional<double> thickness = bitmask ? std::optional(0.4 * radius) : std::nullopt;
    double worst_angle = 0, worst_cone = 0, most_bent = 0;
    for (IntegralCase test : integral_cases()) {
      test = coarse(test);
      const Frame frame = shoot(test.shot, test.scene);
      const Channel& depths = frame.views[0].planes.at("depth").channels[0];
      const Frame out = open_directions_of(technique, frame, converged(256));
      for (const glm::ivec2 p : test.pixels) {
        const Open open = open_part(test, p, on_pixels(test, depths), thickness);
        const glm::dvec3 found = vector_at(out, "bent_normal", p.x, p.y);
        const double length = glm::length(open.sum);
        const double cone = std::clamp(2 * length / open.weight - 1, 0.0, 1.0);
        worst_angle = std::max(worst_angle, std::acos(std::min(1.0, glm::dot(found, open.sum) / length)));
        most_bent = std::max(most_bent, std::acos(glm::dot(receiver_at(test, p).surface.normal, open.sum) / length));
        worst_cone = std::max(worst_cone, std::abs(value_at(out, "cone", p.x, p.y) - cone));
      }
    }
    std::printf("%s: bent normals up to %.1f degrees off the normal, within %.2f degrees; cones within %.3f\n",
                technique.c_str(), most_bent * 180 / pi, worst_angle * 180 / pi, worst_cone);
    EXPECT_GT(most_bent, 10 * pi / 180) << "the case tests nothing";
    // 32 directions on each side of a slice, 5.6 degrees apart, and 31 sectors.
    EXPECT_LT(worst_angle, 2.5 * pi / 180);
    EXPECT_LT(worst_cone, bitmask ? 0.04 : 0.03);
  }
}

// Pixel centres lie up to half a pixel, 1/150 of the radius, beside the slice: a surface that ends at the radius is off by that
// much.
TEST(GtaoIntegral, HorizonsOverSmoothSurfaces) {
  for (const IntegralCase& test : integral_cases()) {
    if (test.name.find("corner") == std::string::npos) continue;
    expect_integral(
        test, "gtao", {{"radius", "0.8"}, {"directions", "8"}, {"steps", "512"}, {"bias", "0"}},
        [&](const IntegralCase& c, glm::ivec2 pixel) { return integral(c, pixel, on_surface(c), {}); },
        {.pixel = 3e-3, .mean = 3e-3}, 16);
  }
}

}  // namespace
}  // namespace gloam::test::gtao_test
