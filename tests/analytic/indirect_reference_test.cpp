// Ray-traced light from the surfaces around against closed forms.
#include "gloam/scene/indirect_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "gloam/error.h"
#include "scene/built_in/mesh_builder.h"
#include "support/traced_scene.h"

namespace gloam::test::indirect_reference_test {
using gloam::Scene;
namespace {

using glm::dvec3;
using glm::vec3;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Takes all light from a scene.
void darken(Scene& scene) {
  scene.light.sun = scene.light.zenith = scene.light.horizon = scene.light.ground = vec3(0);
  scene.light.sun_angle_degrees = 0;
}

Reference traced(const Tracer& tracer, const Frame& frame, double radius, int samples) {
  return indirect_reference(tracer, frame, {.radius = radius, .samples = samples});
}

// Walls that shine with 1 all around give 1 everywhere.
TEST(IndirectReference, Furnace) {
  Scene scene = scene_with(looking_at("main", {0.3, 0.2, 0.1}, {1, 0.4, 0}, 70));
  scenes::add_box(mesh_of(scene, "room"), {-1, -1, -1}, {1, 1, 1});
  darken(scene);
  scene.materials[0].emission = vec3(1);
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 16, 9);
  const Comparison all = compared_with(frame, traced(tracer, frame, infinity, 64), "indirect",
                                       [](const PixelOfFrame&) { return dvec3(1); });
  EXPECT_LT(all.worst, 1e-6);
  // Within a radius: the closed share of the directions, by the same rays.
  const Reference ao = ao_reference(tracer, frame, {.radius = 1, .samples = 64});
  const Channel& open = ao.frame.views[0].planes.at("ao").channels[0];
  const Comparison near =
      compared_with(frame, traced(tracer, frame, 1, 64), "indirect",
                    [&](const PixelOfFrame& pixel) { return dvec3(1.0 - double(open.at(pixel.x, pixel.y))); });
  EXPECT_LT(near.worst, 1e-6);
}

/// Form factor from a point to a rectangle at right angles to its surface: the point's distance from the rectangle's plane is `a`,
/// the rectangle reaches from the point's foot by `b` to one side and `c` up (Howell, configuration B-3).
double form_factor(double a, double b, double c) {
  const double far = std::hypot(a, c);
  return (std::atan(b / a) - a / far * std::atan(b / far)) / (2 * glm::pi<double>());
}

/// A floor and a wall of this height and half length, which has a material of its own.
Scene corner_with_wall(float height, float half_length) {
  Scene scene = scene_with(looking_at("main", {2.2, 1.6, 1.2}, {0.5, 0, 0}, 50));
  scenes::add_material(scene, "wall", vec3(0));
  add_floor(scene, 40);
  scenes::add_quad(mesh_of(scene, "wall", 1), {0, 0, half_length}, {0, 0, -half_length}, {0, height, -half_length},
                   {0, height, half_length});
  darken(scene);
  return scene;
}

/// Floor pixels before the wall get `radiance` times the wall's form factor.
Comparison compared_with_wall(const Frame& frame, const Reference& reference, double height, double half_length,
                              const dvec3& radiance) {
  return compared_with(frame, reference, "indirect", [&](const PixelOfFrame& pixel) -> std::optional<dvec3> {
    const dvec3& p = pixel.position;
    if (pixel.mesh != 1 || p.x < 0.02) return {};
    return radiance * (form_factor(p.x, half_length - p.z, height) + form_factor(p.x, half_length + p.z, height));
  });
}

TEST(IndirectReference, ShiningWall) {
  const dvec3 emission(4, 1, 0.25);
  Scene scene = corner_with_wall(0.7f, 0.9f);
  scene.materials[1].emission = vec3(emission);
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 16, 9);
  const Reference reference = traced(tracer, frame, infinity, 16384);
  const Comparison c = compared_with_wall(frame, reference, 0.7, 0.9, emission);
  EXPECT_LT(c.worst, 4e-3);
  EXPECT_LT(std::abs(c.mean), 2e-4);
}

// A coloured wall that a sun without a disc lights; the floor gets its light by one reflection.
TEST(IndirectReference, SunlitColouredWall) {
  Scene scene = corner_with_wall(0.7f, 0.9f);
  const dvec3 albedo(0.9, 0.5, 0.1), sun(3, 2, 1), to_sun(1, 0.4, 0.2);
  scene.materials[1].albedo = vec3(albedo);
  scene.light.sun = vec3(sun);
  scene.light.to_sun = vec3(to_sun);
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 16, 9);
  const dvec3 radiance = albedo * sun * glm::normalize(to_sun).x / glm::pi<double>();
  const Comparison c = compared_with_wall(frame, traced(tracer, frame, infinity, 16384), 0.7, 0.9, radiance);
  EXPECT_LT(c.worst, 1e-3);
  EXPECT_LT(std::abs(c.mean), 5e-5);
}

// Seen from behind, the wall is in its own shadow.
TEST(IndirectReference, SunBehindTheWallGivesNothing) {
  Scene scene = corner_with_wall(0.7f, 0.9f);
  scene.materials[1].albedo = vec3(1);
  scene.light.sun = vec3(3);
  scene.light.to_sun = vec3(-1, 0.4f, 0.2f);
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 16, 9);
  const Comparison c = compared_with_wall(frame, traced(tracer, frame, infinity, 64), 0.7, 0.9, dvec3(0));
  EXPECT_EQ(c.worst, 0);
}

TEST(IndirectReference, StatesWhatItIs) {
  Scene scene = corner_with_wall(0.7f, 0.9f);
  scene.materials[1].emission = vec3(1);
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 16, 9);
  const Reference a = traced(tracer, frame, 0.5, 50), b = traced(tracer, frame, 0.5, 2000);
  EXPECT_EQ(a.frame.numbers.at("indirectSamples"), 64);
  EXPECT_EQ(a.frame.numbers.at("indirectRadius"), 0.5);
  EXPECT_EQ(a.frame.numbers.at("indirectNoise"), a.noise);
  EXPECT_EQ(a.frame.attributes.at("gloamScene"), "test");
  EXPECT_NE(a.frame.attributes.at("indirectDefinition"), "");
  EXPECT_LT(b.noise, 0.5 * a.noise);
}

TEST(IndirectReference, RefusesScenesWithoutLight) {
  const auto message = [](const std::function<void(Scene&)>& change) {
    Scene scene = corner_of_meshes();
    const Tracer tracer(scene);
    const Frame frame = frame_of(tracer, 16, 9);
    change(scene);
    try {
      traced(tracer, frame, 0.5, 32);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message([](Scene&) {}), "");
  EXPECT_NE(message(darken).find("test: has no light"), std::string::npos);
  EXPECT_EQ(message([](Scene& scene) { darken(scene), scene.materials[0].emission = vec3(1); }), "");
  EXPECT_NE(message([](Scene& scene) { scene.light.sun.y = -1; }).find("the light of the sun is 2.6, -1, 1.9"),
            std::string::npos);
  EXPECT_NE(message([](Scene& scene) { scene.materials[0].emission = vec3(NAN); }).find("emission of material 'grey'"),
            std::string::npos);
  EXPECT_NE(message([](Scene& scene) { scene.light.to_sun = vec3(0); }).find("direction of the sun is 0, 0, 0"),
            std::string::npos);
  EXPECT_NE(message([](Scene& scene) { scene.materials[0].albedo = vec3(2); }).find("albedo 2, 2, 2"),
            std::string::npos);
}

}  // namespace
}  // namespace gloam::test::indirect_reference_test
