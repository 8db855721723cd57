// Frames in strips of rows: the same image as whole, where the radius and the filters allow strips.
#include "gloam/strips.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gloam/compute.h"

namespace gloam::test::strips_test {
namespace {

constexpr int width = 64, height = 400;

/// A wall with steps, so that there is something to find in every strip.
Frame steps() {
  std::vector<float> depth(width * height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) depth[size_t(y * width + x)] = 5 + 0.1f * float((x / 8 + y / 8) % 2);
  }
  return frame_from(
      {.width = width, .height = height, .camera = camera_with_fov(width, height, 20), .planes = {{"depth", depth}}});
}

PlanRequest gtao(double radius) { return {.outputs = {"gtao"}, .settings = {{"jitter", "off"}}, .radius = radius}; }

double largest_difference(const Frame& a, const Frame& b, const std::string& plane) {
  const std::vector<float> left = values_of(a, plane), right = values_of(b, plane);
  double largest = 0;
  for (size_t i = 0; i < left.size(); ++i) largest = std::max(largest, std::abs(double(left[i]) - right[i]));
  return largest;
}

TEST(Strips, AreTheWholeImage) {
  const Frame frame = steps();
  Device device;
  const Plan plan = plan_on(gtao(0.2), frame).plan;
  const Strips strips = strips_for(plan, frame, device.info(), 4);
  EXPECT_EQ(strips.why_not, "");
  EXPECT_EQ(strips.count, 4);
  EXPECT_EQ(strips.rows, 100);
  EXPECT_LT(strips.margin, 100);
  const RunOptions precise{.math = Math::precise};
  const RunResult whole = run(plan, frame, device, precise),
                  divided = run_in_strips(plan, frame, device, precise, strips);
  for (const char* plane : {"ao", "ao_raw"})
    EXPECT_LT(largest_difference(whole.frame, divided.frame, plane), 1e-3) << plane;
  EXPECT_LT(divided.device_bytes, whole.device_bytes);
  EXPECT_EQ(divided.passes.size(), whole.passes.size());
}

/// All that a run says beside the planes.
TEST(Strips, SayWhatTheWholeImageSays) {
  Frame frame = steps();
  frame.assumed = {"a sentence"};
  frame.pixel_aspect = 1.5;
  frame.views.front().origin = {1, 2, 3};
  std::vector<float> mask(width * height);
  for (int y = 0; y < height; ++y) std::fill_n(mask.begin() + y * width, width, y < height / 2 ? 1.0f : 0.0f);
  frame.views.front().planes["mask"] = plane_from("mask", width, height, mask);
  Device device;
  PlanRequest request = gtao(0.2);
  request.only = "mask";
  request.elsewhere = "hbao+";
  const Plan plan = plan_on(request, frame).plan;
  const Strips strips = strips_for(plan, frame, device.info(), 4);
  ASSERT_EQ(strips.why_not, "");
  const RunResult whole = run(plan, frame, device, {}), divided = run_in_strips(plan, frame, device, {}, strips);
  EXPECT_EQ(divided.frame.assumed, whole.frame.assumed);
  EXPECT_EQ(divided.frame.pixel_aspect, whole.frame.pixel_aspect);
  EXPECT_TRUE(divided.frame.window == whole.frame.window);
  EXPECT_EQ(divided.frame.views.front().origin, whole.frame.views.front().origin);
  EXPECT_EQ(divided.frame.views.front().name, whole.frame.views.front().name);
  EXPECT_NEAR(whole.rest_share, 0.5, 0.1);
  EXPECT_NEAR(divided.rest_share, whole.rest_share, 0.05);  // rows of lanes at the mask's edge
}

TEST(Strips, AreAsFewAsFit) {
  const Frame frame = steps();
  const Plan plan = plan_on(gtao(0.2), frame).plan;
  DeviceInfo small{
      .name = "small", .memory = device_bytes(plan, Layout(width, height)) / 2 + 1, .largest_buffer = 1 << 30};
  const Strips strips = strips_for(plan, frame, small);
  EXPECT_EQ(strips.why_not, "");
  EXPECT_GT(strips.count, 1);
  EXPECT_LE(strips.device_bytes, small.memory);
  small.memory = 2 * device_bytes(plan, Layout(width, height));
  EXPECT_EQ(strips_for(plan, frame, small).count, 1);
}

TEST(Strips, AreRefusedWhereTheRadiusReachesTooFar) {
  const Frame frame = steps();
  PlanRequest wide = gtao(1e6);
  wide.settings.emplace_back("max_reach", "1");
  const Plan plan = plan_on(wide, frame).plan;
  const DeviceInfo small{
      .name = "small", .memory = device_bytes(plan, Layout(width, height)) / 4, .largest_buffer = 1 << 30};
  EXPECT_NE(strips_for(plan, frame, small).why_not.find("rows of the 400"), std::string::npos)
      << strips_for(plan, frame, small).why_not;
}

TEST(Strips, AreRefusedWhereAnImageDependsOnAllOfAnother) {
  const Frame frame = steps();
  Device device;
  for (const char* technique : {"multires", "corner-mask"}) {
    const Plan plan = plan_on({.outputs = {technique}, .radius = 0.2}, frame).plan;
    const Strips strips = strips_for(plan, frame, device.info(), 2);
    EXPECT_NE(strips.why_not, "") << technique;
    EXPECT_THROW(run_in_strips(plan, frame, device, {}, strips), Error) << technique;
  }
}

}  // namespace
}  // namespace gloam::test::strips_test
