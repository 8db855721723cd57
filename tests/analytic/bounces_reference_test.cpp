// Ray-traced ambient light with interreflection against closed forms.
#include "gloam/scene/bounces_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "gloam/error.h"
#include "scene/built_in/mesh_builder.h"
#include "support/traced_scene.h"

namespace gloam::test::bounces_reference_test {
using gloam::Scene;
namespace {

using glm::dvec3;
using glm::vec3;

constexpr double infinity = std::numeric_limits<double>::infinity();

BouncesReferenceOptions options_with(double radius, int samples, int bounces = 128) {
  BouncesReferenceOptions options;
  options.radius = radius;
  options.samples = samples;
  options.bounces = bounces;
  return options;
}

void colour(Scene& scene, int material, const vec3& albedo) { scene.materials[size_t(material)].albedo = albedo; }

// No light comes in, however much the walls reflect.
TEST(BouncesReference, ClosedRoomIsDark) {
  Scene scene = scene_with(looking_at("main", {0.3, 0.2, 0.1}, {1, 0.4, 0}, 70));
  scenes::add_box(mesh_of(scene, "room"), {-1, -1, -1}, {1, 1, 1});
  colour(scene, 0, vec3(1, 0.9f, 0.5f));
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 16, 9);
  const Reference traced = bounces_reference(tracer, frame, options_with(infinity, 64));
  const Comparison c = compared_with(frame, traced, "bounces", [](const PixelOfFrame&) { return dvec3(0); });
  EXPECT_EQ(c.worst, 0);
}

// A ball with an opening: its inside sees itself with form factors that are the same everywhere, so that with an opening of the
// share f of the ball G = f + (1 - f) albedo G.
TEST(BouncesReference, IntegratingSphere) {
  const int segments = 256, rings = 128, open_rings = 32;
  Scene scene = scene_with(looking_at("main", {0.1, 0.1, 0.05}, {0.2, -1, 0.1}, 75));
  Mesh& ball = mesh_of(scene, "ball");
  scenes::add_sphere(ball, vec3(0), 1, segments, rings);
  const double height = std::cos(glm::pi<double>() * open_rings / rings), f = (1 - height) / 2;
  std::erase_if(ball.triangles, [&](const glm::uvec3& t) {
    return (ball.positions[t.x].y + ball.positions[t.y].y + ball.positions[t.z].y) / 3 > float(height);
  });
  const dvec3 albedo(0.3, 0.6, 0.95);
  colour(scene, 0, vec3(albedo));
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 16, 9);
  const Reference traced = bounces_reference(tracer, frame, options_with(infinity, 2048));
  const dvec3 truth = f / (1.0 - (1 - f) * albedo);
  const Comparison c = compared_with(frame, traced, "bounces", [&](const PixelOfFrame&) { return truth; });
  EXPECT_LT(c.worst, 2.5e-2);
  EXPECT_LT(std::abs(c.mean), 1.5e-3);
  EXPECT_LT(c.rms, 3 * traced.noise);
  EXPECT_GT(c.rms, traced.noise / 3);
}

// Plates without end that meet at 90 degrees fill half of each other's view from every point: with colours p and q of the plates,
// G on p is 1/2 + 1/2 q G on q, and likewise on q.
TEST(BouncesReference, CornerOfTwoColours) {
  Scene scene = corner_of_meshes(4000, 0);
  scenes::add_material(scene, "wall", vec3(0));
  scene.meshes[1].material = 1;
  const dvec3 p(0.9, 0.5, 0.1), q(0.2, 0.7, 1.0);
  colour(scene, 0, vec3(p));
  colour(scene, 1, vec3(q));
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 16, 9);
  const Reference traced = bounces_reference(tracer, frame, options_with(infinity, 8192));
  const Comparison c = compared_with(frame, traced, "bounces", [&](const PixelOfFrame& pixel) {
    return (0.5 + 0.25 * (pixel.mesh == 1 ? q : p)) / (1.0 - 0.25 * p * q);
  });
  EXPECT_LT(c.worst, 1.5e-2);
  EXPECT_LT(std::abs(c.mean), 1e-3);
}

/// Directions towards +x that lie on the unit disc beyond x = c, as a share of the disc.
double beyond(double c) { return c >= 1 ? 0 : (std::acos(c) - c * std::sqrt(1 - c * c)) / glm::pi<double>(); }

// One reflection within a radius: where a direction meets the other plate at height b, that plate is open but for `beyond(b / R)`.
TEST(BouncesReference, OneReflectionWithinARadius) {
  const double radius = 0.8, albedo = 0.7;
  Scene scene = corner_of_meshes();
  colour(scene, 0, vec3(float(albedo)));
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 16, 9);
  const Reference traced = bounces_reference(tracer, frame, options_with(radius, 8192, 1));
  const auto truth = [&](double a) {
    const int steps = 400;
    double reflected = 0;
    for (int i = 0; i < steps; ++i) {
      const double x = (i + 0.5) / steps, reach = std::sqrt(1 - x * x);  // sine towards the other plate
      if (a / x >= radius) continue;
      for (int k = 0; k < steps; ++k) {
        const double y = reach * (2 * (k + 0.5) / steps - 1), up = std::sqrt(std::max(0.0, 1 - x * x - y * y));
        reflected += (1 - beyond(a * up / x / radius)) * (2 * reach / steps) / steps;
      }
    }
    return 1 - beyond(a / radius) + albedo * reflected / glm::pi<double>();
  };
  const Comparison c = compared_with(frame, traced, "bounces", [&](const PixelOfFrame& pixel) -> std::optional<dvec3> {
    const double a = pixel.mesh == 1 ? pixel.position.x : pixel.position.y;
    if (a < 1e-6) return {};
    return dvec3(truth(a));
  });
  EXPECT_LT(c.worst, 1.5e-2);
  EXPECT_LT(std::abs(c.mean), 1e-3);
}

// The same rays as those of AO: without reflections, and with black surfaces, it is AO.
TEST(BouncesReference, WithoutReflectionsItIsAo) {
  Scene scene = corner_of_meshes();
  colour(scene, 0, vec3(0));
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 32, 18);
  const Reference ao = ao_reference(tracer, frame, {.radius = 0.8, .samples = 256});
  const Channel& open = ao.frame.views[0].planes.at("ao").channels[0];
  for (const int bounces : {0, 128}) {
    const Reference traced = bounces_reference(tracer, frame, options_with(0.8, 256, bounces));
    const Comparison c = compared_with(frame, traced, "bounces",
                                       [&](const PixelOfFrame& pixel) { return dvec3(open.at(pixel.x, pixel.y)); });
    EXPECT_LT(c.worst, 1e-6);
  }
}

TEST(BouncesReference, StatesWhatItIs) {
  const Scene scene = corner_of_meshes();
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 16, 9);
  const Reference a = bounces_reference(tracer, frame, options_with(0.8, 50, 3)),
                  b = bounces_reference(tracer, frame, options_with(0.8, 2000, 3));
  EXPECT_EQ(a.frame.numbers.at("bouncesSamples"), 64);
  EXPECT_EQ(a.frame.numbers.at("bouncesMost"), 3);
  EXPECT_EQ(a.frame.numbers.at("bouncesRadius"), 0.8);
  EXPECT_EQ(a.frame.numbers.at("bouncesNoise"), a.noise);
  EXPECT_EQ(a.frame.attributes.at("gloamScene"), "test");
  EXPECT_NE(a.frame.attributes.at("bouncesDefinition"), "");
  EXPECT_LT(b.noise, 0.5 * a.noise);
}

TEST(BouncesReference, RefusesSurfacesThatReflectMoreThanTheyGet) {
  Scene scene = corner_of_meshes();
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 16, 9);
  for (const float wrong : {1.25f, -0.25f, std::numeric_limits<float>::quiet_NaN()}) {
    colour(scene, 0, vec3(0.5f, wrong, 0.5f));
    try {
      bounces_reference(tracer, frame, options_with(0.8, 32));
      FAIL() << "an albedo of " << wrong << " was taken";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("material 'grey' has the albedo 0.5, "), std::string::npos)
          << error.what();
    }
  }
  colour(scene, 0, vec3(0.5f));
  EXPECT_THROW(bounces_reference(tracer, frame, options_with(0.8, 32, -1)), UsageError);
  EXPECT_THROW(bounces_reference(tracer, frame, options_with(std::nan(""), 32)), UsageError);
}

}  // namespace
}  // namespace gloam::test::bounces_reference_test
