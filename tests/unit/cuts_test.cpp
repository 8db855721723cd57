// Cuts in a shot, by its camera's poses.
#include "shot/cuts.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace gloam::test::cuts_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// At `x` on a line, turned about the upright by an angle.
FramePose at(int frame, double x, double degrees = 0) {
  const glm::dmat3 turned(glm::rotate(glm::dmat4(1), degrees * degree, glm::dvec3(0, 1, 0)));
  return {frame, Pose{.world_to_view = turned, .position = {x, 0, 0}}};
}

std::vector<FramePose> walk(int count, double step, double turn = 0) {
  std::vector<FramePose> poses;
  for (int i = 0; i < count; ++i) poses.push_back(at(i + 1, i * step, i * turn));
  return poses;
}

using Frames = std::vector<int>;

TEST(Cuts, ACameraThatMovesEvenlyHasNone) {
  for (const double step : {0.0, 0.01, 3.0})
    for (const double turn : {0.0, 1.0, 30.0}) EXPECT_EQ(cuts_in(walk(20, step, turn), 0.5), Frames{}) << step << turn;
}

TEST(Cuts, AJumpIsOneAndAStartIsNot) {
  std::vector<FramePose> poses = walk(10, 0.05);
  for (size_t i = 6; i < poses.size(); ++i) poses[i].pose->position.x += 4;
  EXPECT_EQ(cuts_in(poses, 0.5), Frames{7});
  EXPECT_EQ(cuts_in(poses, 5), Frames{});  // less than what is near
  // From rest to a walk: each step is like the next.
  poses = walk(10, 0);
  for (size_t i = 5; i < poses.size(); ++i) poses[i].pose->position.x = 0.8 * double(i - 4);
  EXPECT_EQ(cuts_in(poses, 0.5), Frames{});
}

TEST(Cuts, ATurnToTheOtherSideIsOne) {
  std::vector<FramePose> poses = walk(10, 0.05, 0.5);
  for (size_t i = 4; i < poses.size(); ++i) poses[i] = at(poses[i].frame, 0.05 * double(i), 0.5 * double(i) + 120);
  EXPECT_EQ(cuts_in(poses, 0.5), Frames{5});
}

TEST(Cuts, FramesLeftOutAreNone) {
  EXPECT_EQ(cuts_in({at(1, 0), at(2, 0.2), at(40, 7.8), at(41, 8)}, 0.5), Frames{});
  EXPECT_EQ(cuts_in({at(1, 0), at(2, 0.2), at(3, 7.8), at(4, 8)}, 0.5), Frames{3});
}

TEST(Cuts, ASingleStepTellsNothing) {
  EXPECT_EQ(cuts_in({at(1, 0), at(2, 6)}, 0.5), Frames{});
  EXPECT_EQ(cuts_in({at(1, 0), at(2, 6), {3, {}}}, 0.5), Frames{});
}

TEST(Cuts, OneAfterTheOtherAreBothFound) {
  EXPECT_EQ(cuts_in({at(1, 0), at(2, 0.1), at(3, 20.1), at(4, 40.1), at(5, 40.2)}, 0.5), (Frames{3, 4}));
}

TEST(Cuts, TheLeastDistanceIsNotOneOfEachFrame) {
  EXPECT_EQ(cuts_in({at(1, 0), at(11, 0, 1), at(21, 0, 2), at(31, 0, 182), at(41, 0, 183)}, 0.5), Frames{31});
}

TEST(Cuts, WhatIsUnknownIsNone) {
  std::vector<FramePose> poses = walk(10, 0.05);
  for (size_t i = 6; i < poses.size(); ++i) poses[i].pose->position.x += 4;
  poses[5].pose.reset();
  EXPECT_EQ(cuts_in(poses, 0.5), Frames{});
  EXPECT_EQ(cuts_in({}, 0.5), Frames{});
}

}  // namespace
}  // namespace gloam::test::cuts_test
