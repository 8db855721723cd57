// What makes sets the same everywhere: rays that are decided in double, and frames in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/low_discrepancy.h"
#include "base/random.h"
#include "gloam/planes.h"
#include "gloam/scene/tracer.h"
#include "set/hard_frames.h"

namespace gloam::set_making_test {
namespace {

/// Two squares in the plane z = -3, one a little larger, whose triangles differ: any of them is met in one place.
Scene squares_in_one_place(float half, float other_half) {
  Scene scene;
  scene.name = "squares";
  scene.materials.push_back({});
  scene.cameras = {looking_at("main", {0, 0, 1}, {0, 0, 0}, 60)};
  for (const float h : {half, other_half}) {
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.positions = {{-h, -h, -3}, {h, -h, -3}, {h, h, -3}, {-h, h, -3}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  }
  return scene;
}

/// A ray from near the origin to somewhere on the squares.
TracerRay ray_at_random(Random& random) {
  const glm::dvec3 origin(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.5, 0.5));
  const glm::dvec3 target(random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9), -3);
  return {origin, glm::normalize(target - origin)};
}

constexpr int rays = 20000;

TEST(ReproducibleRays, TakeTheFirstMeshOfThoseInOnePlace) {
  for (const auto& [half, other] : {std::pair(1.0f, 1.3f), std::pair(1.3f, 1.0f)}) {
    const Scene scene = squares_in_one_place(half, other);
    const Tracer tracer(scene, Tracing::reproducible);
    Random random(1);
    for (int i = 0; i < rays; ++i) {
      const auto surface = tracer.first(ray_at_random(random));
      ASSERT_TRUE(surface);
      // The plane's distance is the same in double to the last bit, as z is -3 in all vertices.
      ASSERT_EQ(surface->mesh, 0) << i;
    }
  }
}

/// Embree's distances, in float, would be wrong about the last bits of a length, in about every second of these.
TEST(ReproducibleRays, EndWhereTheyEndInDouble) {
  const Scene scene = squares_in_one_place(1, 1);
  const Tracer tracer(scene, Tracing::reproducible);
  Random random(2);
  for (int i = 0; i < rays; ++i) {
    TracerRay ray = ray_at_random(random);
    const glm::vec3 origin(ray.origin), direction(ray.direction);
    const double distance = (-3 - double(origin.z)) / double(direction.z);
    const float nearest = float(distance);
    for (const float far : {std::nextafter(nearest, 0.0f), nearest, std::nextafter(nearest, 9.0f)}) {
      bool blocked = false;
      tracer.blocked(origin, &direction, 1, far, &blocked);
      ASSERT_EQ(blocked, distance <= double(far)) << i;
      ASSERT_EQ(tracer.first_from(origin, glm::dvec3(direction), double(far)).has_value(), distance <= double(far))
          << i;
    }
  }
}

TEST(ReproducibleRays, InterpolateInDouble) {
  Scene scene = squares_in_one_place(1, 1);
  scene.meshes.pop_back();
  scene.meshes[0].uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const Tracer tracer(scene, Tracing::reproducible);
  Random random(3);
  for (int i = 0; i < rays; ++i) {
    const auto surface = tracer.first(ray_at_random(random));
    ASSERT_TRUE(surface);
    // Weights are rounded to float, and so are the sums that they stand in: some units of 2^-24.
    ASSERT_NEAR(double(surface->uv.x), (surface->position.x + 1) / 2, 3 * 0x1p-24);
    ASSERT_NEAR(double(surface->uv.y), (surface->position.y + 1) / 2, 3 * 0x1p-24);
  }
}

/// Share of a hemisphere above a floor at x = 0 that a wall at x = distance leaves open, by cosine-weighted rays.
double traced_beside_wall(double distance, double height, double radius, int count) {
  int open = 0;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 d = cosine_direction(scrambled_sobol(uint32_t(i), 5));
    const double t = distance / d.x;
    open += !(d.x > 0 && t < radius && t * d.z < height);
  }
  return double(open) / count;
}

TEST(HardFrames, HaveTheAoOfRays) {
  for (const double radius : {0.3, 0.5, 2.0, 1e6}) {
    for (const double height : {0.1, 0.25, 1.0, std::numeric_limits<double>::infinity()}) {
      for (const double distance : {0.001, 0.05, 0.2, 0.4, 1.5}) {
        // 2^18 Sobol points: the share of a region with smooth borders is known to about 1e-5.
        EXPECT_NEAR(sets::ao_beside_wall(distance, height, radius),
                    traced_beside_wall(distance, height, radius, 1 << 18), 1e-4)
            << distance << " " << height << " " << radius;
      }
    }
  }
  EXPECT_DOUBLE_EQ(sets::ao_beside_wall(1, std::numeric_limits<double>::infinity(), 1e300), 0.5);
  EXPECT_EQ(sets::ao_beside_wall(1, 2, 1), 1);
}

TEST(HardFrames, HaveTruthsWithinTheirRange) {
  for (const std::string& name : sets::hard_frame_names()) {
    const double radius = name == "giant-corner" ? 0x1p19 : 0.5;
    const sets::HardFrame made = sets::hard_frame(name, 80, 60, radius);
    const Channel& ao = made.truth.views[0].planes.at("ao").channels[0];
    double least = 1, most = 0;
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 80; ++x)
        least = std::min(least, double(ao.at(x, y))), most = std::max(most, double(ao.at(x, y)));
    }
    const bool is_open = name.find("corner") == std::string::npos && name != "step";
    EXPECT_EQ(most, 1) << name;
    // A right angle closes half of the hemisphere at its bottom; no pixel centre lies there.
    if (is_open)
      EXPECT_EQ(least, 1) << name;
    else
      EXPECT_NEAR(least, 0.53, 0.03) << name;
    EXPECT_FALSE(sets::help_of_hard_frame(name).empty());
  }
}

}  // namespace
}  // namespace gloam::set_making_test
