// The truth of whole pictures, where light has a closed form.
#include "gloam/scene/composite_reference.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "gloam/error.h"
#include "scene/built_in/mesh_builder.h"
#include "support/traced_scene.h"
#include "unit/message_of.h"

namespace gloam::test::composite_reference_test {
using gloam::Scene;
namespace {

using glm::dvec3;
using glm::vec3;

constexpr float infinity = std::numeric_limits<float>::infinity();

void set_sky(Scene& scene, const vec3& radiance) {
  scene.light.sun = vec3(0);
  scene.light.zenith = scene.light.horizon = scene.light.ground = radiance;
}

Frame frame_with_light(const Tracer& tracer, int width, int height) {
  CaptureOptions options;
  options.width = width;
  options.height = height;
  options.planes = {"normal", "position", "instance",  "color",      "ambient",
                    "albedo", "metallic", "roughness", "reflectance"};
  options.views = {{"", camera_for(tracer.scene().cameras.front(), width, height), {}}};
  return std::move(capture(tracer, options).frame);
}

/// Diffuse light alone: what glossy surfaces mirror has no closed form here.
Reference diffuse_picture(const Tracer& tracer, const Frame& frame, int samples) {
  CompositeReferenceOptions options;
  options.radius = infinity;
  options.samples = samples;
  options.holds = parse_color_holds("ambient,shadows,reflection", "test");
  return composite_reference(tracer, frame, options);
}

// Walls that shine with 1 all around get 1 from each other: they send 1 + albedo.
TEST(CompositeReference, Furnace) {
  Scene scene = scene_with(looking_at("main", {0.3, 0.2, 0.1}, {1, 0.4, 0}, 70));
  scenes::add_box(mesh_of(scene, "room"), {-1, -1, -1}, {1, 1, 1});
  set_sky(scene, vec3(0));
  scene.materials[0].albedo = vec3(0.9f, 0.5f, 0.1f);
  scene.materials[0].emission = vec3(1);
  const Tracer tracer(scene);
  const Frame frame = frame_with_light(tracer, 16, 9);
  const Comparison c = compared_with(frame, diffuse_picture(tracer, frame, 64), "color",
                                     [](const PixelOfFrame&) { return dvec3(1.9, 1.5, 1.1); });
  EXPECT_LT(c.worst, 1e-6);
}

/// Form factor from a point to a rectangle at right angles to its surface: `a` before the rectangle's plane, which reaches `b` to one
/// side and `c` up (Howell, configuration B-3).
double form_factor(double a, double b, double c) {
  const double far = std::hypot(a, c);
  return (std::atan(b / a) - a / far * std::atan(b / far)) / (2 * glm::pi<double>());
}

// A floor before a wall that shines, under an even sky: the wall takes its form factor from the sky's light, and gives its own.
TEST(CompositeReference, CornerUnderASky) {
  const dvec3 sky(0.5, 1, 2), shine(3, 1, 0.25), albedo(0.8, 0.5, 0.2);
  Scene scene = corner_of_meshes(40, 1);
  scenes::add_material(scene, "wall", vec3(0));
  scene.materials[0].albedo = vec3(albedo);
  scene.materials[1].emission = vec3(shine);
  set_sky(scene, vec3(sky));
  const Tracer tracer(scene);
  const Frame frame = frame_with_light(tracer, 16, 9);
  const Reference truth = diffuse_picture(tracer, frame, 16384);
  const Comparison c = compared_with(frame, truth, "color", [&](const PixelOfFrame& pixel) -> std::optional<dvec3> {
    const dvec3& p = pixel.position;
    if (pixel.mesh != 1 || p.x < 0.02) return {};
    const double wall = form_factor(p.x, 40 - p.z, 40) + form_factor(p.x, 40 + p.z, 40);
    return albedo * (sky * (1 - wall) + shine * wall);
  });
  EXPECT_LT(c.worst, 4e-3);
  EXPECT_LT(std::abs(c.mean), 3e-4);
  // The noise stated is that of the mean of r, g and b, in which the errors of this light, red from the wall and blue from the sky,
  // partly cancel: the components have 2.0 times as much, measured.
  EXPECT_LT(c.rms, 2.5 * truth.noise);
  EXPECT_GT(c.rms, truth.noise / 2);
}

// Metal has no diffuse light of its surroundings.
TEST(CompositeReference, MetalStaysBlack) {
  Scene scene = corner_of_meshes(40, 1);
  scenes::add_material(scene, "wall", vec3(0));
  scene.materials[0].metallic = 1;
  scene.materials[1].emission = vec3(1);
  set_sky(scene, vec3(1));
  const Tracer tracer(scene);
  const Frame frame = frame_with_light(tracer, 16, 9);
  const Comparison c = compared_with(frame, diffuse_picture(tracer, frame, 64), "color",
                                     [](const PixelOfFrame& pixel) -> std::optional<dvec3> {
                                       return pixel.mesh == 1 ? std::optional(dvec3(0)) : std::nullopt;
                                     });
  EXPECT_EQ(c.worst, 0);
}

TEST(CompositeReference, IsWhatIsComposedOfItsParts) {
  Scene scene = corner_of_meshes();
  set_sky(scene, vec3(1));
  const Tracer tracer(scene);
  const Frame frame = frame_with_light(tracer, 16, 9);
  CompositeReferenceOptions options;
  options.samples = options.reflection_samples = 32;
  const Reference truth = composite_reference(tracer, frame, options);
  EXPECT_EQ(truth.frame.attributes.at("gloamColorHolds"), "ambient,shadows,ao,indirect,reflection");
  View again = without_planes(frame.views[0]);
  for (const std::string& plane : planes_to_compose())
    if (const Plane* own = frame.views[0].find(plane)) again.planes[plane] = own->clone();
  compose(again, truth.frame.views[0], composition_of(common_planes(frame), {"ao", "indirect", "reflection"}, {}));
  for (size_t i = 0; i < 3; ++i)
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 16; ++x)
        ASSERT_EQ(std::bit_cast<uint32_t>(again.planes.at("color").channels[i].at(x, y)),
                  std::bit_cast<uint32_t>(truth.frame.views[0].planes.at("color").channels[i].at(x, y)));
  const Reference ao = ao_reference(tracer, frame, {.radius = options.radius, .samples = 32});
  EXPECT_EQ(ao.frame.views[0].planes.at("ao").channels[0].at(8, 4),
            truth.frame.views[0].planes.at("ao").channels[0].at(8, 4));
}

// Without knowing its ambient light, AO darkens all of a colour but the light that a wall sends of its own.
TEST(CompositeReference, LightOfItsOwnStays) {
  Scene scene = corner_of_meshes(40, 1);
  scenes::add_material(scene, "wall", vec3(0.5f));
  scene.materials[1].emission = vec3(3, 1, 0.25f);
  set_sky(scene, vec3(1));
  const Tracer tracer(scene);
  CaptureOptions capturing;
  capturing.width = 16;
  capturing.height = 9;
  capturing.planes = {"normal", "position", "color", "emission"};
  capturing.views = {{"", camera_for(tracer.scene().cameras.front(), 16, 9), {}}};
  const Frame frame = std::move(capture(tracer, capturing).frame);
  CompositeReferenceOptions options;
  options.samples = 32;
  options.radius = infinity;
  options.holds = parse_color_holds("ambient,shadows,indirect,reflection", "test");
  const Reference truth = composite_reference(tracer, frame, options);
  const View &from = frame.views[0], &to = truth.frame.views[0];
  int shining = 0;
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 16; ++x) {
      const float open = to.find("ao")->channels[0].at(x, y);
      for (size_t i = 0; i < 3; ++i) {
        const float colour = from.find("color")->channels[i].at(x, y),
                    emission = from.find("emission")->channels[i].at(x, y);
        ASSERT_NEAR(to.find("color")->channels[i].at(x, y), emission + (colour - emission) * open, 1e-6f);
        shining += emission > 0 && open < 0.9f;
      }
    }
  EXPECT_GT(shining, 20);
}

TEST(CompositeReference, ASunWithoutShadowsInColourGetsThem) {
  Scene scene = corner_of_meshes();
  scene.light.sun = vec3(1);
  const Tracer tracer(scene);
  const Frame frame = frame_with_light(tracer, 16, 9);
  CompositeReferenceOptions options;
  options.samples = options.reflection_samples = 32;
  EXPECT_FALSE(composite_reference(tracer, frame, options).frame.views[0].find("contact"));
  options.holds = parse_color_holds("ambient", "test");
  EXPECT_TRUE(composite_reference(tracer, frame, options).frame.views[0].find("contact"));
  Frame colourless = frame_of(tracer, 16, 9);
  EXPECT_NE(message_of([&] { composite_reference(tracer, colourless, options); }).find("no 'color'"),
            std::string::npos);
}

}  // namespace
}  // namespace gloam::test::composite_reference_test
