// The Pareto front of gloam report, for a scene and for a class of scenes, and its use on the page of documentation: which
// setting for which need, in which figures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

#include "gloam/error.h"
#include "report/markdown_text.h"
#include "report/needs.h"
#include "results/front.h"
#include "results/joined.h"

namespace gloam::report::report_front_test {
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
    // An independent definition: the least error at each time, if it is less than at any smaller time.
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

TEST(ClassFront, HasTheMeanBiasOrNone) {
  Measurements m;
  m.scenes = {{"a", "big"}, {"b", "big"}};
  m.rows = {row("a", "x", 1, 0.2), row("b", "x", 1, 0.2), row("a", "y", 2, 0.1), row("b", "y", 2, 0.1)};
  m.rows[0].bias = 0.1;
  m.rows[1].bias = -0.3;
  m.rows[2].bias = 0.1;
  const ClassFront front = fronts_of_classes(m).at(0);
  EXPECT_NEAR(*front.points[0].bias, -0.1, 1e-12);
  EXPECT_FALSE(front.points[1].bias);  // unknown on b
}

// --- Needs

ClassPoint point(const std::string& technique, double ratio, double error, const std::string& variant = "",
                 const Reads& reads = {{"depth"}}) {
  ClassPoint made;
  made.reads = reads;
  made.technique = technique;
  made.preset = "low";
  made.variant = variant;
  made.ratio = ratio;
  made.error = error;
  return made;
}

/// Need -> technique, "none" if nothing meets it.
std::vector<std::pair<std::string, std::string>> chosen(const std::vector<ClassPoint>& points) {
  std::vector<std::pair<std::string, std::string>> found;
  for (const Choice& choice : choices({"group", {"a"}, points, 0}))
    found.emplace_back(choice.need, choice.best ? choice.best->technique : "none");
  return found;
}

using Chosen = std::vector<std::pair<std::string, std::string>>;

TEST(Needs, TakeWhatIsNearestWithinTheTime) {
  const std::vector<ClassPoint> points = {
      point("fastest", 0.3, 0.25),
      point("one", 1.04, 0.16),  // printed as 1.0
      point("above", 1.06, 0.13),
      point("two", 1.9, 0.12),
      point("five", 5, 0.1),
      point("dearest", 30, 0.09),
      point("far layers", 2, 0.2, "", {{"depth", "peel"}}),
      point("near layers", 9, 0.08, "", {{"depth", "stochastic"}}),
      point("two views", 1, 0.081, "", {{"depth"}, 2}),
      point("layers", 0.1, 0.05, "half", {{"depth", "peel"}}),
      point("reduced", 0.45, 0.2, "half"),
      point("tiny", 0.1, 0.3, "quarter"),
      point("slow", 0.496, 0.1, "half"),      // printed as 0.50
      point("exact", 0.1, 0.01, "precise")};  // another variant is no answer to any need
  EXPECT_EQ(chosen(points), (Chosen{{"least time", "fastest"},
                                    {"at most the time of HBAO+ medium", "one"},
                                    {"at most 2 times that", "two"},
                                    {"at most 5 times that", "five"},
                                    {"nearest to the truth at any price, one layer", "dearest"},
                                    {"nearest to the truth with further layers", "near layers"},
                                    {"less than half the time of HBAO+ medium, at a lower resolution", "reduced"}}));
}

TEST(Needs, CompareWhatIsPrinted) {
  // .1196 and .1204 are both .120: the faster. .1206 is .121.
  EXPECT_EQ(chosen({point("dear", 4, 0.1196), point("cheap", 0.9, 0.1204), point("worse", 0.8, 0.1206)})[3].second,
            "cheap");
  // 0.301 and 0.304 are both 0.30: the nearer.
  EXPECT_EQ(chosen({point("far", 0.301, 0.2), point("near", 0.304, 0.1), point("slow", 0.31, 0.05)})[0].second, "near");
}

TEST(Needs, AreLeftOutWhereNothingWasMeasuredForThemAndUnmetWhereNothingMeetsThem) {
  EXPECT_EQ(chosen({point("slow", 3, 0.1)}), (Chosen{{"least time", "slow"},
                                                     {"at most the time of HBAO+ medium", "none"},
                                                     {"at most 2 times that", "none"},
                                                     {"at most 5 times that", "slow"},
                                                     {"nearest to the truth at any price, one layer", "slow"}}));
  EXPECT_EQ(chosen({point("x", 3, 0.1, "", {{"depth", "peel"}})}),
            (Chosen{{"nearest to the truth with further layers", "x"}}));
}

TEST(Needs, ChooseFromTheFront) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> time(0.2, 6), error(0.1, 0.13);
  for (int round = 0; round < 200; ++round) {
    std::vector<ClassPoint> points;
    std::vector<Cost> costs;
    for (int i = 0; i < 30; ++i) {
      // Rounded now and then, so that some are equal.
      const double t = round % 2 ? time(random) : std::round(5 * time(random)) / 5, e = error(random);
      points.push_back(point(std::to_string(i), t, round % 3 ? e : std::round(200 * e) / 200));
      costs.push_back({points.back().ratio, points.back().error});
    }
    const Indices front = pareto_front(costs);
    for (const auto& [need, technique] : chosen(points)) {
      if (technique == "none") continue;
      EXPECT_TRUE(std::count(front.begin(), front.end(), std::stoul(technique))) << need << ", round " << round;
    }
  }
}

// --- Figures and Markdown

TEST(Figures, AreShort) {
  EXPECT_EQ(error_text(0.12749), ".127");
  EXPECT_EQ(error_text(0.0), ".000");
  EXPECT_EQ(error_text(1e-7), "<.001");
  EXPECT_EQ(error_text(1.0), "1.000");
  EXPECT_EQ(error_text({}), "-");
  EXPECT_EQ(bias_text(0.0144), "+.014");
  EXPECT_EQ(bias_text(-0.0144), "-.014");
  EXPECT_EQ(bias_text(-1e-5), "+.000");
  EXPECT_EQ(error_and_bias(0.127, 0.014), ".127 (+.014)");
  EXPECT_EQ(error_and_bias(0.127, {}), ".127");
  const std::vector<std::pair<double, std::string>> ratios = {{0.0523, "0.052"}, {0.412, "0.41"}, {0.996, "1.0"},
                                                              {1, "1.0"},        {4.96, "5.0"},   {9.96, "10"},
                                                              {11.4, "11"},      {99.6, "100"},   {123, "120"}};
  for (const auto& [ratio, text] : ratios) EXPECT_EQ(ratio_text(ratio), text) << ratio;
}

TEST(Markdown, KeepsTextFromFilesFromBeingMarkup) {
  EXPECT_EQ(plain_text("a|b *c* <i> `d` [e] f_g"), "a\\|b \\*c\\* \\<i\\> \\`d\\` \\[e\\] f\\_g");
  EXPECT_EQ(plain_text("two\nlines").find('\n'), std::string::npos);
  EXPECT_EQ(code("a`b|c"), "`a'b/c`");
  EXPECT_EQ(link_target("a b/c(1).png"), "a%20b/c%281%29.png");
}

TEST(Markdown, WrapsSoThatNoLineBeginsAList) {
  std::string text;
  for (const char* word : {"word", "+", "-", "1.", "#", "*", "2)"}) {
    for (int before = 90; before < 125; ++before) text += std::string(size_t(before), 'x') + " " + word + " ";
  }
  std::istringstream lines(paragraph(text));
  int count = 0;
  for (std::string line; std::getline(lines, line) && !line.empty(); ++count) {
    EXPECT_EQ(std::string("+-*#12").find(line[0]), std::string::npos) << line;
    EXPECT_LE(line.size(), 125u + 3);
  }
  EXPECT_GT(count, 100);
}

// --- Several files

Source source(const std::string& name, const std::string& device, double width, const std::vector<std::string>& scenes,
              const std::string& scene_class = "thin") {
  Source made{name, "out/" + name, {}};
  made.measurements.device = device;
  for (const std::string& scene : scenes) {
    Scene s;
    s.name = scene;
    s.scene_class = scene_class;
    s.width = s.height = width;
    s.radius = 0.5;
    made.measurements.scenes.push_back(s);
    made.measurements.rows.push_back(row(scene, "x", 1, 0.1));
    made.measurements.converged.push_back({"x", scene, 0.1, {}});
  }
  return made;
}

std::vector<std::string> scenes_of(const Measurements& m) {
  std::vector<std::string> names;
  for (const Scene& scene : m.scenes) names.push_back(scene.scene_class + ": " + scene.name);
  return names;
}

TEST(Joined, TellsScenesOfSeveralSizesAndDevicesApart) {
  const std::vector<Source> sources = {source("1.json", "cpu", 8, {"a"}), source("2.json", "cpu", 16, {"a", "b"}),
                                       source("3.json", "gpu", 8, {"a"}), source("4.json", "cpu", 8, {"mine"}, "own"),
                                       source("5.json", "cpu", 8, {"hall"}, "architecture")};
  const Measurements m = joined(sources);
  EXPECT_EQ(scenes_of(m),
            (std::vector<std::string>{"architecture: hall", "thin: a at 8x8 on cpu", "thin: a at 16x16 on cpu",
                                      "thin: b", "thin: a at 8x8 on gpu", "own: mine"}));
  ASSERT_EQ(m.rows.size(), 6u);
  EXPECT_EQ(m.rows[1].scene, "a at 16x16 on cpu");
  EXPECT_EQ(m.rows[1].source, 1u);
  EXPECT_EQ(m.converged[3].scene, "a at 8x8 on gpu");
  EXPECT_EQ(scenes_of(by_group(m, sources)),
            (std::vector<std::string>{"architecture: hall", "thin at 8x8 on cpu: a at 8x8 on cpu",
                                      "thin at 16x16 on cpu: a at 16x16 on cpu", "thin at 16x16 on cpu: b",
                                      "thin at 8x8 on gpu: a at 8x8 on gpu", "own frame mine: mine"}));
}

TEST(Joined, TakesMoreTechniquesOnTheSameSceneButNothingTwice) {
  Source more = source("2.json", "cpu", 8, {"a"});
  more.measurements.rows[0].technique = more.measurements.converged[0].technique = "y";
  const Measurements m = joined({source("1.json", "cpu", 8, {"a"}), more});
  EXPECT_EQ(m.scenes.size(), 1u);
  EXPECT_EQ(m.rows.size(), 2u);
  const auto message = [](const std::vector<Source>& sources) {
    try {
      joined(sources);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(
      message({source("1.json", "cpu", 8, {"a"}), source("2.json", "cpu", 8, {"a"})}),
      "out/2.json: x low on the scene 'a' is also in out/1.json; a page shows it once, leave one of the two files out");
  more.measurements.scenes[0].radius = 0.25;
  EXPECT_EQ(message({source("1.json", "cpu", 8, {"a"}), more}),
            "out/2.json: the scene 'a' has a radius of 0.25, and of 0.5 in out/1.json; leave one of the two files out");
}

}  // namespace
}  // namespace gloam::report::report_front_test
