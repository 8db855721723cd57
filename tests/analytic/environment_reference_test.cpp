// Ray-traced light of an environment against closed forms.
#include "gloam/scene/environment_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "support/traced_scene.h"

namespace gloam::test::environment_reference_test {
using gloam::Scene;
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::vec3;

constexpr double infinity = std::numeric_limits<double>::infinity(), pi = glm::pi<double>();

/// A map of this height with a radiance that depends on the direction.
EnvironmentMap map_of(const std::function<dvec3(const dvec3&)>& radiance, int height = 256,
                      EnvironmentAxes axes = EnvironmentAxes::openexr, double turn = 0) {
  const EnvironmentMap empty(2 * height, height, std::vector<vec3>(size_t(2 * height * height)), axes, turn);
  std::vector<vec3> texels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < 2 * height; ++x) texels.emplace_back(radiance(empty.direction({x + 0.5, y + 0.5})));
  }
  return EnvironmentMap(2 * height, height, std::move(texels), axes, turn);
}

Reference traced(const Tracer& tracer, const Frame& frame, const EnvironmentMap& map, double radius, int samples) {
  return environment_reference(tracer, frame, map, {.radius = radius, .samples = samples});
}

// With light that is the same from everywhere it is AO times that light, by the same rays.
TEST(EnvironmentReference, EvenLightIsAo) {
  const Scene scene = corner_of_meshes();
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 32, 18);
  const dvec3 light(2, 0.5, 0.125);
  const Reference ao = ao_reference(tracer, frame, {.radius = 0.8, .samples = 256});
  const Channel& open = ao.frame.views[0].planes.at("ao").channels[0];
  const Reference reference = traced(tracer, frame, map_of([&](const dvec3&) { return light; }, 16), 0.8, 256);
  const Comparison c = compared_with(frame, reference, "environment", [&](const PixelOfFrame& pixel) {
    return double(open.at(pixel.x, pixel.y)) * light;
  });
  EXPECT_LT(c.worst, 2e-6);
  EXPECT_EQ(reference.rays, ao.rays);
}

/// Light that grows with the cosine to a direction, and is 0 beyond 90 degrees.
std::function<dvec3(const dvec3&)> cosine_to(const dvec3& towards) {
  return [towards](const dvec3& d) { return dvec3(std::max(glm::dot(d, towards), 0.0)); };
}

// In a corner of plates without end, for light with the cosine to each of the axes: the mean of the cosine to the normal over an open
// hemisphere is 2/3, over half of one 1/3; to a direction at right angles to the normal, over the half on its side, 2 / (3 pi).
TEST(EnvironmentReference, CosineLightInACorner) {
  const Scene scene = corner_of_meshes(4000);
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 16, 9);
  const double own = 1.0 / 3, beside = 2 / (3 * pi);
  struct Case {
    dvec3 towards;
    double on_floor, on_wall;
  };
  for (const auto& [towards, on_floor, on_wall] :
       {Case{{0, 1, 0}, own, beside}, Case{{1, 0, 0}, beside, own}, Case{{-1, 0, 0}, 0, 0}}) {
    for (const EnvironmentAxes axes : {EnvironmentAxes::openexr, EnvironmentAxes::blender}) {
      const Reference reference = traced(tracer, frame, map_of(cosine_to(towards), 256, axes, 37), infinity, 8192);
      const Comparison c = compared_with(frame, reference, "environment", [&](const PixelOfFrame& pixel) {
        return dvec3(pixel.mesh == 1 ? on_floor : on_wall);
      });
      EXPECT_LT(c.worst, 6e-4);
      EXPECT_LT(std::abs(c.mean), 1e-4);
    }
  }
}

TEST(EnvironmentReference, CosineLightOverAPlane) {
  Scene scene = corner_of_meshes(4000);
  scene.meshes.pop_back();
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 16, 9);
  const Reference reference = traced(tracer, frame, map_of(cosine_to({0, 1, 0})), infinity, 8192);
  const Comparison c =
      compared_with(frame, reference, "environment", [](const PixelOfFrame&) { return dvec3(2.0 / 3); });
  EXPECT_LT(c.worst, 3e-4);
}

/// The integral of the interpolated radiance around a texel, times the cosine to +y, over pi.
dvec3 light_of_texel(const EnvironmentMap& map, int column, int row) {
  const int steps = 300;
  dvec3 sum(0);
  for (int i = 0; i < steps; ++i) {
    for (int k = 0; k < steps; ++k) {
      const dvec2 place(column - 1 + 3 * (k + 0.5) / steps, row - 1 + 3 * (i + 0.5) / steps);
      const dvec3 d = map.direction(place);
      const double size =
          std::sin(place.y / map.height() * pi) * (3 * pi / map.height() / steps) * (6 * pi / map.width() / steps);
      sum += map.radiance(d) * d.y * size;
    }
  }
  return sum / pi;
}

// A sun of one texel, which one in 12000 directions drawn evenly would meet.
TEST(EnvironmentReference, SunOfOneTexel) {
  Scene scene = corner_of_meshes(4000);
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 16, 9);
  const int height = 128, row = 30;
  std::vector<vec3> texels(size_t(2 * height * height), vec3(0));
  EnvironmentMap map(2 * height, height, texels);
  for (const bool is_open : {true, false}) {
    const int column = int(map.place(glm::normalize(dvec3(is_open ? 1 : -1, 1, 0.3))).x);
    std::vector<vec3> sunny = texels;
    sunny[size_t(row) * size_t(2 * height) + size_t(column)] = vec3(20000, 10000, 5000);
    const EnvironmentMap with_sun(2 * height, height, sunny);
    const dvec3 light = light_of_texel(with_sun, column, row);
    const Reference reference = traced(tracer, frame, with_sun, infinity, 256);
    const Comparison c =
        compared_with(frame, reference, "environment", [&](const PixelOfFrame& pixel) -> std::optional<dvec3> {
          if (pixel.mesh != 1) return {};
          return is_open ? light : dvec3(0);
        });
    std::printf("light %.4f, %.4f, %.4f\n", light.x, light.y, light.z);
    if (is_open)
      EXPECT_LT(c.worst, 0.01 * light.x);
    else
      EXPECT_EQ(c.worst, 0);
    EXPECT_LT(reference.noise, 2e-3 * light.x);
  }
}

TEST(EnvironmentReference, StatesWhatItIs) {
  const Scene scene = corner_of_meshes();
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 16, 9);
  const EnvironmentMap map = map_of(cosine_to({0, 1, 0}), 32);
  const Reference a = traced(tracer, frame, map, 0.8, 50), b = traced(tracer, frame, map, 0.8, 2000);
  EXPECT_EQ(a.frame.numbers.at("environmentSamples"), 64);
  EXPECT_EQ(a.frame.numbers.at("environmentRadius"), 0.8);
  EXPECT_EQ(a.frame.numbers.at("environmentNoise"), a.noise);
  EXPECT_EQ(a.frame.attributes.at("gloamScene"), "test");
  EXPECT_NE(a.frame.attributes.at("environmentDefinition"), "");
  EXPECT_LT(b.noise, 0.5 * a.noise);
}

}  // namespace
}  // namespace gloam::test::environment_reference_test
