// The plane motion of captures against where things were: objects that move, two eyes, modules of a display, built-in shots.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/projection.h"
#include "gloam/scene/capture.h"
#include "scene/built_in/mesh_builder.h"

namespace gloam::capture_motion_test {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::vec3;

constexpr int moving_width = 64, moving_height = 48;

/// A floor that stays, a box that goes and a wheel of six spokes that turns about its axis.
Scene moving_scene(vec3 box_at, float turn) {
  Scene scene;
  scenes::add_material(scene, "grey", vec3(0.5f));
  scenes::add_quad(scenes::add_mesh(scene, "floor", 0), {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9});
  Mesh box, wheel;
  scenes::add_box(box, {-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f});
  for (int i = 0; i < 6; ++i) {
    const float angle = 1.047f * float(i);
    scenes::add_cylinder(wheel, vec3(0), {0.9f * std::cos(angle), 0.9f * std::sin(angle), 0}, 0.08f, 0.14f);
  }
  scenes::place(scene, "box", 0, box, scenes::moved(box_at));
  scenes::place(scene, "wheel", 0, wheel, scenes::moved({1.2f, 1.2f, 0}) * scenes::turned(turn, {0, 0, 1}));
  scene.cameras = {looking_at("main", {0.3, 1.4, 5}, {0.2, 0.8, 0}, 60)};
  return scene;
}

Frame moved_frame(const Scene& now, const Scene* before, const std::vector<CaptureView>& views,
                  const std::optional<StereoRig>& stereo = {}) {
  const Tracer tracer(now);
  CaptureOptions options{.width = moving_width, .height = moving_height};
  options.planes = {"motion", "instance", "position"};
  options.views = views;
  options.previous_scene = before;
  options.stereo = stereo;
  return capture(tracer, options).frame;
}

/// Compares the motion of every pixel with where `earlier` puts what it shows, for the view's camera in the frame before.
/// Returns the number of pixels of each mesh that were compared.
std::vector<int> expect_motion(const View& view, const Camera& before,
                               const std::function<dvec3(int mesh, const dvec3&)>& earlier) {
  std::vector<int> compared(8);
  const Plane &motion = view.planes.at("motion"), &position = view.planes.at("position");
  for (int y = 0; y < moving_height; ++y) {
    for (int x = 0; x < moving_width; ++x) {
      const int mesh = int(view.planes.at("instance").channels[0].at(x, y)) - 1;
      if (mesh < 0) continue;
      dvec3 world = view.camera->pose->position;
      for (int i = 0; i < 3; ++i) world[i] += double(position.channels[size_t(i)].at(x, y));
      const std::optional<dvec2> was = pixel_of_world(before, earlier(mesh, world), 1);
      EXPECT_TRUE(was);
      if (!was) continue;
      EXPECT_NEAR(motion.channels[0].at(x, y), was->x - x - 0.5, 2e-4) << mesh << " at " << x << ", " << y;
      EXPECT_NEAR(motion.channels[1].at(x, y), was->y - y - 0.5, 2e-4) << mesh << " at " << x << ", " << y;
      ++compared[size_t(mesh)];
    }
  }
  return compared;
}

dvec3 turned_about_wheel(const dvec3& p, double angle) {
  const dvec3 from = p - dvec3(1.2f, 1.2f, 0);
  const double c = std::cos(angle), s = std::sin(angle);
  return dvec3(1.2f, 1.2f, 0) + dvec3(c * from.x - s * from.y, s * from.x + c * from.y, from.z);
}

TEST(CaptureMotion, ObjectsComeFromWhereTheyWere) {
  const vec3 step(0.25f, 0, -0.125f);
  const Scene now = moving_scene(vec3(-1, 0, 0) + step, 0.3f), before = moving_scene({-1, 0, 0}, 0.1f);
  const Camera camera = camera_for(now.cameras[0], moving_width, moving_height);
  Camera camera_before = camera;
  camera_before.pose->position += dvec3(0.1, -0.05, 0.2);
  for (const Camera& earlier_camera : {camera, camera_before}) {
    const Frame frame = moved_frame(now, &before, {{"", camera, earlier_camera}});
    const std::vector<int> compared = expect_motion(frame.views[0], earlier_camera, [&](int mesh, const dvec3& p) {
      return mesh == 1 ? p - dvec3(step) : mesh == 2 ? turned_about_wheel(p, -double(0.3f - 0.1f)) : p;
    });
    for (const int mesh : {0, 1, 2}) EXPECT_GT(compared[size_t(mesh)], 50) << "in the picture";
  }
}

TEST(CaptureMotion, AnEarlierSceneThatIsTheSameChangesNoBit) {
  const Scene scene = moving_scene({-1, 0, 0}, 0.3f), copy = scene;
  const Camera camera = camera_for(scene.cameras[0], moving_width, moving_height);
  Camera before = camera;
  before.pose->position.x -= 0.1;
  const Frame with = moved_frame(scene, &copy, {{"", camera, before}}),
              without = moved_frame(scene, nullptr, {{"", camera, before}});
  for (size_t i : {0, 1})
    for (int y = 0; y < moving_height; ++y)
      for (int x = 0; x < moving_width; ++x)
        ASSERT_EQ(with.views[0].planes.at("motion").channels[i].at(x, y),
                  without.views[0].planes.at("motion").channels[i].at(x, y));
}

TEST(CaptureMotion, EachEyeMovesByItself) {
  const Scene now = moving_scene({-0.8f, 0, 0}, 0.3f), before = moving_scene({-1, 0, 0}, 0.3f);
  const Camera camera = camera_for(now.cameras[0], moving_width, moving_height);
  Camera middle_before = camera;
  middle_before.pose = looking_at("", {0.5, 1.2, 4.6}, {0.1, 0.8, 0}, 60).pose;
  for (const StereoRig& rig : {StereoRig{0.3, {}, false}, StereoRig{0.3, 4, false}, StereoRig{0.3, 4, true}}) {
    const Frame frame = moved_frame(now, &before, {{"", camera, middle_before}}, rig);
    const std::array<Camera, 2> eyes = stereo_cameras(middle_before, rig);
    ASSERT_EQ(frame.views.size(), 2u);
    for (const size_t eye : {0, 1}) {
      const std::vector<int> compared = expect_motion(frame.views[eye], eyes[eye], [](int mesh, const dvec3& p) {
        return mesh == 1 ? p - dvec3(double(-0.8f) + 1, 0, 0) : p;
      });
      EXPECT_GT(compared[1], 50);
    }
  }
}

TEST(CaptureMotion, RefusesASceneOfOtherMeshes) {
  const Scene now = moving_scene({-1, 0, 0}, 0);
  const Camera camera = camera_for(now.cameras[0], moving_width, moving_height);
  Scene fewer = now, other = now;
  fewer.meshes.pop_back();
  other.meshes[1].triangles.pop_back();
  for (const Scene* before : {&fewer, &other}) {
    EXPECT_THROW(moved_frame(now, before, {{"", camera, camera}}), UsageError);
  }
}

TEST(CaptureMotion, ShotsMoveVerticesAloneAndSmoothly) {
  for (const SceneRecipe& recipe : builtin_scenes()) {
    for (const ShotRecipe& shot : recipe.shots) {
      const std::string name = recipe.name + " " + shot.name;
      EXPECT_GE(shot.frames, 24) << name;
      for (int frame = 2; frame <= shot.frames; ++frame) {
        const SceneCamera now = shot.camera(seconds_of_frame(frame)), before = shot.camera(seconds_of_frame(frame - 1));
        const double step = glm::length(now.pose.position - before.pose.position);
        EXPECT_GT(step, 1e-3) << name << " stands still at " << frame;
        EXPECT_LT(step, 0.1) << name << " jumps at " << frame;
      }
      if (!shot.moves_objects) continue;
      const auto scene_at = [&](int frame) {
        return load_scene(recipe.name, {{"time", fmt::format("{}", seconds_of_frame(frame))}});
      };
      const Scene first = scene_at(1);
      for (const int frame : {2, 3, shot.frames}) {
        const Scene scene = scene_at(frame);
        ASSERT_EQ(scene.meshes.size(), first.meshes.size()) << name;
        int still = 0;
        for (size_t i = 0; i < scene.meshes.size(); ++i) {
          EXPECT_EQ(scene.meshes[i].triangles, first.meshes[i].triangles) << name << ": " << scene.meshes[i].name;
          still += scene.meshes[i].positions == first.meshes[i].positions;
        }
        EXPECT_GT(still, 0) << "a room that stays";
        EXPECT_LT(still, int(scene.meshes.size()) - 3) << "objects that move";
      }
    }
  }
}

}  // namespace
}  // namespace gloam::capture_motion_test
