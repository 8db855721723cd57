// What gloam auto keeps for its picture: of each effect the part of the frame's picture that it changes most, without it and with it.
#include <gtest/gtest.h>

#include <cmath>

#include "gloam/auto.h"
#include "gloam/compute.h"

namespace gloam::test::picture_parts_test {
namespace {

constexpr int width = 480, height = 288;

/// A grey wall, with steps to the right and below.
Frame steps_in_a_corner() {
  std::vector<float> depth(width * height, 5), color(width * height * 3, 0.5f);
  for (int y = 192; y < height; ++y)
    for (int x = 320; x < width; ++x) depth[size_t(y * width + x)] = 5 + 0.3f * float((x / 16 + y / 16) % 2);
  return frame_from({.width = width,
                     .height = height,
                     .camera = camera_with_fov(width, height, 60),
                     .planes = {{"depth", depth}, {"color", color}}});
}

AutoResult explained(const Goal& goal) {
  const Frame frame = steps_in_a_corner();
  Device device;
  return compute_auto(frame, {.radius = 0.5}, {.mask = MaskUse::never, .purpose = {.explains = true}, .goal = goal},
                      device);
}

const Outcome& occlusion_of(const AutoResult& result) {
  for (const Outcome& outcome : result.outcomes)
    if (outcome.decision.effect.technique->effect.changes == "ao") return outcome;
  throw Error("no ambient occlusion");
}

/// RMS difference of a part from the same pixels of a picture, or from a level where there is none.
double difference(const Plane& part, const Plane* picture, int left, int top, int step) {
  double sum = 0, count = 0;
  for (size_t c = 0; c < part.channels.size(); ++c) {
    const Layout& layout = part.channels[c].layout();
    for (int y = 0; y < layout.height; ++y)
      for (int x = 0; x < layout.width; ++x, ++count) {
        const float there = picture ? picture->channels[c].at(left + x * step, top + y * step) : 0.5f;
        sum += std::pow(double(part.channels[c].at(x, y)) - there, 2);
      }
  }
  return std::sqrt(sum / count);
}

TEST(PictureParts, AreWhereTheEffectChangesThePictureMost) {
  const AutoResult result = explained({});
  const Outcome& occlusion = occlusion_of(result);
  ASSERT_TRUE(occlusion.runs());
  ASSERT_TRUE(result.picture);
  const PicturePart& part = occlusion.parts.at("");
  EXPECT_EQ(part.step, 1);
  EXPECT_EQ(part.with.channels.front().layout(), Layout(160, 96));
  EXPECT_NEAR(part.left, 320.0 / width, 0.05);
  EXPECT_NEAR(part.top, 192.0 / height, 0.05);
  const int left = int(std::lround(part.left * width)), top = int(std::lround(part.top * height));
  EXPECT_EQ(difference(part.with, result.picture->views[0].find("color"), left, top, 1), 0);
  EXPECT_EQ(difference(part.without, nullptr, 0, 0, 1), 0);
  EXPECT_GT(difference(part.with, nullptr, 0, 0, 1), 0.01);
  ASSERT_TRUE(result.expected);
  EXPECT_GT(result.expected->error, 0);
}

TEST(PictureParts, OfWhatABudgetLeavesOutAreAsTheLookSawThem) {
  const AutoResult result = explained({.ms = 1e-6});
  const Outcome& occlusion = occlusion_of(result);
  ASSERT_FALSE(occlusion.runs());
  const PicturePart& part = occlusion.parts.at("");
  EXPECT_EQ(part.step, 4);
  EXPECT_EQ(part.with.channels.front().layout(), Layout(40, 24));
  EXPECT_EQ(difference(part.without, nullptr, 0, 0, 4), 0);
  EXPECT_GT(difference(part.with, nullptr, 0, 0, 4), 0.01);
  // Nothing was computed: the picture is the colour.
  EXPECT_EQ(difference(*result.picture->views[0].find("color"), nullptr, 0, 0, 1), 0);
  EXPECT_EQ(result.expected->error, result.expected->of_color_alone);
}

}  // namespace
}  // namespace gloam::test::picture_parts_test
