// Stacks: planes of one meaning in layers, from the names in a file to the buffer that a kernel reads.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "gloam/error.h"
#include "gloam/exr.h"
#include "gloam/normalise.h"
#include "gloam/plan.h"
#include "gloam/planes.h"
#include "gloam/run.h"
#include "support/stress.h"
#include "support/techniques.h"
#include "unit/message_of.h"

namespace gloam::test::stack_test {
namespace {

namespace fs = std::filesystem;

using Names = std::vector<std::string>;

Plan plan_of(const std::string& output, const Names& available) {
  return make_plan({.outputs = {output}, .filter = "none"}, available, "frame.exr has only R, G, B");
}

TEST(Stacks, Names) {
  EXPECT_TRUE(is_stack("peel") && is_stack("stochastic"));
  EXPECT_FALSE(is_stack("depth") || is_stack("peel.00") || is_stack("peel_count"));
  EXPECT_EQ(layer_name("peel", 7), "peel.07");
  EXPECT_EQ(layer_name("peel", 63), "peel.63");
  for (int number = 0; number < 100; ++number) {
    const std::optional<StackLayer> layer = stack_layer(layer_name("stochastic", number));
    ASSERT_TRUE(layer);
    EXPECT_EQ(layer->stack, "stochastic");
    EXPECT_EQ(layer->number, number);
  }
  for (const char* name : {"peel", "peel.", "peel.1", "peel.001", "peel.x1", "depth.00", ".00", "peel.00.Z"})
    EXPECT_FALSE(stack_layer(name)) << name;
}

TEST(Stacks, APlanTakesAllLayersAndTellsTheKernelHowMany) {
  const Plan plan = plan_of("dp-hbao+", {"depth", "normal", "peel.01", "peel.00", "peel.02", "peel_count"});
  EXPECT_EQ(plan.inputs, (Names{"depth", "normal", "peel.00", "peel.01", "peel.02"}));
  EXPECT_EQ(plan.stacks.at("peel"), (Names{"peel.00", "peel.01", "peel.02"}));
  ASSERT_EQ(plan.passes.size(), 1u);
  const auto& defines = plan.passes[0].pass.defines;
  EXPECT_EQ(std::count(defines.begin(), defines.end(), std::pair<std::string, int>("OCCLUDERS_LAYERS", 3)), 1);
  const Layout layout(40, 30);
  EXPECT_EQ(device_bytes(plan, layout), (1 + 3 + 3 + 1) * layout.bytes()) << "depth, normal, three layers, ao_raw";
}

TEST(Stacks, OnePlaneAmongTheSkipped) {
  const Plan plan = plan_of("hbao+", {"depth", "normal", "peel.00", "peel.01", "peel_count"});
  EXPECT_EQ(plan.inputs, (Names{"depth", "normal"}));
  EXPECT_TRUE(plan.stacks.empty());
  Names skipped;
  for (const auto& [what, why] : plan.skipped) skipped.push_back(what);
  EXPECT_EQ(skipped, (Names{"normals", "peel", "peel_count"})) << "the technique normals, and planes";
}

TEST(Stacks, PeeledLayersDoNotChangeWhatMakesAoByDefault) {
  const Plan plan = plan_of("ao_raw", {"depth", "normal", "peel.00"});
  EXPECT_EQ(plan.technique, "evidence");
}

TEST(Stacks, WhatIsMissingIsNamed) {
  const std::string none = message_of([] { plan_of("dp-hbao+", {"depth", "normal"}); });
  EXPECT_EQ(none,
            "dp-hbao+: needs 'peel', and frame.exr has only R, G, B (gloam capture --peel N makes 'peel'; see "
            "docs/gbuffer.md)");
  const std::string gap = message_of([] { plan_of("dp-hbao+", {"depth", "normal", "peel.00", "peel.02"}); });
  EXPECT_EQ(gap, "dp-hbao+: needs 'peel.01', and frame.exr has only R, G, B (see docs/gbuffer.md)");
  const std::string no_first = message_of([] { plan_of("dp-hbao+", {"depth", "normal", "peel.01"}); });
  EXPECT_NE(no_first.find("needs 'peel',"), std::string::npos) << no_first;
  EXPECT_NE(message_of([] { plan_of("peel", {"peel.00"}); }).find("nothing makes 'peel'"), std::string::npos)
      << "a stack is no plane that could be written";
}

TEST(Stacks, AFrameWithoutALayerThatThePlanTakes) {
  const Plan plan = plan_of("dp-hbao+", {"depth", "normal", "peel.00", "peel.01"});
  Frame frame = shoot(perspective(20, 10), room());
  invent_plane(frame, "peel.00");
  EXPECT_EQ(message_of([&] { run(plan, frame, device()); }), "dp-hbao+: view '' has no plane 'peel.01'");
}

TEST(Stacks, ABufferTooLargeIsRefusedWithTheNameOfTheStack) {
  Names available = {"depth", "normal"};
  for (int number = 0; number < 100; ++number) available.push_back(layer_name("peel", number));
  const Plan plan = plan_of("dp-hbao+", available);
  const std::string refusal = message_of([&] { check(plan, Layout(16384, 16384), 1, device()); });
  EXPECT_NE(refusal.find("16384x16384 pixels"), std::string::npos) << refusal;
}

// --- Files

/// Layers of depth 1, 2, ... in each of two views.
Frame two_views(const std::vector<int>& left, const std::vector<int>& right) {
  Frame frame;
  frame.display = frame.window = {0, 0, 8, 6};
  for (const char* name : {"left", "right"}) {
    View& view = frame.views.emplace_back();
    view.name = name;
    view.camera = perspective(8, 6).camera;
    view.planes["depth"].name = "depth";
    view.planes["depth"].channels.emplace_back(Layout(8, 6), 1.0f);
    for (const int number : view.name == "left" ? left : right) {
      Plane& layer = view.planes[layer_name("peel", number)];
      layer.name = layer_name("peel", number);
      layer.channels.emplace_back(Layout(8, 6), 1.0f + float(number));
    }
  }
  normalise(frame);
  return frame;
}

class StackFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "gloam_stack_XXXXXX").string();
    folder = ::mkdtemp(pattern.data());
  }
  void TearDown() override { fs::remove_all(folder); }
  FrameFile written(const Frame& frame) const {
    write_frame(folder / "f.exr", frame);
    return FrameFile(folder / "f.exr", {});
  }
  fs::path folder;
};

TEST_F(StackFiles, AViewWithFewerLayersSeesNothingInTheOthers) {
  FrameFile file = written(two_views({0, 1, 2}, {0}));
  EXPECT_EQ(file.common_planes(), (Names{"depth", "peel.00", "peel.01", "peel.02"}));
  EXPECT_EQ(file.why_missing("peel.02"), "");
  EXPECT_EQ(file.why_missing("peel"), "");
  const Frame frame = file.read({"depth", "peel.00", "peel.01", "peel.02"});
  for (const std::string& sentence : frame.assumed) EXPECT_EQ(sentence.find("peel"), std::string::npos) << sentence;
  for (int number = 0; number < 3; ++number) {
    const Channel& left = frame.view("left").find(layer_name("peel", number))->channels[0];
    const Channel& right = frame.view("right").find(layer_name("peel", number))->channels[0];
    for (int y = 0; y < 6; ++y) {
      for (int x = 0; x < 8; ++x) {
        EXPECT_EQ(left.at(x, y), 1.0f + float(number));
        EXPECT_EQ(right.at(x, y), number == 0 ? 1.0f : std::numeric_limits<float>::infinity());
      }
    }
  }
}

TEST_F(StackFiles, BothViewsRunWithTheLargerNumberOfLayers) {
  FrameFile file = written(two_views({0, 1}, {0, 1, 2, 3}));
  Frame frame = file.read(file.common_planes());
  const Plan plan = plan_of("dp-hbao+", file.common_planes());
  EXPECT_EQ(plan.stacks.at("peel").size(), 4u);
  EXPECT_EQ(run(plan, frame, device()).frame.views.size(), 2u);
}

TEST_F(StackFiles, AGapInOneViewIsMissing) {
  const FrameFile file = written(two_views({0, 1, 2}, {0, 2}));
  EXPECT_EQ(file.common_planes(), (Names{"depth", "peel.00", "peel.02"}));
  EXPECT_EQ(file.why_missing("peel.01"), "view 'right' has no peel.01");
}

TEST_F(StackFiles, AViewWithoutLayersIsNamed) {
  const FrameFile file = written(two_views({0, 1}, {}));
  EXPECT_EQ(file.common_planes(), Names{"depth"});
  EXPECT_EQ(file.why_missing("peel"), "view 'right' has no peel");
}

}  // namespace
}  // namespace gloam::test::stack_test
