// The effect of a second view (Vermeer, Scandolo, Eisemann 2021, section 3.4): occluders are found at their position, from any
// pose, and the result is nearer to the truth where the first view does not see the occluder.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "gloam/planes.h"
#include "gloam/scene/capture.h"
#include "gloam/scene/reference.h"
#include "support/estimate.h"
#include "support/long.h"
#include "support/stress.h"

namespace gloam::test::multiview_test {
namespace {

/// A plane through a point, in view space.
Scene plane_through(const glm::dvec3& point, const glm::dvec3& normal) {
  return [=](const EyeRay& ray) -> std::optional<Surface> {
    const double depth = glm::dot(point - ray.origin, normal) / glm::dot(ray.direction, normal);
    if (!(depth > 0)) return std::nullopt;
    return Surface{depth, normal};
  };
}

/// In world space, which is the first view's space: a plane that faces neither eye squarely, and a ball on it.
const glm::dvec3 on_plane(0, 0, -4), up_from_plane = glm::normalize(glm::dvec3(0.2, 0.3, 1)),
                                     along_plane = glm::normalize(glm::cross(up_from_plane, {0.3, 1, 0}));
const glm::dvec3 foot = on_plane + 0.4 * along_plane;
constexpr double ball_radius = 0.2;

/// A camera that is turned about every axis, and moved so that it looks at the foot of the ball from 4 units away.
Pose turned_pose(double degrees) {
  Pose pose;
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1), glm::radians(degrees), glm::normalize(glm::dvec3(0.6, 1, 0.4)));
  pose.world_to_view = glm::dmat3(turn);
  pose.position = foot + glm::transpose(pose.world_to_view) * glm::dvec3(0, 0, 4);
  return pose;
}

Shot off_axis(int width, int height) {
  Shot shot = perspective(width, height);
  shot.camera.cx += 0.2 * width;
  shot.camera.cy -= 0.15 * height;
  return shot;
}

/// The plane seen by the first view and by a turned camera: with the ball, if there is one.
Frame two_views(const Shot& first, const Shot& second, double degrees, bool with_ball) {
  Frame frame = shoot(first, plane_through(on_plane, up_from_plane));
  frame.views[0].camera->pose = Pose{};
  const Pose pose = turned_pose(degrees);
  const auto there = [&](const glm::dvec3& point) { return pose.world_to_view * (point - pose.position); };
  std::vector<Scene> scenes = {plane_through(there(on_plane), pose.world_to_view * up_from_plane)};
  if (with_ball) scenes.push_back(ball(there(foot), ball_radius));
  Frame other = shoot(second, nearest_of(scenes));
  other.views[0].name = "second";
  other.views[0].camera->pose = pose;
  for (Frame* f : {&frame, &other}) plane_of(*f, layer_name("stochastic", 0));  // nothing
  frame.views.push_back(std::move(other.views[0]));
  return frame;
}

Frame over_both(const Frame& frame, const Settings& settings) {
  return raw_of("multiview", frame, joined({{"samples", "1"}}, settings), {.math = Math::precise});
}

struct Cameras {
  const char* name;
  Shot first, second;
};

std::vector<Cameras> cameras() {
  return {{"perspective", perspective(96, 64), perspective(96, 64, 50)},
          {"off-axis", off_axis(96, 64), off_axis(96, 64)},
          {"orthographic", orthographic(96, 64, 4), orthographic(96, 64, 5)},
          {"perspective and orthographic", perspective(96, 64), orthographic(96, 64, 4)}};
}

const std::vector<std::string> resolutions = {"full", "half", "quarter"};

TEST(Multiview, APlaneIsOpenFromEveryPose) {
  for (const Cameras& c : cameras()) {
    for (const double degrees : {0.0, 15.0, -25.0, 40.0}) {
      const Frame frame = two_views(c.first, c.second, degrees, false);
      for (const std::string& resolution : resolutions) {
        EXPECT_EQ(largest_occlusion(over_both(frame, {{"other_resolution", resolution}})), 0)
            << c.name << ", turned by " << degrees << ", second view " << resolution;
      }
    }
  }
}

/// Only the second view has the ball: the pixels that it darkens lie around its foot, wherever the first view shows that.
TEST(Multiview, AnOccluderIsFoundWhereItStands) {
  for (const Cameras& c : cameras()) {
    const Camera& camera = c.first.camera;
    const double scale = camera.orthographic ? 1 : 1 / -foot.z;
    const double x = camera.cx + camera.fx * foot.x * scale, y = camera.cy - camera.fy * foot.y * scale;
    for (const double degrees : {0.0, 15.0, -25.0, 40.0}) {
      const Frame frame = two_views(c.first, c.second, degrees, true);
      for (const std::string& resolution : resolutions) {
        const Frame result = over_both(frame, {{"directions", "16"}, {"other_resolution", resolution}});
        double sum = 0, sum_x = 0, sum_y = 0, most = 0;
        for (int j = 0; j < c.first.height; ++j) {
          for (int i = 0; i < c.first.width; ++i) {
            const double taken = 1 - raw_at(result, i, j);
            most = std::max(most, taken);
            sum += taken;
            sum_x += taken * (i + 0.5);
            sum_y += taken * (j + 0.5);
          }
        }
        const std::string where = fmt::format("{}, turned by {}, second view {}", c.name, degrees, resolution);
        // It is darkest where they touch, on an area narrower than a pixel at a quarter of the resolution.
        EXPECT_GT(most, resolution == "full" ? 0.3 : resolution == "half" ? 0.25 : 0.12) << where;
        // The second eye sees the ball and its surroundings from the side: a pixel of the first is 0.04 to 0.05 units.
        EXPECT_NEAR(sum_x / sum, x, 3.5) << where;
        EXPECT_NEAR(sum_y / sum, y, 3.5) << where;
      }
    }
  }
}

/// The sides of the slab lie along the first view's rays, so that none meets them: no number of layers helps.
TEST(Multiview, HalvesTheErrorBesideASlabThatLiesAlongTheView) {
  ONLY_IN_LONG_RUN();
  const gloam::Scene scene = load_scene("slab", {});
  const Tracer tracer(scene);
  CaptureOptions options{.width = 320, .height = 180, .planes = {"depth", "normal"}, .stochastic = {.samples = 4}};
  options.views = {{"", camera_for(scene.cameras.front(), options.width, options.height), {}}};
  options.second_view = 30;
  const Frame frame = capture(tracer, options).frame;
  const Frame truth = ao_reference(tracer, frame, {.radius = scene.ao_radius, .samples = 256}).frame;
  const auto error = [&](const char* technique, const Settings& settings) {
    const Settings all = {{"radius", std::to_string(scene.ao_radius)}, {"falloff", "none"}, {"samples", "4"}};
    const Frame result = raw_of(technique, frame, joined(all, settings));
    double sum = 0;
    for (int y = 0; y < options.height; ++y) {
      for (int x = 0; x < options.width; ++x)
        sum += std::pow(raw_at(result, x, y) - truth.views[0].planes.at("ao").channels[0].at(x, y), 2);
    }
    return std::sqrt(sum / (options.width * options.height));
  };
  const double single = error("sd-hbao+", {});
  EXPECT_GT(single, 0.1);
  for (const std::string& resolution : resolutions) {
    const double both = error("multiview", {{"other_resolution", resolution}});
    std::printf("slab: RMSE to the truth %.4f with one view, %.4f with two, %s resolution\n", single, both,
                resolution.c_str());
    EXPECT_LE(both, 0.5 * single) << resolution;
  }
}

}  // namespace
}  // namespace gloam::test::multiview_test
