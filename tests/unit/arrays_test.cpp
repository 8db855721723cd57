// Frames that a program passes from memory: computed like a file, or refused in one sentence.
#include "gloam/arrays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/matrix.hpp>
#include <limits>
#include <thread>

#include "gloam/compute.h"
#include "gloam/error.h"
#include "gloam/exr.h"
#include "gloam/planes.h"
#include "gloam/projection_camera.h"
#include "support/techniques.h"
#include "unit/message_of.h"

namespace gloam::test::arrays_test {
namespace {

constexpr int width = 48, height = 32;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// A wall at depth 4, and from the middle on one at depth 3.5.
std::vector<float> two_walls() {
  std::vector<float> depth(width * height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) depth[size_t(y * width + x)] = x < width / 2 ? 4.0f : 3.5f;
  }
  return depth;
}

Arrays arrays_of(const std::vector<float>& depth) {
  return {.width = width, .height = height, .camera = camera_with_fov(width, height, 60), .planes = {{"depth", depth}}};
}

std::string refusal_of(const Arrays& arrays) {
  return message_of([&] { frame_from(arrays); });
}

TEST(Arrays, AreComputedAsTheSameFileIs) {
  const std::vector<float> depth = two_walls();
  const Frame frame = frame_from(arrays_of(depth));
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "gloam_arrays.exr";
  write_frame(file, frame);
  FrameFile opened(file, {});
  const PlanRequest request{.outputs = {"hbao+"}, .radius = 1.0};
  const Frame from_file = compute(request, opened.read({"depth"}), device()).frame;
  EXPECT_EQ(values_of(compute(request, frame, device()).frame, "ao"), values_of(from_file, "ao"));
  std::filesystem::remove(file);
}

TEST(Arrays, GiveAmbientOcclusionPixelByPixel) {
  std::vector<float> depth = two_walls();
  depth[5] = nan;
  const std::vector<float> ao = ambient_occlusion(arrays_of(depth), device(), {.radius = 2.0});
  ASSERT_EQ(ao.size(), depth.size());
  EXPECT_EQ(ao[5], 1) << "no surface";
  const size_t row = height / 2 * width;
  EXPECT_LT(ao[row + width / 2 - 1], 0.9f) << "beside the nearer wall";
  EXPECT_GT(ao[row + 2], 0.95f) << "far from it";
}

TEST(Arrays, DepthIsWhatIsStatedOfIt) {
  const std::vector<float> depth = two_walls();
  const double near = 0.5, far = 8;
  std::vector<float> window(depth);
  for (float& value : window) value = float(far / (far - near) * (1 - near / value));
  window[7] = 1;
  Arrays stated = arrays_of(window);
  stated.depth = {.convention = DepthConvention::ndc, .near = near, .far = far};
  const Frame frame = frame_from(stated);
  const std::vector<float> found = values_of(frame, "depth");
  EXPECT_TRUE(std::isinf(found[7]));
  for (size_t i = 8; i < found.size(); ++i) ASSERT_NEAR(found[i], depth[i], 1e-5) << i;
  EXPECT_TRUE(frame.assumed.empty());
  stated.depth.near = {};
  EXPECT_NE(refusal_of(stated).find("needs the distance of the near plane"), std::string::npos) << refusal_of(stated);
  Arrays marked = arrays_of(depth);
  marked.depth.background = 4.0f;
  EXPECT_TRUE(std::isinf(values_of(frame_from(marked), "depth").front()));
  EXPECT_EQ(values_of(frame_from(marked), "depth").back(), 3.5f);
}

TEST(Arrays, WithACameraInAnotherUnitAreTold) {
  const std::vector<float> depth = two_walls();
  Arrays arrays = arrays_of(depth);
  EXPECT_TRUE(frame_from(arrays).assumed.empty());
  arrays.camera.cx = width + 1;
  ASSERT_EQ(frame_from(arrays).assumed.size(), 1u);
  EXPECT_NE(frame_from(arrays).assumed.front().find("lies outside of the image"), std::string::npos);
}

TEST(Cameras, OfAProjectionDrawPointsWhereItDoes) {
  // glFrustum(-0.1, 0.3, -0.05, 0.15, 0.1, 10), as columns.
  const glm::dmat4 projection(0.5, 0, 0, 0, 0, 1, 0, 0, 0.5, 0.5, -10.1 / 9.9, -1, 0, 0, -2 / 9.9, 0);
  const Camera camera = camera_from_projection(projection, ClipSpace::opengl, 400, 200).camera;
  EXPECT_DOUBLE_EQ(camera.fx, 100);
  EXPECT_DOUBLE_EQ(camera.fy, 100);
  EXPECT_DOUBLE_EQ(camera.cx, 100);
  EXPECT_DOUBLE_EQ(camera.cy, 150);
  EXPECT_NEAR(*camera.near, 0.1, 1e-12);
  EXPECT_NEAR(*camera.far, 10, 1e-10);
  const std::string refusal =
      message_of([&] { camera_from_projection(glm::transpose(projection), ClipSpace::opengl, 400, 200); });
  EXPECT_NE(refusal.find("projection is transposed"), std::string::npos) << refusal;
}

TEST(Arrays, ComponentsStandSideBySide) {
  const std::vector<float> depth(width * height, 2.0f);
  std::vector<float> normal;
  for (int i = 0; i < width * height; ++i) normal.insert(normal.end(), {0, 3, 4});
  Arrays arrays = arrays_of(depth);
  arrays.planes["normal"] = normal;
  const Frame frame = frame_from(arrays);
  EXPECT_FLOAT_EQ(frame.views[0].find("normal")->channels[1].at(7, 3), 0.6f);
  const std::vector<float> values = values_of(frame, "normal");
  ASSERT_EQ(values.size(), normal.size());
  EXPECT_FLOAT_EQ(values[3 * 100 + 2], 0.8f);
}

TEST(Arrays, OfTheWrongSizeAreRefused) {
  const std::vector<float> depth = two_walls();
  Arrays arrays = arrays_of(depth);
  arrays.planes["depth"] = std::span(depth).first(100);
  EXPECT_EQ(refusal_of(arrays), "plane 'depth' has 100 values; 48 x 32 pixels of 1 component are 1536");
  arrays = arrays_of(depth);
  arrays.planes["normal"] = depth;
  EXPECT_EQ(refusal_of(arrays), "plane 'normal' has 1536 values; 48 x 32 pixels of 3 components are 4608");
  for (const auto& [w, h] : {std::pair(0, 32), std::pair(48, -1), std::pair(65537, 1), std::pair(65536, 65536)}) {
    arrays = arrays_of(depth);
    arrays.width = w;
    arrays.height = h;
    EXPECT_NE(refusal_of(arrays).find("is not allowed; 1 to 65536 each way"), std::string::npos) << w << " x " << h;
  }
}

TEST(Arrays, NullPointersAreRefused) {
  const std::vector<float> depth = two_walls();
  Arrays arrays = arrays_of(depth);
  arrays.planes["depth"] = {static_cast<const float*>(nullptr), depth.size()};
  EXPECT_EQ(refusal_of(arrays), "plane 'depth' is a null pointer; give its 1536 values, or leave it out");
  arrays.planes["depth"] = {};
  EXPECT_NE(refusal_of(arrays).find("has 0 values"), std::string::npos);
}

TEST(Arrays, CamerasThatAreNoneAreRefused) {
  const std::vector<float> depth = two_walls();
  const auto with = [&](auto change) {
    Arrays arrays = arrays_of(depth);
    change(arrays.camera);
    return refusal_of(arrays);
  };
  EXPECT_EQ(with([](Camera& c) { c = {}; }),
            "camera: fx is 0; a number above 0 is allowed, pixels per unit at depth 1");
  EXPECT_NE(with([](Camera& c) { c.fy = nan; }).find("fy is nan"), std::string::npos);
  EXPECT_NE(with([](Camera& c) { c.fx = std::numeric_limits<double>::infinity(); }).find("fx is inf"),
            std::string::npos);
  EXPECT_NE(with([](Camera& c) { c.cx = nan; }).find("cx is nan"), std::string::npos);
  EXPECT_NE(with([](Camera& c) { c.pose.emplace().position.y = nan; }).find("position is nan"), std::string::npos);
  EXPECT_NE(with([](Camera& c) { c.pose.emplace().world_to_view[1][2] = nan; }).find("[1][2]"), std::string::npos);
  for (const double degrees : {0.0, 180.0, double(nan)})
    EXPECT_NE(message_of([&] { camera_with_fov(width, height, degrees); }).find("1 to 179"), std::string::npos);
}

TEST(Arrays, DepthWithoutASurfaceIsOpen) {
  for (const float value : {nan, 0.0f, -1.0f, std::numeric_limits<float>::infinity()}) {
    const std::vector<float> depth(width * height, value);
    for (const float ao : ambient_occlusion(arrays_of(depth), device())) ASSERT_EQ(ao, 1) << value;
  }
}

TEST(Arrays, WhatIsMissingIsNamed) {
  Arrays arrays = arrays_of({});
  arrays.planes.clear();
  const std::string nothing = message_of([&] { ambient_occlusion(arrays, device()); });
  EXPECT_NE(nothing.find("depth"), std::string::npos) << nothing;
  const std::vector<float> depth = two_walls();
  const Frame frame = frame_from(arrays_of(depth));
  EXPECT_EQ(message_of([&] { values_of(frame, "ao"); }), "view '' has no plane 'ao'; it has depth");
  EXPECT_NE(message_of([&] { values_of(frame, "depth", "left"); }).find("left"), std::string::npos);
  EXPECT_NE(message_of([&] { compute({.outputs = {"hbaoplus"}}, frame, device()); }).find("hbaoplus"),
            std::string::npos);
}

TEST(Arrays, RadiiThatAreNoneAreRefused) {
  const std::vector<float> depth = two_walls();
  for (const double radius : {-1.0, double(nan)}) {
    const std::string message = message_of([&] { ambient_occlusion(arrays_of(depth), device(), {.radius = radius}); });
    EXPECT_NE(message.find("radius"), std::string::npos) << message;
  }
}

/// Frames that a program has composed, or taken apart, by itself.
TEST(Frames, ThatNothingCanBeComputedOfAreRefused) {
  const std::vector<float> depth = two_walls();
  const PlanRequest request{.outputs = {"hbao+"}, .radius = 1.0};
  const Plan plan = make_plan(request, {"depth"}, "the frame has only depth");
  const auto refused = [&](auto change, const std::string& why) {
    Frame frame = frame_from(arrays_of(depth));
    change(frame);
    const std::string by_run = message_of([&] { run(plan, frame, device()); });
    const std::string by_compute = message_of([&] { compute(request, frame, device()); });
    EXPECT_NE(by_run.find(why), std::string::npos) << by_run;
    EXPECT_NE(by_compute.find(why), std::string::npos) << by_compute;
  };
  refused([](Frame& f) { f.views.clear(); }, "no view");
  refused([](Frame& f) { f.window = {}; }, "0 x 0 pixels");
  refused([](Frame& f) { f.window = {5, 0, 1, 32}; }, "-4 x 32 pixels");
  refused([](Frame& f) { f.views[0].camera.reset(); }, "has no camera");
  refused([](Frame& f) { f.views[0].camera->fx = nan; }, "fx is nan");
  refused([](Frame& f) { f.views[0].planes["depth"].channels.clear(); }, "has 0 channels");
  refused([](Frame& f) { f.views[0].planes["depth"].channels[0] = Channel(Layout(8, 8), 1); }, "not the size");
  refused([](Frame& f) { const Channel taken = std::move(f.views[0].planes["depth"].channels[0]); }, "no memory");
}

TEST(Run, OptionsThatAreNotAllowedAreRefused) {
  const std::vector<float> depth = two_walls();
  const auto message = [&](const RunOptions& options) {
    return message_of([&] { ambient_occlusion(arrays_of(depth), device(), {}, options); });
  };
  EXPECT_NE(message({.lanes = 3}).find("3 lanes"), std::string::npos);
  EXPECT_NE(message({.lanes = -1}).find("-1 lanes"), std::string::npos);
  EXPECT_NE(message({.repeat = 0}).find("0 runs"), std::string::npos);
}

TEST(Devices, ThatHaveBeenMovedAreRefused) {
  Device one;
  const Device other = std::move(one);
  EXPECT_FALSE(other.info().name.empty());
  const std::vector<float> depth = two_walls();
  EXPECT_NE(message_of([&] { ambient_occlusion(arrays_of(depth), one); }).find("has been moved"), std::string::npos);
}

TEST(Devices, TakeThreadsOneAfterAnother) {
  const std::vector<float> depth = two_walls();
  const PlanRequest request{.radius = 1.0};
  const std::vector<float> alone = ambient_occlusion(arrays_of(depth), device(), request);
  Device shared;
  std::vector<std::vector<float>> results(4);
  std::vector<std::thread> threads;
  for (std::vector<float>& result : results) {
    threads.emplace_back([&] {
      for (int i = 0; i < 3; ++i) result = ambient_occlusion(arrays_of(depth), shared, request);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<float>& result : results) EXPECT_EQ(result, alone);
}

}  // namespace
}  // namespace gloam::test::arrays_test
