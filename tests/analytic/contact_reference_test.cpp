// Ray-traced contact shadows against outlines and penumbrae in closed form.
#include "gloam/scene/contact_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "gloam/error.h"
#include "scene/built_in/mesh_builder.h"
#include "support/traced_scene.h"

namespace gloam::test::contact_reference_test {
using gloam::Scene;
namespace {

using glm::dvec3;
using glm::vec3;

constexpr double infinity = std::numeric_limits<double>::infinity();
const dvec3 centre(0, 0.8, 0);
constexpr double radius = 0.5;

/// A ball over a floor; meshes 1 and 2.
Scene ball_over_floor() {
  Scene scene = scene_with(looking_at("main", {0, 2.5, 3}, {-0.3, 0.3, 0}, 55));
  add_floor(scene, 30);
  scenes::add_sphere(mesh_of(scene, "ball"), vec3(centre), float(radius), 512, 256);
  return scene;
}

/// What the ball does to a floor point's way towards a light: 1 lit, 0 closed; none where the ball's edge, the end of the light or of
/// the length is too near.
std::optional<dvec3> lit_past_ball(const dvec3& p, const dvec3& towards, double far) {
  const dvec3 to_centre = centre - p;
  const double along = glm::dot(to_centre, towards), beside = std::sqrt(glm::dot(to_centre, to_centre) - along * along);
  if (std::abs(beside - radius) < 2e-3) return {};
  if (along < 0 || beside > radius) return dvec3(1);
  const double entry = along - std::sqrt(radius * radius - beside * beside);
  if (std::abs(entry - far) < 2e-3) return {};
  return dvec3(entry < far ? 0 : 1);
}

/// Compares with the ball's shadow under light from `towards(p)` that is `distance(p)` away.
template <typename Towards, typename Distance>
Comparison compared_with_ball(const Frame& frame, const Reference& reference, double length, const Towards& towards,
                              const Distance& distance) {
  int lit = 0, closed = 0;
  const Comparison c =
      compared_with(frame, reference, "contact", [&](const PixelOfFrame& pixel) -> std::optional<dvec3> {
        const dvec3 d = towards(pixel.position);
        if (pixel.mesh == 2) {
          const double facing = glm::dot(d, glm::normalize(pixel.position - centre));
          if (std::abs(facing) < 0.02) return {};
          return dvec3(facing > 0 ? 1 : 0);
        }
        const std::optional<dvec3> value = lit_past_ball(pixel.position, d, std::min(length, distance(pixel.position)));
        if (value) ++(value->x > 0 ? lit : closed);
        return value;
      });
  std::printf("floor: %d pixels lit, %d closed\n", lit, closed);
  EXPECT_GT(lit, 100);
  return c;
}

TEST(ContactReference, BallUnderASun) {
  const Scene scene = ball_over_floor();
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 96, 54);
  ContactReferenceOptions options;
  options.light_direction = dvec3(2, 3, 1);
  for (const double length : {infinity, 0.9}) {
    options.radius = length;
    const Reference reference = contact_reference(tracer, frame, options);
    const Comparison c = compared_with_ball(
        frame, reference, length, [](const dvec3&) { return glm::normalize(dvec3(2, 3, 1)); },
        [](const dvec3&) { return infinity; });
    EXPECT_EQ(c.worst, 0);
    EXPECT_EQ(reference.noise, 0);
    EXPECT_TRUE(reference.notes.empty());
    EXPECT_EQ(reference.frame.numbers.at("contactLength"), length);
    EXPECT_EQ(reference.frame.numbers.at("contactSamples"), 1);
  }
}

// A lamp beyond the ball throws its shadow; one between ball and floor does not.
TEST(ContactReference, BallUnderALamp) {
  const Scene scene = ball_over_floor();
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 96, 54);
  ContactReferenceOptions options;
  options.radius = infinity;
  for (const dvec3& lamp : {dvec3(0.7, 2, 0.3), dvec3(0, 0.15, 0)}) {
    options.light_position = lamp;
    const Comparison c = compared_with_ball(
        frame, contact_reference(tracer, frame, options), infinity,
        [&](const dvec3& p) { return glm::normalize(lamp - p); },
        [&](const dvec3& p) { return glm::distance(p, lamp); });
    EXPECT_EQ(c.worst, 0);
  }
}

// Under a sheet that covers half of the sky at height h, a disc overhead with the tangent T of its angular radius is open but for a
// segment, at x / (h T) of its radius.
TEST(ContactReference, PenumbraOfAnEdge) {
  const double height = 1, degrees = 20, disc = std::tan(degrees * glm::pi<double>() / 180);
  Scene scene = scene_with(looking_at("main", {0.05, 0.9, 0.02}, {0.0, 0, 0}, 70, {0, 0, 1}));
  add_floor(scene, 50);
  scenes::add_quad(mesh_of(scene, "sheet"), {-50, 1, -50}, {0, 1, -50}, {0, 1, 50}, {-50, 1, 50});
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 32, 18);
  ContactReferenceOptions options;
  options.radius = infinity;
  options.light_direction = dvec3(0, 1, 0);
  options.light_angle = degrees;
  options.samples = 8192;
  const Reference reference = contact_reference(tracer, frame, options);
  double least = 1, most = 0;
  const Comparison c = compared_with(frame, reference, "contact", [&](const PixelOfFrame& pixel) {
    const double at = std::clamp(pixel.position.x / (height * disc), -1.0, 1.0);
    const double lit = 1 - (std::acos(at) - at * std::sqrt(1 - at * at)) / glm::pi<double>();
    least = std::min(least, lit), most = std::max(most, lit);
    return dvec3(lit);
  });
  EXPECT_LT(least, 0.05);
  EXPECT_GT(most, 0.95);
  EXPECT_LT(c.worst, 4e-3);
  EXPECT_EQ(reference.frame.numbers.at("contactSamples"), 8192);
  EXPECT_LT(c.rms, 4 * reference.noise);
}

TEST(ContactReference, SunOfTheSceneIsTheDefault) {
  Scene scene = ball_over_floor();
  scene.light.to_sun = vec3(2, 3, 1);
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 32, 18);
  ContactReferenceOptions own, given;
  given.light_direction = dvec3(4, 6, 2);
  const Channel a = contact_reference(tracer, frame, own).frame.views[0].planes.at("contact").channels[0].clone();
  const Reference b = contact_reference(tracer, frame, given);
  EXPECT_EQ(compared_with(frame, b, "contact", [&](const PixelOfFrame& p) { return dvec3(a.at(p.x, p.y)); }).worst, 0);
}

/// The note of a traced reference; empty if there is none.
std::string note_of(const ContactReferenceOptions& options) {
  const Scene scene = ball_over_floor();
  const Tracer tracer(scene);
  const Reference reference = contact_reference(tracer, frame_of(tracer, 16, 9), options);
  return reference.notes.empty() ? "" : reference.notes.front();
}

TEST(ContactReference, TellsOfALightThatReachesNothing) {
  ContactReferenceOptions inside, below, away;
  inside.light_position = centre + dvec3(0.1, 0, 0);
  inside.radius = infinity;
  below.light_position = dvec3(0, -1, 0);
  below.radius = away.radius = infinity;
  away.light_direction = dvec3(0, -1, 0.001);
  EXPECT_EQ(note_of(inside), "the light reaches no surface that the frame shows: it lies inside 'ball'");
  EXPECT_EQ(note_of(below), "the light reaches no surface that the frame shows");
  EXPECT_EQ(note_of(away), "the light reaches no surface that the frame shows");
  inside.light_position = dvec3(0, 3, 0);
  EXPECT_EQ(note_of(inside), "");
}

std::string refusal_of(const ContactReferenceOptions& options) {
  try {
    note_of(options);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(ContactReference, RefusesLightsThatAreNone) {
  ContactReferenceOptions options;
  options.light_direction = dvec3(0);
  EXPECT_EQ(refusal_of(options), "the light's direction 0,0,0 is not allowed; one that is not 0 is");
  options.light_direction = dvec3(1, NAN, 0);
  EXPECT_EQ(refusal_of(options), "the light's direction 1,nan,0 is not allowed; finite numbers are");
  options.light_position = dvec3(0, 3, 0);
  EXPECT_NE(refusal_of(options).find("leave one out"), std::string::npos);
  options.light_direction.reset();
  options.light_angle = 90;
  EXPECT_NE(refusal_of(options).find("0 to 80 degrees are"), std::string::npos);
  options.light_angle = NAN;
  EXPECT_NE(refusal_of(options), "");
}

TEST(ContactReference, RefusesASunWithoutADirection) {
  Scene scene = ball_over_floor();
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 16, 9);
  scene.light.to_sun = vec3(0);
  EXPECT_THROW(contact_reference(tracer, frame, {}), Error);
}

}  // namespace
}  // namespace gloam::test::contact_reference_test
