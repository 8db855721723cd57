// --only at the command line: plans, messages, files and refusals.
#include "cli/gloam_process.h"
#include "support/stress.h"

namespace gloam::test::only_test {
namespace {

class CliOnly : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    Frame frame = shoot(perspective(97, 65), room());
    Channel& count = plane_of(frame, "outline_count").channels[0];
    for (int y = 20; y < 40; ++y) std::fill_n(count.row(y) + 30, 20, 2.0f);
    Channel& own = plane_of(frame, "important").channels[0];
    for (int y = 0; y < 10; ++y) std::fill_n(own.row(y), 97, 1.0f);
    write_frame(path("frame.exr"), frame);
  }
  Result run(const Arguments& more, const std::string& technique = "gtao") const {
    Arguments arguments = {"run", technique, path("frame.exr"), "-o", path("ao.exr")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  }
  /// Pixels of the filtered AO that are not open.
  int occluded(int x0, int y0, int x1, int y1) const {
    FrameFile file(path("ao.exr"), {});
    const Frame out = file.read({"ao"});
    int count = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) count += out.views[0].planes.at("ao").channels[0].at(x, y) < 1;
    }
    return count;
  }
};

TEST_F(CliOnly, AMaskTechniqueIsRunFirstAndTheShareLeftOutIsTold) {
  const Result result = run({"--only", "corner-mask", "--radius", "0.3", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["passes"][0]["name"], "corner-mask/subsample");
  EXPECT_GT(result.json()["skipped_share"], 0.02);
  EXPECT_LT(result.json()["skipped_share"], 0.9);
  const Result told = run({"--only", "corner-mask", "--radius", "0.3"});
  EXPECT_NE(told.out.find("'mask' left out "), std::string::npos) << told.out;
  EXPECT_EQ(run({}).out.find("left out"), std::string::npos);
}

TEST_F(CliOnly, WhatAnOutlineMaskDoesNotWantIsOpen) {
  ASSERT_EQ(run({"--only", "outline-mask", "--radius", "0.5"}).status, 0);
  EXPECT_GT(occluded(30, 20, 50, 40), 200);
  EXPECT_EQ(occluded(0, 0, 97, 65), occluded(30, 20, 50, 40));
}

/// Where an outline crosses itself.
TEST_F(CliOnly, CountsBelow0AreWanted) {
  Frame frame = shoot(perspective(97, 65), room());
  Channel& count = plane_of(frame, "outline_count").channels[0];
  for (int y = 0; y < 65; ++y) std::fill_n(count.row(y), 97, 1.0f);
  for (int y = 20; y < 40; ++y) std::fill_n(count.row(y) + 30, 20, -1.0f);
  write_frame(path("frame.exr"), frame);
  ASSERT_EQ(run({"--only", "outline-mask", "--radius", "0.5"}).status, 0);
  EXPECT_GT(occluded(30, 20, 50, 40), 200);
  EXPECT_EQ(occluded(0, 0, 97, 65), occluded(30, 20, 50, 40));
}

/// An image this small is measured everywhere: the share is that of all pixels whose AO changes.
TEST_F(CliOnly, WhatAnOutlineMaskMissesIsTold) {
  ASSERT_EQ(run({"--radius", "0.5", "--float"}).status, 0);
  const Frame whole = FrameFile(path("ao.exr"), {}).read({"ao"});
  const Result result =
      run({"--only", "outline-mask", "--radius", "0.5", "--set", "least_count=1.5", "--float", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Frame masked = FrameFile(path("ao.exr"), {}).read({"ao"});
  int missed = 0;
  for (int y = 0; y < 65; ++y) {
    for (int x = 0; x < 97; ++x) {
      const auto at = [&](const Frame& frame) { return frame.views[0].planes.at("ao").channels[0].at(x, y); };
      missed += std::abs(at(whole) - at(masked)) > 1.0f / 255;
    }
  }
  EXPECT_GT(missed, 97 * 65 / 20);
  EXPECT_DOUBLE_EQ(result.json()["missed_share"].get<double>(), missed / (97.0 * 65));
  const std::string told = run({"--only", "outline-mask", "--radius", "0.5"}).out;
  EXPECT_NE(told.find(fmt::format("'mask' misses {:.1f} % of the pixels: left out, although 'ao' changes there by more "
                                  "than 1/255\n",
                                  100 * missed / (97.0 * 65))),
            std::string::npos)
      << told;
}

/// What the frame itself shows, or the user draws, is no mistake.
TEST_F(CliOnly, OtherMasksMissNothingThatIsTold) {
  for (const Arguments& mask : {Arguments{"corner-mask"}, Arguments{"mask", "--plane", "mask=important"}}) {
    Arguments flags = {"--radius", "0.5", "--json", "-", "--only"};
    flags.insert(flags.end(), mask.begin(), mask.end());
    const Result result = run(flags);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(result.json()["missed_share"].is_null()) << mask[0];
  }
  EXPECT_EQ(run({"--only", "corner-mask", "--radius", "0.5"}).out.find("misses"), std::string::npos);
}

TEST_F(CliOnly, APlaneOfTheFileIsAMask) {
  ASSERT_EQ(run({"--only", "mask", "--plane", "mask=important", "--radius", "0.5"}).status, 0);
  EXPECT_GT(occluded(0, 0, 97, 10), 100);
  EXPECT_EQ(occluded(0, 10, 97, 65), 0);
}

TEST_F(CliOnly, TheMaskItselfIsAnEstimateThatTheFilterSmooths) {
  ASSERT_EQ(run({"--occlusion", "0.25", "--outputs", "ao,ao_raw"}, "outline-ao").status, 0);
  FrameFile file(path("ao.exr"), {});
  const Frame out = file.read({"ao", "ao_raw"});
  const Channel& raw = out.views[0].planes.at("ao_raw").channels[0];
  const Channel& ao = out.views[0].planes.at("ao").channels[0];
  EXPECT_EQ(raw.at(40, 30), 0.75f);
  EXPECT_EQ(raw.at(29, 30), 1.0f);
  float least = 1;
  for (int x = 20; x < 40; ++x) least = std::min(least, ao.at(x, 30));
  EXPECT_GE(least, 0.75f);
  EXPECT_LT(least, 0.8f);
  // Somewhere around the border there are intermediate values.
  int between = 0;
  for (int y = 15; y < 45; ++y) {
    for (int x = 25; x < 55; ++x) between += ao.at(x, y) > 0.76f && ao.at(x, y) < 0.99f;
  }
  EXPECT_GT(between, 50);
}

TEST_F(CliOnly, ASecondEstimateIsToldOf) {
  const Result adaptive = run({"--preset", "ultra", "--adaptive", "low", "--json", "-"});
  ASSERT_EQ(adaptive.status, 0) << adaptive.err;
  EXPECT_GT(adaptive.json()["rest_share"], 0.02);
  EXPECT_EQ(adaptive.json()["skipped_share"], 0);
  EXPECT_NE(run({"--preset", "ultra", "--adaptive", "low"}).out.find("gtao/estimate of the rest computed "),
            std::string::npos);
  const Result elsewhere = run({"--only", "outline-mask", "--elsewhere", "ssao"});
  ASSERT_EQ(elsewhere.status, 0) << elsewhere.err;
  EXPECT_NE(elsewhere.out.find("ssao/estimate computed "), std::string::npos) << elsewhere.out;
  EXPECT_EQ(elsewhere.out.find("left out"), std::string::npos) << elsewhere.out;
}

TEST_F(CliOnly, WhatTheFrameLacksIsSaidInOneLine) {
  const Result misspelt = run({"--only", "outline-mast"});
  EXPECT_EQ(misspelt.status, 2);
  EXPECT_EQ(misspelt.lines_of_error(), 1);
  EXPECT_NE(misspelt.err.find("did you mean 'outline-mask'?"), std::string::npos) << misspelt.err;
  write_frame(path("frame.exr"), shoot(perspective(97, 65), room()));
  const Result without = run({"--only", "outline-mask", "--radius", "0.5"});
  EXPECT_EQ(without.lines_of_error(), 1);
  EXPECT_NE(without.err.find("'outline_count'"), std::string::npos) << without.err;
  EXPECT_NE(without.err.find("--outlines"), std::string::npos) << without.err;
}

}  // namespace
}  // namespace gloam::test::only_test
