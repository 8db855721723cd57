// gloam bench --sequence: error and flicker of settings on the frames of a shot, and what it refuses. No times.
#include <cmath>

#include "cli/shot_fixture.h"

namespace gloam::test::bench_sequence_test {
namespace {

using Json = nlohmann::json;

class BenchSequence : public ShotTest {
 protected:
  Arguments bench_of(const std::string& sequence, const Arguments& more = {}) const {
    Arguments all = {"bench", "-o", file("out"), "--sequence", sequence, "--techniques", "gtao", "--presets", "low"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Json measured(const std::string& sequence, const Arguments& more) const {
    const Result result = gloam(bench_of(sequence, more));
    EXPECT_EQ(result.status, 0) << result.err;
    return Json::parse(slurp(path("out/bench.json")));
  }
  /// The fields of `gloam compare` on what `gloam run` makes of shot.####.exr with the same setting.
  Json by_commands(const Arguments& more) const {
    Arguments run = {"run", "gtao",   file("shot.####.exr"), "-o", file("ao.####.exr"), "--preset", "low", "--radius",
                     "0.5", "--float"};
    run.insert(run.end(), more.begin(), more.end());
    EXPECT_EQ(gloam(run).status, 0);
    const Result compared = gloam(
        {"compare", file("ao.####.exr"), file("truth.####.exr"), "--frame", file("shot.####.exr"), "--json", "-"});
    EXPECT_EQ(compared.status, 0) << compared.err;
    return Json::parse(compared.out);
  }
};

const Json& row_of(const Json& document, bool temporal) {
  for (const Json& row : document["sequence"]["rows"]) {
    if (row["temporal"] == temporal) return row;
  }
  throw std::runtime_error("no such row");
}

TEST_F(BenchSequence, FiguresAreThoseOfRunAndCompare) {
  ASSERT_EQ(gloam({"capture", "gallery", "-o", file("shot.####.exr"), "--shot", "walk", "--frames", "1-3", "--size",
                   "64x36", "--planes", "normal"})
                .status,
            0);
  ASSERT_EQ(gloam({"reference", "ao", file("shot.####.exr"), "-o", file("truth.####.exr"), "--samples", "32",
                   "--radius", "0.5"})
                .status,
            0);
  const Json document = measured(file("shot.####.exr"), {"--truth", file("truth.####.exr")});
  const Json& sequence = document["sequence"];
  EXPECT_EQ(sequence["frames"], Json({1, 2, 3}));
  EXPECT_EQ(sequence["radius"], 0.5);
  EXPECT_EQ(sequence["truth_rays"], 32);
  EXPECT_EQ(sequence["motion"], Json({"plane"}));
  ASSERT_EQ(sequence["rows"].size(), 2u);
  for (const bool temporal : {false, true}) {
    const Json& row = row_of(document, temporal);
    const Json compared = by_commands(temporal ? Arguments{"--temporal"} : Arguments{});
    const Json& summary = compared["summary"];
    EXPECT_NEAR(row["rmse"], summary["mean"]["rmse"], 1e-6) << temporal;
    EXPECT_NEAR(row["ssim"], summary["mean"]["ssim"], 1e-6) << temporal;
    EXPECT_NEAR(row["flicker"], summary["flicker"], 1e-6) << temporal;
    EXPECT_EQ(row["worst"]["frame"], summary["worst"]["frame"]) << temporal;
    EXPECT_NEAR(row["worst"]["rmse"], summary["worst"]["rmse"], 1e-6) << temporal;
    EXPECT_NEAR(sequence["truth_change"], summary["truth_change"], 1e-6);
    EXPECT_GT(row["ms"]["median"], 0);
    EXPECT_GT(row["ratio_to_hbao_plus"], 0);
  }
  EXPECT_NE(row_of(document, false)["rmse"], row_of(document, true)["rmse"]);
  // without neighbours
  fs::remove(path("truth.0002.exr"));
  expect_refused(bench_of(file("shot.####.exr"), {"--truth", file("truth.####.exr")}), 1,
                 {"frame 2 is missing", "--missing skip"});
  const Result gap = gloam(bench_of(file("shot.####.exr"), {"--truth", file("truth.####.exr"), "--missing", "skip"}));
  ASSERT_EQ(gap.status, 0) << gap.err;
  EXPECT_NE(gap.out.find("no flicker"), std::string::npos) << gap.out;
  const Json left = Json::parse(slurp(path("out/bench.json")));
  EXPECT_EQ(left["sequence"]["frames"], Json({1, 3}));
  EXPECT_TRUE(row_of(left, true)["flicker"].is_null());
}

TEST_F(BenchSequence, FramesOfABuiltInShotAreThoseOfCaptureAndAreUsedAgain) {
  const Arguments small = {"--size", "48x27", "--rays", "8", "--frames", "2-3"};
  const Json first = measured("clockwork:gears", small), second = measured("gears", small);
  const Json made = {"clockwork_gears_0002.exr", "clockwork_gears_0002_ao_ref.exr", "clockwork_gears_0003.exr",
                     "clockwork_gears_0003_ao_ref.exr"};
  EXPECT_EQ(first["sequence"]["made"], made);
  EXPECT_EQ(second["sequence"]["made"], Json::array());
  EXPECT_EQ(second["sequence"]["reused"], made);
  EXPECT_EQ(second["sequence"]["shot"], "clockwork:gears");
  for (const char* key : {"rmse", "flicker", "ssim"})
    EXPECT_EQ(row_of(first, true)[key], row_of(second, true)[key]) << key;
  ASSERT_EQ(gloam({"capture", "clockwork", "-o", file("shot.####.exr"), "--shot", "gears", "--frames", "3", "--size",
                   "48x27", "--planes", "normal"})
                .status,
            0);
  const auto read = [&](const std::string& name) { return FrameFile(path(name), {}).read({"depth", "motion"}); };
  const Frame captured = read("shot.0003.exr"), kept = read("out/scenes/clockwork_gears_0003.exr");
  for (const char* plane : {"depth", "motion"}) {
    const Plane &a = captured.views[0].planes.at(plane), &b = kept.views[0].planes.at(plane);
    for (size_t c = 0; c < a.channels.size(); ++c)
      for (int y = 0; y < 27; ++y)
        for (int x = 0; x < 48; ++x) {
          const float v = a.channels[c].at(x, y), w = b.channels[c].at(x, y);
          ASSERT_TRUE(v == w || (std::isnan(v) && std::isnan(w))) << plane << " " << x << " " << y;
        }
  }
}

TEST_F(BenchSequence, ReportsShowIt) {
  const Json document = measured("walk", {"--size", "48x27", "--rays", "8", "--frames", "1-2"});
  const Result page = gloam({"report", file("out")});
  ASSERT_EQ(page.status, 0) << page.err;
  const std::string html = slurp(path("out/report.html"));
  const size_t data = html.find("id=\"data\">") + 10;
  const Json shown = Json::parse(html.substr(data, html.find("</script>", data) - data))["sequence"];
  EXPECT_EQ(shown["shot"], "gallery:walk");
  ASSERT_EQ(shown["rows"].size(), 2u);
  EXPECT_EQ(shown["rows"][1]["temporal"], true);
  EXPECT_EQ(shown["rows"][1]["flicker"], row_of(document, true)["flicker"]);
  const Result markdown = gloam({"report", file("out"), "--markdown", file("page.md")});
  ASSERT_EQ(markdown.status, 0) << markdown.err;
  const std::string text = slurp(path("page.md"));
  EXPECT_NE(text.find("gallery:walk, 2 frames of 48x27"), std::string::npos) << text;
  EXPECT_NE(text.find("gtao low, temporal"), std::string::npos) << text;
}

TEST_F(BenchSequence, WhatCannotBeMeasuredIsSaidInALine) {
  expect_refused(bench_of("galery:walk"), 2,
                 {"--sequence galery:walk", "did you mean 'gallery:walk'", "clockwork:gears"});
  expect_refused(bench_of("walk", {"--frames", "3"}), 2, {"--frames 3", "flicker is between two"});
  expect_refused(bench_of("walk", {"--frames", "40-60"}), 2, {"--frames 60", "gallery:walk has frames 1 to 48"});
  expect_refused(bench_of("walk", {"--truth", "t.####.exr"}), 2, {"--truth t.####.exr", "are traced"});
  expect_refused(bench_of("walk", {"--depth", "z"}), 2, {"--depth", "leave it out"});
  expect_refused(bench_of("walk", {"--missing", "skip"}), 2, {"--missing", "leave it out"});
  expect_refused(bench_of("walk", {"--frame", "a.exr"}), 2, {"--frame", "excludes --sequence"});
  expect_refused(bench_of("walk", {"--rounds", "2"}), 2, {"--rounds", "excludes"});
  expect_refused(bench_of(file("no.####.exr")), 1, {"no.####.exr", "no file of this pattern"});
  expect_refused({"bench", "-o", file("out"), "--truth", "t.exr"}, 2, {"--truth t.exr", "--sequence"});
  expect_refused({"bench", "-o", file("out"), "--frames", "1-3"}, 2, {"--frames", "--sequence"});
  make_shot({1, 2});
  expect_refused(bench_of(file("shot.0001.exr")), 2, {"shot.0001.exr", "is one file", "--frame"});
  expect_refused(bench_of(file("shot.####.exr"), {"--truth", file("shot.0001.exr")}), 2, {"--truth", "patterns"});
  expect_refused(bench_of(file("shot.####.exr"), {"--size", "64x36"}), 2, {"--size", "leave it out"});
  const Result without = gloam(bench_of(file("shot.####.exr")));
  EXPECT_EQ(without.status, 1);
  EXPECT_NE(without.err.find("frame 1: shot.0001 has no truth"), std::string::npos) << without.err;
  EXPECT_FALSE(fs::exists(path("out/bench.json")));
}

}  // namespace
}  // namespace gloam::test::bench_sequence_test
