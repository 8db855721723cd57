// Captured planes against what is known of the scene.
#include "gloam/capture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "gloam/error.h"
#include "mesh_builder.h"

namespace gloam {
namespace {

using glm::dvec3;
using glm::vec3;

/// Three boxes in a row on a floor, at z = 0, -2 and -4; a sheet without thickness at z = -5.
Scene boxes() {
  Scene scene;
  scene.name = "boxes";
  scenes::add_material(scene, "red", {0.8f, 0.1f, 0.1f}, 0.3f);
  scenes::add_material(scene, "gold", {1.0f, 0.8f, 0.3f}, 0.2f, 1);
  for (int i = 0; i < 3; ++i) {
    const float z = -2.0f * float(i);
    scenes::add_box(scenes::add_mesh(scene, "box", i == 1 ? 1 : 0), {-0.5f, 0, z - 0.5f}, {0.5f, 1, z + 0.5f});
  }
  scenes::add_quad(scenes::add_mesh(scene, "sheet", 0), {-3, -3, -5}, {3, -3, -5}, {3, 3, -5}, {-3, 3, -5});
  scene.cameras = {looking_at("main", {0, 0.5, 6}, {0, 0.5, 0}, 40)};
  return scene;
}

CaptureResult captured(const Scene& scene, const Camera& camera, int width, int height, int peel = 0,
                       const std::optional<Camera>& previous = {}) {
  const Tracer tracer(scene);
  CaptureOptions options;
  options.width = width, options.height = height;
  options.planes = capture_planes();
  options.peel = peel;
  options.views = {{"", camera, previous}};
  return capture(tracer, options);
}

float value(const Frame& frame, const std::string& plane, int x, int y, size_t component = 0) {
  return frame.views[0].planes.at(plane).channels[component].at(x, y);
}

TEST(Capture, LayersBackFacesAndInstances) {
  const Scene scene = boxes();
  const Frame frame = captured(scene, camera_for(scene.cameras[0], 65, 33), 65, 33, 8).frame;
  const int x = 32, y = 16;  // straight through the middle of all boxes
  EXPECT_NEAR(value(frame, "depth", x, y), 5.5, 1e-6);
  EXPECT_NEAR(value(frame, "back_depth", x, y), 6.5, 1e-6) << "the first box's own back, not the next box";
  EXPECT_EQ(value(frame, "instance", x, y), 1);
  EXPECT_EQ(value(frame, "peel_count", x, y), 7);
  const double expected[] = {5.5, 6.5, 7.5, 8.5, 9.5, 10.5, 11};
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(value(frame, fmt::format("peel.{:02}", i), x, y), expected[i], 1e-5) << i;
  EXPECT_TRUE(std::isinf(value(frame, "peel.07", x, y)));
  // The sheet has no back.
  EXPECT_EQ(value(frame, "instance", 55, 5), 4);
  EXPECT_TRUE(std::isinf(value(frame, "back_depth", 55, 5)));
}

TEST(Capture, FewerLayersStoredThanThere) {
  const Scene scene = boxes();
  const Frame frame = captured(scene, camera_for(scene.cameras[0], 65, 33), 65, 33, 2).frame;
  EXPECT_EQ(value(frame, "peel_count", 32, 16), 7);
  EXPECT_NEAR(value(frame, "peel.01", 32, 16), 6.5, 1e-5);
  EXPECT_EQ(frame.views[0].find("peel.02"), nullptr);
}

TEST(Capture, Materials) {
  const Scene scene = boxes();
  SceneCamera above = looking_at("above", {0, 4, -2}, {0, 0, -2.001}, 30);
  const Frame frame = captured(scene, camera_for(above, 33, 33), 33, 33).frame;
  EXPECT_EQ(value(frame, "instance", 16, 16), 2);
  EXPECT_FLOAT_EQ(value(frame, "albedo", 16, 16, 1), 0.8f);
  EXPECT_FLOAT_EQ(value(frame, "roughness", 16, 16), 0.2f);
  EXPECT_FLOAT_EQ(value(frame, "reflectance", 16, 16, 2), 0.3f) << "a metal reflects its base colour";
  EXPECT_EQ(value(frame, "color", 16, 16), 0) << "a metal has no diffuse light";
}

/// Position, depth and pixel belong together for every kind of camera.
void expect_positions_on_pixel_centres(const Scene& scene, const Camera& camera) {
  const Frame frame = captured(scene, camera, 64, 36).frame;
  const View& view = frame.views[0];
  int surfaces = 0;
  for (int y = 0; y < 36; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (is_background(value(frame, "depth", x, y))) continue;
      ++surfaces;
      const dvec3 world = view.origin + dvec3(value(frame, "position", x, y, 0), value(frame, "position", x, y, 1),
                                              value(frame, "position", x, y, 2));
      const dvec3 v = camera.pose->world_to_view * (world - camera.pose->position);
      EXPECT_NEAR(-v.z, value(frame, "depth", x, y), 1e-5 * -v.z);
      const double divisor = camera.orthographic ? 1 : -v.z;
      EXPECT_NEAR(camera.cx + camera.fx * v.x / divisor, x + 0.5, 2e-4);
      EXPECT_NEAR(camera.cy - camera.fy * v.y / divisor, y + 0.5, 2e-4);
      double length = 0;
      for (size_t i = 0; i < 3; ++i) length += value(frame, "normal", x, y, i) * value(frame, "normal", x, y, i);
      EXPECT_NEAR(length, 1, 1e-5);
    }
  }
  EXPECT_GT(surfaces, 100);
}

TEST(Capture, PerspectiveOffAxisAndOrthographic) {
  const Scene scene = boxes();
  SceneCamera seen = looking_at("main", {1, 2, 6}, {0, 0.5, -1}, 50);
  expect_positions_on_pixel_centres(scene, camera_for(seen, 64, 36));
  Camera off_axis = camera_for(seen, 64, 36);
  off_axis.cx += 11.5, off_axis.cy -= 4.25, off_axis.fy *= 1.3;
  expect_positions_on_pixel_centres(scene, off_axis);
  seen.orthographic = true;
  seen.width = 6;
  expect_positions_on_pixel_centres(scene, camera_for(seen, 64, 36));
}

TEST(Capture, NearAndFarClip) {
  const Scene scene = boxes();
  Camera camera = camera_for(scene.cameras[0], 65, 33);
  camera.near = 6;
  EXPECT_NEAR(value(captured(scene, camera, 65, 33).frame, "depth", 32, 16), 6.5, 1e-6);
  camera.far = 6.2;
  EXPECT_TRUE(std::isinf(value(captured(scene, camera, 65, 33).frame, "depth", 32, 16)));
}

TEST(Capture, MotionPointsToThePreviousFrame) {
  const Scene scene = boxes();
  const Camera now = camera_for(scene.cameras[0], 65, 33);
  Camera before = now;
  before.pose->position += dvec3(0.25, 0.1, 0);
  const Frame frame = captured(scene, now, 65, 33, 0, before).frame;
  const double z = value(frame, "depth", 32, 16);
  EXPECT_NEAR(value(frame, "motion", 32, 16, 0), -0.25 * now.fx / z, 1e-4)
      << "a camera further right saw it further left";
  EXPECT_NEAR(value(frame, "motion", 32, 16, 1), 0.1 * now.fy / z, 1e-4)
      << "and from further up, further down: y is down";
}

TEST(Capture, BackFacesAreTurnedToTheViewer) {
  Scene scene = boxes();
  scene.cameras = {looking_at("behind", {0, 0.5, -9}, {0, 0.5, 0}, 40)};
  const Frame frame = captured(scene, camera_for(scene.cameras[0], 33, 33), 33, 33).frame;
  EXPECT_EQ(value(frame, "instance", 16, 16), 4);
  EXPECT_NEAR(value(frame, "normal", 16, 16, 2), 1, 1e-6);
}

TEST(Capture, TexturesRepeatAndStartAtTheTopLeft) {
  Scene scene = boxes();
  scene.textures.push_back({"four", 2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 0}});
  scene.materials[0].albedo = vec3(1);
  scene.materials[0].albedo_texture = 0;
  Mesh& sheet = scene.meshes[3];
  sheet.uvs = {{0, 3}, {3, 3}, {0, 0}, {3, 0}};  // the quad's corners, rows from below
  scene.meshes.erase(scene.meshes.begin(), scene.meshes.begin() + 3);
  const SceneCamera seen = looking_at("main", {0, 0, 1}, {0, 0, 0}, 90);  // 6 units of depth: all of the sheet
  const Frame solid = captured(scene, camera_for(seen, 48, 24), 48, 24).frame;
  // The sheet spans pixels 12 to 36 across; each repeat has 8 pixels, each texel 4.
  // Pixel (14, 2) lies an eighth of a texel right of and below the red one's centre.
  EXPECT_NEAR(value(solid, "albedo", 14, 2, 0), 0.875 * 0.875 + 0.125 * 0.125, 1e-3);
  EXPECT_NEAR(value(solid, "albedo", 18, 2, 1), 1, 0.2);
  EXPECT_NEAR(value(solid, "albedo", 14, 6, 2), 1, 0.2);
  EXPECT_NEAR(value(solid, "albedo", 22, 10, 0), value(solid, "albedo", 14, 2, 0), 1e-3) << "repeats";
  // Where the texture is transparent there is a hole.
  scene.materials[0].alpha_cutoff = 0.5f;
  const Frame holed = captured(scene, camera_for(seen, 48, 24), 48, 24, 1).frame;
  EXPECT_TRUE(std::isinf(value(holed, "depth", 18, 6)));
  EXPECT_EQ(value(holed, "peel_count", 18, 6), 0);
  EXPECT_NEAR(value(holed, "depth", 14, 2), 6, 1e-5);
}

TEST(Capture, AboutTheSameAtAnyDistanceFromTheOrigin) {
  Scene far = boxes();
  far.origin = {1e7, 2e6, -3e7};
  for (SceneCamera& camera : far.cameras) camera.pose.position += far.origin;
  const Scene near = boxes();
  const Frame a = captured(near, camera_for(near.cameras[0], 65, 33), 65, 33).frame;
  const Frame b = captured(far, camera_for(far.cameras[0], 65, 33), 65, 33).frame;
  for (int y = 0; y < 33; ++y) {
    for (int x = 0; x < 65; ++x) {
      if (is_background(value(a, "depth", x, y))) continue;
      EXPECT_NEAR(value(a, "depth", x, y), value(b, "depth", x, y), 1e-6 * value(a, "depth", x, y));
      EXPECT_NEAR(value(a, "position", x, y), value(b, "position", x, y), 1e-5);
    }
  }
}

TEST(Capture, RefusesWhatItCannotDo) {
  const Scene scene = boxes();
  const Tracer tracer(scene);
  CaptureOptions options;
  options.views = {{"", camera_for(scene.cameras[0], 8, 8), {}}};
  options.width = options.height = 8;
  options.planes = {"normals"};
  EXPECT_THROW(capture(tracer, options), UsageError);
  options.planes = {};
  options.peel = 65;
  EXPECT_THROW(capture(tracer, options), UsageError);
  options.peel = 0;
  options.views[0].camera.pose.reset();
  EXPECT_THROW(capture(tracer, options), Error);
  Scene empty = boxes();
  empty.meshes.clear();
  EXPECT_THROW(Tracer{empty}, Error);
  Scene broken = boxes();
  broken.meshes[0].triangles[0].x = 1000000;
  EXPECT_THROW(Tracer{broken}, Error);
}

}  // namespace
}  // namespace gloam
