// Bent normals and cones of a plane: the mean open direction is the normal, and the cone is the hemisphere, at any tilt.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "gloam/planes.h"
#include "support/estimate.h"

namespace gloam::test::open_directions_test {
namespace {

struct PlaneCase {
  std::string technique;
  Settings settings;
  double normal, cone;  ///< bounds: length of the difference to the normal, cosine of the cone's half angle
};

void PrintTo(const PlaneCase& test, std::ostream* out) { *out << test.technique; }

class OpenDirections : public testing::TestWithParam<PlaneCase> {};

// Points in a ball are even only to about 1 / samples; slices and fans have pairs that cancel.
INSTANTIATE_TEST_SUITE_P(All, OpenDirections,
                         testing::Values(PlaneCase{"bitmask", {}, 1e-6, 1e-6}, PlaneCase{"gtao", {}, 1e-6, 1e-6},
                                         PlaneCase{"evidence", {}, 1e-6, 1e-6}, PlaneCase{"hbao", {}, 1e-6, 1e-6},
                                         PlaneCase{"ssao", {{"samples", "512"}}, 5e-3, 1e-4}),
                         [](const auto& info) { return identifier(info.param.technique); });

TEST_P(OpenDirections, OfAPlaneAreTheHemisphere) {
  const PlaneCase& test = GetParam();
  for (const double tilt : {0.0, 0.7, 1.2, 1.4}) {
    const Frame frame = shoot(perspective(160, 120), tilted_plane(3, tilt, 0.4));
    const Frame out = open_directions_of(test.technique, frame, test.settings);
    double furthest = 0, widest = 0;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        if (is_background(value_at(frame, "depth", x, y))) continue;
        const glm::dvec3 off = vector_at(out, "bent_normal", x, y) - vector_at(frame, "normal", x, y);
        furthest = std::max(furthest, glm::length(off));
        widest = std::max(widest, double(value_at(out, "cone", x, y)));
      }
    }
    std::printf("%s, plane tilted by %.1f: bent normals within %.2g, cones within %.2g\n", test.technique.c_str(), tilt,
                furthest, widest);
    EXPECT_LE(furthest, test.normal);
    EXPECT_LE(widest, test.cone);
  }
}

}  // namespace
}  // namespace gloam::test::open_directions_test
