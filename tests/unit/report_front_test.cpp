// The Pareto front that gloam report shows, of a scene and of a class of scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "report/front.h"

namespace gloam::report {
namespace {

using Indices = std::vector<size_t>;

TEST(ParetoFront, HoldsWhatNoOtherBeats) {
  EXPECT_EQ(pareto_front({}), Indices{});
  EXPECT_EQ(pareto_front({{1, 1}}), Indices{0});
  // Fastest first; (3, 2) is beaten by (2, 2) in time and equal in error; (4, 4) in both.
  EXPECT_EQ(pareto_front({{5, 1}, {3, 2}, {2, 2}, {4, 4}, {1, 3}}), (Indices{4, 2, 0}));
  EXPECT_EQ(pareto_front({{1, 3}, {1, 2}}), Indices{1});  // the same time
}

TEST(ParetoFront, KeepsEqualsAndPassesOverWhatIsNotFinite) {
  EXPECT_EQ(pareto_front({{1, 1}, {1, 1}, {2, 1}}), (Indices{0, 1}));
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(pareto_front({{nan, 0}, {0, nan}, {-infinite, 0}, {infinite, 0}, {1, 1}}), Indices{4});
}

TEST(ParetoFront, FollowsItsDefinitionOnManyPoints) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> digit(0, 12);
  for (int round = 0; round < 50; ++round) {
    std::vector<Cost> points;
    for (int i = 0; i < 60; ++i) points.push_back({double(digit(random)), double(digit(random))});
    const Indices front = pareto_front(points);
    // An independent way to say it: the least error at each time, where that is less than at any smaller time.
    for (size_t i = 0; i < points.size(); ++i) {
      double before = 1e9, at = 1e9;
      for (const Cost& p : points) {
        if (p.time < points[i].time) before = std::min(before, p.error);
        if (p.time == points[i].time) at = std::min(at, p.error);
      }
      const bool expected = points[i].error == at && points[i].error < before;
      EXPECT_EQ(std::count(front.begin(), front.end(), i), expected) << round << " " << i;
    }
  }
}

Row row(const std::string& scene, const std::string& technique, Number ratio, Number error,
        const std::string& variant = "") {
  Row made;
  made.scene = scene;
  made.technique = technique;
  made.preset = "low";
  made.variant = variant;
  made.ms.median = 10 * ratio.value_or(1);
  made.ratio_to_hbao_plus = ratio;
  made.rmse_to_truth = error;
  return made;
}

TEST(SceneFront, IsOfItsOwnRowsByRatio) {
  std::vector<Row> rows = {row("a", "slow", 2, 0.1),   row("b", "other", 0.1, 0.01),        row("a", "fast", 1, 0.2),
                           row("a", "beaten", 3, 0.3), row("a", "half", 0.5, 0.05, "half"), row("a", "blind", 0.1, {})};
  rows[0].ms.median = 1000;  // ratios count, not milliseconds
  const SceneFront front = front_of_scene(rows, "a");
  EXPECT_EQ(front.time, TimeOf::ratio);
  EXPECT_EQ(front.candidates, 4u);
  EXPECT_EQ(front.all, Indices{4});
  EXPECT_EQ(front.plain, (Indices{2, 0}));
  EXPECT_TRUE(front_of_scene(rows, "missing").all.empty());
}

TEST(SceneFront, IsByMillisecondsWhereARatioIsMissing) {
  std::vector<Row> rows = {row("a", "x", {}, 0.1), row("a", "y", 1, 0.2)};
  rows[0].ms.median = 1;
  rows[1].ms.median = 2;
  const SceneFront front = front_of_scene(rows, "a");
  EXPECT_EQ(front.time, TimeOf::ms);
  EXPECT_EQ(front.all, Indices{0});
}

TEST(ClassFront, IsOfMeansAndCountsTheScenes) {
  Measurements m;
  for (const char* name : {"a", "b", "c", "dark"})
    m.scenes.push_back({name, std::string(name) == "c" ? "thin" : "big"});
  m.rows = {row("a", "lucky", 1, 0.1),      row("b", "lucky", 1, 0.5),  // good on a only
            row("a", "steady", 1, 0.2),     row("b", "steady", 1, 0.2),
            row("a", "fine", 4, 0.05),      row("b", "fine", 2, 0.15),  //
            row("a", "partial", 0.1, 0.01),                             // measured on one scene
            row("c", "lucky", 1, 0.1),      row("dark", "steady", 1, {})};
  const std::vector<ClassFront> fronts = fronts_of_classes(m);
  ASSERT_EQ(fronts.size(), 2u);
  const ClassFront& big = fronts[0];
  EXPECT_EQ(big.name, "big");
  EXPECT_EQ(big.scenes, (std::vector<std::string>{"a", "b"}));  // not the one without truth
  EXPECT_EQ(big.left_out, 1u);
  ASSERT_EQ(big.points.size(), 3u);
  EXPECT_EQ(big.points[0].technique, "steady");
  EXPECT_TRUE(big.points[0].on_front);
  EXPECT_DOUBLE_EQ(big.points[0].error, 0.2);
  EXPECT_EQ(big.points[0].fronts, std::vector<std::string>{"b"});
  EXPECT_EQ(big.points[1].technique, "lucky");
  EXPECT_FALSE(big.points[1].on_front);
  EXPECT_TRUE(big.points[1].fronts.empty());  // "partial" beats it on a
  EXPECT_EQ(big.points[2].technique, "fine");
  EXPECT_TRUE(big.points[2].on_front);
  EXPECT_DOUBLE_EQ(big.points[2].ratio, 3);
  EXPECT_DOUBLE_EQ(big.points[2].error, 0.1);
  EXPECT_EQ(fronts[1].name, "thin");
  EXPECT_EQ(fronts[1].points.size(), 1u);
}

TEST(ClassFront, HasAFrontOfPlainSettingsOfItsOwn) {
  Measurements m;
  m.scenes.push_back({"a", ""});
  m.rows = {row("a", "x", 1, 0.2), row("a", "x", 0.5, 0.1, "half")};
  const ClassFront front = fronts_of_classes(m).at(0);
  EXPECT_EQ(front.name, "");
  for (const ClassPoint& point : front.points) {
    EXPECT_EQ(point.on_front, point.variant == "half");
    EXPECT_EQ(point.on_plain_front, point.variant.empty());
  }
}

}  // namespace
}  // namespace gloam::report
