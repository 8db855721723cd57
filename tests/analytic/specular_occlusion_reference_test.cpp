// Ray-traced specular occlusion against mirrors in closed form and against lobes integrated in double.
#include "gloam/scene/specular_occlusion_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "gloam/error.h"
#include "support/traced_scene.h"

namespace gloam::test::specular_occlusion_reference_test {
using gloam::Scene;
namespace {

using glm::dvec3;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A corner without end, or a floor alone, of this roughness.
Scene rough_corner(float roughness, bool has_wall = true) {
  Scene scene = corner_of_meshes(4000);
  scene.materials[0].roughness = roughness;
  if (!has_wall) scene.meshes.pop_back();
  return scene;
}

/// GGX times height-correlated Smith (Heitz 2014), without factors that are the same in all directions; z up.
double lobe(double alpha, const dvec3& v, const dvec3& l) {
  const dvec3 h = glm::normalize(v + l);
  const double a2 = alpha * alpha, d = h.z * h.z * (a2 - 1) + 1;
  const double smith = l.z * std::sqrt(a2 + (1 - a2) * v.z * v.z) + v.z * std::sqrt(a2 + (1 - a2) * l.z * l.z);
  return 1 / (d * d) / smith * l.z;
}

/// Share of the lobe about +y seen from `to_eye` that `is_open` lets through. A rule of mid points over the hemisphere.
double open_share(double alpha, const dvec3& to_eye, const std::function<bool(const dvec3&)>& is_open) {
  const int heights = 600, turns = 1200;
  const dvec3 v(to_eye.x, to_eye.z, to_eye.y);
  double open = 0, all = 0;
  for (int i = 0; i < heights; ++i) {
    // Steps that are even in the angle from the horizon.
    const double angle = glm::half_pi<double>() * (i + 0.5) / heights, z = std::sin(angle), r = std::cos(angle);
    for (int k = 0; k < turns; ++k) {
      const double turn = glm::two_pi<double>() * (k + 0.5) / turns;
      const dvec3 l(r * std::cos(turn), r * std::sin(turn), z);
      const double weight = lobe(alpha, v, l) * r;
      all += weight;
      if (is_open({l.x, l.z, l.y})) open += weight;
    }
  }
  return open / all;
}

Reference traced(const Tracer& tracer, const Frame& frame, double radius, int samples) {
  return specular_occlusion_reference(tracer, frame, {.radius = radius, .samples = samples});
}

// The lobe is half closed by a wall without end.
TEST(SpecularOcclusionReference, FloorBesideAWall) {
  for (const float roughness : {0.3f, 0.6f, 1.0f}) {
    const Scene scene = rough_corner(roughness);
    const Tracer tracer(scene);
    const Frame frame = frame_of(tracer, 12, 7);
    const Reference reference = traced(tracer, frame, infinity, 16384);
    const double alpha = double(roughness) * double(roughness);
    double least = 1, most = 0;
    const Comparison c =
        compared_with(frame, reference, "specular_occlusion", [&](const PixelOfFrame& pixel) -> std::optional<dvec3> {
          if (pixel.mesh != 1 || pixel.position.x < 1e-3) return {};
          const double share = open_share(alpha, pixel.to_eye, [](const dvec3& l) { return l.x > 0; });
          least = std::min(least, share), most = std::max(most, share);
          return dvec3(share);
        });
    std::printf("roughness %g: shares from %.3f to %.3f\n", double(roughness), least, most);
    // At roughness 1 a microfacet faces each way as likely, so that half is open whatever the eye sees.
    if (roughness < 1)
      EXPECT_GT(most - least, 0.1);
    else
      EXPECT_NEAR(least, 0.5, 1e-9);
    EXPECT_LT(c.worst, 2e-3);
    EXPECT_LT(c.rms, 3 * reference.noise + 2e-4);
  }
}

// Within a radius the wall closes directions whose sine towards it is above its distance in radii.
TEST(SpecularOcclusionReference, FloorBesideAWallWithinARadius) {
  const double radius = 0.8;
  const Scene scene = rough_corner(0.6f);
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 12, 7);
  const Reference reference = traced(tracer, frame, radius, 16384);
  const Comparison c =
      compared_with(frame, reference, "specular_occlusion", [&](const PixelOfFrame& pixel) -> std::optional<dvec3> {
        if (pixel.mesh != 1) return {};
        return dvec3(open_share(0.36, pixel.to_eye, [&](const dvec3& l) { return -l.x * radius < pixel.position.x; }));
      });
  EXPECT_LT(c.worst, 3e-3);
}

// A mirror has one direction: closed if it meets the wall within the radius, else open.
TEST(SpecularOcclusionReference, Mirror) {
  const Scene scene = rough_corner(0);
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 64, 36);
  for (const double radius : {0.5, infinity}) {
    const Reference reference = traced(tracer, frame, radius, 256);
    int open = 0, closed = 0;
    const Comparison c =
        compared_with(frame, reference, "specular_occlusion", [&](const PixelOfFrame& pixel) -> std::optional<dvec3> {
          const bool on_floor = pixel.mesh == 1;
          // Towards the other plate, and how far that is.
          const double towards = on_floor ? pixel.to_eye.x : pixel.to_eye.y,
                       distance = on_floor ? pixel.position.x : pixel.position.y;
          const bool is_closed = towards > 0 && distance < radius * towards;
          if (std::abs(distance - radius * towards) < 1e-4) return {};
          ++(is_closed ? closed : open);
          return dvec3(is_closed ? 0 : 1);
        });
    EXPECT_EQ(c.worst, 0);
    EXPECT_EQ(reference.noise, 0);
    EXPECT_GT(closed, 100);
    EXPECT_GT(open + (radius == infinity ? 1000 : 0), 100);
  }
}

TEST(SpecularOcclusionReference, PlaneIsOpenAtAnyAngle) {
  for (const float roughness : {0.0f, 0.1f, 0.5f, 1.0f}) {
    Scene scene = rough_corner(roughness, false);
    scene.cameras = {looking_at("main", {0, 0.05, 0}, {3, 0, 0}, 60)};
    const Tracer tracer(scene);
    const Frame frame = frame_of(tracer, 16, 10);
    const Comparison c = compared_with(frame, traced(tracer, frame, 0.5, 64), "specular_occlusion",
                                       [](const PixelOfFrame&) { return dvec3(1); });
    EXPECT_LT(c.worst, 1e-6);
  }
}

// The frame's roughness counts, not the scene's; a frame without one has the scene's.
TEST(SpecularOcclusionReference, RoughnessIsTheFrames) {
  const Scene scene = rough_corner(0.6f), other = rough_corner(0.0f);
  const Tracer tracer(scene), mirrors(other);
  Frame frame = frame_of(tracer, 12, 7);
  const auto value = [](const Reference& r) {
    return r.frame.views[0].planes.at("specular_occlusion").channels[0].at(6, 4);
  };
  const Reference with = traced(mirrors, frame, infinity, 64), own = traced(tracer, frame, infinity, 64);
  EXPECT_EQ(value(with), value(own));
  frame.views[0].planes.erase("roughness");
  EXPECT_EQ(value(traced(tracer, frame, infinity, 64)), value(own));
  EXPECT_NE(value(traced(mirrors, frame, infinity, 64)), value(own));
  EXPECT_EQ(own.frame.numbers.at("specular_occlusionSamples"), 64);
  EXPECT_EQ(own.frame.numbers.at("specular_occlusionNoise"), own.noise);
  EXPECT_EQ(own.frame.numbers.at("specular_occlusionRadius"), infinity);
  EXPECT_THROW(traced(tracer, frame, 0, 64), UsageError);
  EXPECT_THROW(traced(tracer, frame, infinity, 0), UsageError);
}

}  // namespace
}  // namespace gloam::test::specular_occlusion_reference_test
