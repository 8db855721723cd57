// The ray-caster behind the bundled reference, against closed forms. Links analytic_scene (data/).
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "analytic_scene.h"
#include "base/low_discrepancy.h"
#include "loggia.h"

namespace gloam::analytic::scene_test {
namespace {

using glm::dvec3;

constexpr double far_away = 1e4, unlimited = std::numeric_limits<double>::infinity();
constexpr double tolerance = 2e-3;
constexpr int rays = 1 << 16;
const dvec3 up(0, 1, 0);

Solid ground() { return make_box({-far_away, -1, -far_away}, {far_away, 0, far_away}); }

Scene scene_of(const std::vector<Solid>& solids) {
  Scene scene;
  for (const Solid& solid : solids) scene.add(solid, glm::vec3(0.5f));
  return scene;
}

double ao(const Scene& scene, const dvec3& point, const dvec3& normal, double radius, uint32_t seed = 1) {
  return ambient_visibility(scene, point, normal, radius, rays, seed).ao;
}

TEST(AnalyticAo, OpenPlaneIsOne) {
  const Scene scene = scene_of({ground()});
  for (const double x : {-3.0, 0.0, 0.25, 1234.5}) EXPECT_EQ(ao(scene, {x, 0, 0.1}, up, 2), 1);
}

/// A ball wholly above the horizon and within reach hides (r/d)^2 of a cosine-weighted hemisphere, times the cosine of its
/// centre's angle (Nusselt's analogue).
TEST(AnalyticAo, BallOverPlane) {
  const double r = 0.3;
  for (const dvec3& centre : {dvec3(0, 0.5, 0), dvec3(0, 1.2, 0), dvec3(0.5, 0.6, 0.2), dvec3(-1.0, 0.4, 0.7)}) {
    const double d = glm::length(centre), cosine = centre.y / d;
    ASSERT_GT(centre.y, r);
    const Scene scene = scene_of({ground(), make_sphere(centre, r)});
    EXPECT_NEAR(ao(scene, dvec3(0), up, 5), 1 - r * r / (d * d) * cosine, tolerance) << "d " << d;
  }
}

TEST(AnalyticAo, BallBeyondReachHidesNothing) {
  const Scene scene = scene_of({ground(), make_sphere({0, 1.0, 0}, 0.3)});
  EXPECT_EQ(ao(scene, dvec3(0), up, 0.69), 1);
  EXPECT_LT(ao(scene, dvec3(0), up, 0.71), 1);
}

/// An infinite wall at right angles to the floor, `a` away, meets a direction w after a / w_x. Within reach R it hides w_x > a/R.
/// On the floor's unit disk, where projected cosine-weighted directions are uniform, that is a circular segment at s = a/R with
/// the area acos(s) - s sqrt(1 - s^2), out of pi.
double wall_closed_form(double a, double reach) {
  const double s = a / reach;
  return s >= 1 ? 1 : 1 - (std::acos(s) - s * std::sqrt(1 - s * s)) / M_PI;
}

/// The same from the definition: midpoints over elevation and azimuth, with cosine and solid angle written out.
double wall_by_quadrature(double a, double reach) {
  constexpr int n = 1500;
  double open = 0;
  for (int i = 0; i < n; ++i) {
    const double theta = (i + 0.5) / n * M_PI / 2;
    int seen = 0;
    for (int j = 0; j < n; ++j) {
      const double towards_wall = std::sin(theta) * std::cos((j + 0.5) / n * 2 * M_PI);
      seen += !(towards_wall > 0 && a / towards_wall < reach);
    }
    open += std::cos(theta) * std::sin(theta) * seen;
  }
  return open * (M_PI / 2 / n) * (2 * M_PI / n) / M_PI;
}

TEST(AnalyticAo, FloorBesideWall) {
  for (const double reach : {0.5, 2.0}) {
    for (const double share : {0.02, 0.2, 0.5, 0.8, 0.99, 1.5}) {
      const double a = share * reach, truth = wall_closed_form(a, reach);
      EXPECT_NEAR(wall_by_quadrature(a, reach), truth, 2e-4) << "a " << a << ", reach " << reach;
      const Scene scene = scene_of({ground(), make_box({a, -1, -far_away}, {a + 1, far_away, far_away})});
      EXPECT_NEAR(ao(scene, dvec3(0), up, reach), truth, tolerance) << "a " << a << ", reach " << reach;
    }
  }
}

/// The same corner turned about y and laid on its side: the result does not depend on the axis.
TEST(AnalyticAo, FloorBesideTurnedWall) {
  const double a = 0.2, reach = 0.5, yaw = 0.7;
  const dvec3 normal(std::sin(yaw), 0, std::cos(yaw));  // of the "floor", which now stands
  Scene scene;
  scene.add(placed(make_box({-50, -50, -1}, {50, 50, 0}), yaw, dvec3(0)), glm::vec3(0.5f));
  scene.add(placed(make_box({-50, a, -1}, {50, 50, 50}), yaw, dvec3(0)), glm::vec3(0.5f));
  EXPECT_NEAR(ao(scene, dvec3(0), normal, reach), wall_closed_form(a, reach), tolerance);
}

/// From the middle of the bottom of a round pit the sky is a disk: its share is sin^2 of its half angle.
TEST(AnalyticAo, BottomOfRoundPit) {
  for (const double rim : {0.3, 0.5, 0.7}) {
    const double floor_radius = 0.5, depth = 0.6;
    Scene scene;
    scene.add(ground(), glm::vec3(0.5f),
              {make_frustum({0, -depth, 0}, {0, 0.6, 0}, floor_radius, 2 * rim - floor_radius)});
    const double truth = rim * rim / (rim * rim + depth * depth);
    EXPECT_NEAR(ao(scene, {0, -depth, 0}, up, unlimited), truth, tolerance) << "rim " << rim;
  }
}

TEST(AnalyticAo, BottomOfBowl) {
  Scene scene;
  scene.add(make_sphere(dvec3(0), 1.1), glm::vec3(0.5f), {make_sphere(dvec3(0), 1), make_box({-2, 0, -2}, {2, 2, 2})});
  EXPECT_NEAR(ao(scene, {0, -1, 0}, up, unlimited), 0.5, tolerance);
}

/// The halves agree with the truth, and their difference predicts the error.
TEST(AnalyticAo, NoiseIsWhatTheHalvesSay) {
  const Scene scene = scene_of({ground(), make_sphere({0.5, 0.6, 0.2}, 0.3)});
  const double d2 = 0.65, truth = 1 - 0.09 / d2 * 0.6 / std::sqrt(d2);
  double squared_error = 0, predicted = 0;
  constexpr int runs = 200;
  for (uint32_t seed = 0; seed < runs; ++seed) {
    const Visibility v = ambient_visibility(scene, dvec3(0), up, 5, 512, seed);
    squared_error += (v.ao - truth) * (v.ao - truth);
    predicted += v.half_difference * v.half_difference / 4;
  }
  EXPECT_NEAR(std::sqrt(predicted / squared_error), 1, 0.25);
}

TEST(ScrambledSobol, EveryPowerOfTwoIsStratified) {
  for (uint32_t seed = 0; seed < 20; ++seed) {
    std::vector<int> columns(64), rows(64), cells(64);
    for (uint32_t i = 0; i < 64; ++i) {
      const glm::dvec2 u = scrambled_sobol(i, seed);
      ++columns[size_t(u.x * 64)];
      ++rows[size_t(u.y * 64)];
      ++cells[size_t(u.x * 8) * 8 + size_t(u.y * 8)];
    }
    const std::vector<int> one_each(64, 1);
    EXPECT_EQ(columns, one_each);
    EXPECT_EQ(rows, one_each);
    EXPECT_EQ(cells, one_each);
  }
}

/// Properties that the bundled frame relies on, at pixels spread over the image.
class Loggia : public testing::Test {
 protected:
  static constexpr int width = 480, height = 270;
  const Scene scene = loggia_scene();
  const Camera camera = loggia_camera(width, height);

  template <typename Check>
  void at_pixels(int stride, Check check) const {
    for (int y = stride / 2; y < height; y += stride) {
      for (int x = stride / 2; x < width; x += stride) {
        const Ray ray = camera_ray(camera, x + 0.5, y + 0.5);
        if (const std::optional<Hit> hit = first_hit(scene, ray)) check(x, y, ray, *hit);
      }
    }
  }
};

TEST_F(Loggia, CameraIsRightHandedWithItsFieldOfView) {
  const glm::dmat3& m = camera.pose->world_to_view;
  EXPECT_NEAR(glm::dot(glm::cross(m[0], m[1]), m[2]), 1, 1e-12);
  EXPECT_NEAR(2 * std::atan(width / 2 / camera.fx) * 180 / M_PI, 65, 1e-9);
  const dvec3 ahead = camera_ray(camera, camera.cx, camera.cy).direction;
  EXPECT_NEAR(glm::distance(m * ahead, dvec3(0, 0, -1)), 0, 1e-12);
  EXPECT_LT(ahead.y, 0) << "looks down";
}

TEST_F(Loggia, DepthIsPlanarDepthOfThePosition) {
  at_pixels(7, [&](int x, int y, const Ray& ray, const Hit& hit) {
    const dvec3 position = ray.origin + hit.distance * ray.direction;
    const double depth = view_depth(camera, position);
    EXPECT_GT(depth, 0);
    const dvec3 in_view((x + 0.5 - camera.cx) / camera.fx * depth, (camera.cy - y - 0.5) / camera.fy * depth, -depth);
    const dvec3 expected = camera.pose->world_to_view * (position - camera.pose->position);
    EXPECT_NEAR(glm::distance(in_view, expected), 0, 1e-9) << x << ", " << y;
  });
}

TEST_F(Loggia, NormalsAreUnitAndFaceTheCamera) {
  at_pixels(3, [&](int x, int y, const Ray& ray, const Hit& hit) {
    EXPECT_NEAR(glm::length(hit.normal), 1, 1e-12) << x << ", " << y;
    EXPECT_LE(glm::dot(hit.normal, ray.direction), 1e-9) << x << ", " << y;
  });
}

/// A small step along the normal leads outside, one against it inside: so the point is on the surface, and the normal is the
/// surface's.
TEST_F(Loggia, SurfaceIsWhereTheHitIs) {
  at_pixels(5, [&](int x, int y, const Ray& ray, const Hit& hit) {
    const dvec3 position = ray.origin + hit.distance * ray.direction;
    EXPECT_TRUE(blocked(scene, {position - 1e-7 * hit.normal, hit.normal}, 1e-9)) << x << ", " << y;
    EXPECT_FALSE(blocked(scene, {position + 1e-7 * hit.normal, hit.normal}, 1e-9)) << x << ", " << y;
  });
}

TEST_F(Loggia, SameSeedSameOcclusion) {
  at_pixels(40, [&](int, int, const Ray& ray, const Hit& hit) {
    const dvec3 position = ray.origin + hit.distance * ray.direction;
    const Visibility a = ambient_visibility(scene, position, hit.normal, loggia_ao_radius, 256, 7);
    const Visibility b = ambient_visibility(scene, position, hit.normal, loggia_ao_radius, 256, 7);
    EXPECT_EQ(a.ao, b.ao);
    EXPECT_EQ(a.half_difference, b.half_difference);
    EXPECT_GE(a.ao, 0);
    EXPECT_LE(a.ao, 1);
  });
}

/// Testing only nearby objects must not change the answer: compared with the same rays against all objects.
TEST_F(Loggia, NearbyObjectsAreAllThatMatters) {
  at_pixels(53, [&](int x, int y, const Ray& ray, const Hit& hit) {
    const dvec3 position = ray.origin + hit.distance * ray.direction;
    const Visibility near = ambient_visibility(scene, position, hit.normal, loggia_ao_radius, 1024, 3);
    // An unrelated estimate: uniform directions weighted by their cosine.
    double open = 0, all = 0;
    for (uint32_t i = 0; i < 4096; ++i) {
      const glm::dvec2 u = scrambled_sobol(i, 99);
      const double z = 2 * u.x - 1, r = std::sqrt(1 - z * z), angle = 2 * M_PI * u.y;
      const dvec3 direction(r * std::cos(angle), r * std::sin(angle), z);
      const double cosine = glm::dot(direction, hit.normal);
      if (cosine <= 0) continue;
      all += cosine;
      if (!blocked(scene, {position + 1e-7 * hit.normal, direction}, loggia_ao_radius)) open += cosine;
    }
    EXPECT_NEAR(near.ao, open / all, 0.01) << x << ", " << y;
  });
}

}  // namespace
}  // namespace gloam::analytic::scene_test
