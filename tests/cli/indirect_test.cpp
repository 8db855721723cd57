// Indirect light for two eyes and over time, at the command line.
#include <algorithm>
#include <cmath>

#include "cli/shot_fixture.h"

namespace gloam::test::indirect_test {
namespace {

using Settings = std::vector<std::string>;

double mean_of(const Plane& plane) {
  double sum = 0, count = 0;
  for (const Channel& channel : plane.channels) {
    for (int y = 0; y < channel.layout().height; ++y) {
      for (int x = 0; x < channel.layout().width; ++x, ++count) sum += double(channel.at(x, y));
    }
  }
  return sum / count;
}

double rms_of_difference(const Plane& a, const Plane& b) {
  double sum = 0, count = 0;
  for (size_t c = 0; c < a.channels.size(); ++c) {
    const Channel &one = a.channels[c], &other = b.channels[c];
    for (int y = 0; y < one.layout().height; ++y) {
      for (int x = 0; x < one.layout().width; ++x, ++count)
        sum += std::pow(double(one.at(x, y)) - double(other.at(x, y)), 2);
    }
  }
  return std::sqrt(sum / count);
}

void scale(Plane& plane, float factor) {
  for (Channel& channel : plane.channels) {
    for (int y = 0; y < channel.layout().height; ++y)
      for (int x = 0; x < channel.layout().width; ++x) channel.at(x, y) *= factor;
  }
}

class CliIndirect : public ShotTest {
 protected:
  void SetUp() override {
    ShotTest::SetUp();
    ASSERT_EQ(gloam({"capture", "gallery", "-o", path("pair.exr"), "--size", "128x72", "--stereo", "0.1", "--planes",
                     "normal,color"})
                  .status,
              0);
  }

  /// What a technique makes of the pair, or of another frame.
  Frame made(const std::string& technique, const Settings& settings = {}, const std::string& frame = "pair.exr") const {
    Arguments all = {"run", technique, path(frame), "-o",        path("light.exr"),       "--radius",
                     "0.5", "--math",  "precise",   "--outputs", "indirect,indirect_raw", "--keep-depth"};
    for (const std::string& setting : settings) all.insert(all.end(), {"--set", setting});
    const Result result = gloam(all);
    EXPECT_EQ(result.status, 0) << result.err;
    return FrameFile(path("light.exr"), {}).read({"indirect", "indirect_raw"});
  }
  double inconsistency() const {
    return gloam({"compare", "--stereo", path("light.exr"), "--frame", path("pair.exr"), "--json", "-"})
        .json()["inconsistency"]["mean"];
  }
};

TEST_F(CliIndirect, WithoutAnythingStereoItIsTheTechniqueForOneEye) {
  const Frame one = made("indirect"), two = made("stereo-indirect", {"estimate=mono", "reproject=off", "filter=mono"});
  for (const size_t view : {0, 1}) {
    for (const char* plane : {"indirect", "indirect_raw"})
      EXPECT_EQ(rms_of_difference(*one.views[view].find(plane), *two.views[view].find(plane)), 0) << view << plane;
  }
}

TEST_F(CliIndirect, BothEyesAgree) {
  made("indirect");
  const double alone = inconsistency();
  made("stereo-indirect");
  const double together = inconsistency();
  std::printf("inconsistency: each eye by itself %.5f, both together %.5f\n", alone, together);
  EXPECT_LT(together, 0.2 * alone);
  EXPECT_GT(alone, 0.001) << "there is something to agree on";
}

/// With the colour of the left eye black, what lights the left eye is what the right eye sees.
TEST_F(CliIndirect, EachEyesPixelsSendTheirOwnLight) {
  const Settings settings = {"reproject=off", "filter=mono", "other_eye=everywhere"};
  const double both = mean_of(*made("stereo-indirect", settings).views[0].find("indirect_raw"));
  Frame frame = FrameFile(path("pair.exr"), {}).read({"depth", "normal", "color"});
  scale(frame.views[0].planes.at("color"), 0);
  write_frame(path("dark.exr"), frame);
  const double by_other = mean_of(*made("stereo-indirect", settings, "dark.exr").views[0].find("indirect_raw"));
  std::printf("light from both eyes' pixels %.5f, from the other's alone %.5f\n", both, by_other);
  EXPECT_NEAR(by_other / both, 0.5, 0.1) << "nearly all surfaces are seen by both";
  EXPECT_EQ(mean_of(*made("indirect", {}, "dark.exr").views[0].find("indirect_raw")), 0);
}

TEST_F(CliIndirect, BrightSourcesAreBoundedInTheirColour) {
  Frame frame = FrameFile(path("pair.exr"), {}).read({"depth", "normal", "color"});
  const Frame plain = made("indirect");
  scale(frame.views[0].planes.at("color"), 64);
  scale(frame.views[1].planes.at("color"), 64);
  write_frame(path("bright.exr"), frame);
  // A bound that nothing reaches changes nothing; what is left is the camera, whose floats a header holds.
  Frame bright = made("indirect", {"brightest=1000000"}, "bright.exr");
  scale(bright.views[0].planes.at("indirect_raw"), 1.0f / 64);
  EXPECT_LT(rms_of_difference(*plain.views[0].find("indirect_raw"), *bright.views[0].find("indirect_raw")), 1e-6);
  const Frame bounded = made("indirect", {"brightest=0.01"}, "bright.exr");
  // All that a pixel sees is as bright as the bound at most; a slice's directions may stand for a little more than a hemisphere.
  double largest = 0;
  for (const Channel& channel : bounded.views[0].find("indirect_raw")->channels) {
    for (int y = 0; y < bounded.height(); ++y)
      for (int x = 0; x < bounded.width(); ++x) largest = std::max(largest, double(channel.at(x, y)));
  }
  std::printf("sources of at most .01: light of at most %.5f\n", largest);
  EXPECT_GT(largest, 0.005);
  EXPECT_LT(largest, 0.02);
}

class CliIndirectOverTime : public ShotTest {
 protected:
  Plane last(const std::string& technique, const Arguments& more, int frame) const {
    Arguments all = run_of({"--float", "--outputs", "indirect_raw"}, technique);
    all.insert(all.end(), more.begin(), more.end());
    const Result result = gloam(all);
    EXPECT_EQ(result.status, 0) << result.err;
    return FrameFile(path(numbered("ao", frame)), {}).read({"indirect_raw"}).views[0].planes.at("indirect_raw").clone();
  }
};

TEST_F(CliIndirectOverTime, AStandingEyeConvergesAndForgetsALampThatGoesOut) {
  walk(2, 0, 96, 54);
  for (int i = 2; i <= 12; ++i) {
    Frame frame = FrameFile(path("shot.0001.exr"), {}).read({"depth", "normal", "color"});
    if (i > 9) scale(frame.views[0].planes.at("color"), 0.2f);
    write_frame(path(numbered("shot", i)), frame);
  }
  Plane truth = last("indirect", {"--set", "directions=32"}, 9).clone();
  const double alone = rms_of_difference(last("indirect", {}, 9), truth);
  const double mean = rms_of_difference(last("indirect", {"--temporal"}, 9), truth);
  std::printf("RMSE to 32 slices: one frame %.5f, nine frames %.5f\n", alone, mean);
  EXPECT_LT(mean, 0.5 * alone);
  // Three frames after the lamp: as much light as there is now, but for noise.
  const double now = 0.2 * mean_of(truth),
               kept = mean_of(last("indirect", {"--temporal", "--set", "temporal.light_tolerance=inf"}, 12)),
               forgotten = mean_of(last("indirect", {"--temporal"}, 12));
  std::printf("light before %.5f, now %.5f; untested %.5f, tested %.5f\n", mean_of(truth), now, kept, forgotten);
  EXPECT_GT(kept, 2 * now);
  EXPECT_LT(forgotten, 0.5 * (now + kept));
}

TEST_F(CliIndirectOverTime, AShotIsWhatFrameAfterFrameIsAndWhatChunksAre) {
  walk(3, 0.02, 64, 36);
  const Arguments all =
      run_of({"--temporal", "--float", "--outputs", "indirect,indirect_raw,frames", "--keep-depth", "-q"}, "indirect");
  ASSERT_EQ(gloam(all).status, 0);
  ASSERT_EQ(gloam({"run", "indirect", path("shot.0001.exr"), "-o", path("r.0001.exr"), "--radius", "0.5", "--temporal",
                   "--seed", "1"})
                .status,
            0);
  for (const int i : {2, 3}) {
    const Result next = gloam({"run", "indirect", path(numbered("shot", i)), "-o", path(numbered("r", i)), "--radius",
                               "0.5", "--history", path(numbered("r", i - 1))});
    ASSERT_EQ(next.status, 0) << next.err;
  }
  const auto compared =
      gloam({"compare", path("ao.0003.exr"), path("r.0003.exr"), "--what", "indirect", "--json", "-"}).json();
  EXPECT_LT(double(compared["max"]), 1e-4) << compared;  // cameras in headers are floats
  // A file of the shot is a history too, and files lost come back with the same bytes.
  const auto whole = contents();
  fs::remove(path("ao.0002.exr"));
  Arguments resumed = all;
  resumed.emplace_back("--resume");
  EXPECT_EQ(gloam(resumed).status, 0);
  EXPECT_EQ(contents(), whole);
  EXPECT_EQ(gloam({"run", "indirect", path("shot.0003.exr"), "-o", path("next.exr"), "--radius", "0.5", "--history",
                   path("ao.0002.exr")})
                .status,
            0);
}

TEST_F(CliIndirectOverTime, WhatIsNotAccumulatedIsRefused) {
  walk(2, 0, 64, 36);
  expect_refused({"run", "indirect", file("shot.0001.exr"), "-o", file("o.exr"), "--temporal", "--with", "ao"}, 2,
                 {"--with ao: indirect does not accumulate it over time; leave it out, and run bitmask --temporal"});
  expect_refused({"run", "indirect", file("shot.0001.exr"), "-o", file("o.exr"), "--temporal", "--resolution", "half"},
                 2, {"works at full resolution"});
  ASSERT_EQ(gloam({"run", "gtao", path("shot.0001.exr"), "-o", path("ao.exr"), "--radius", "0.5", "--temporal"}).status,
            0);
  expect_refused({"run", "indirect", file("shot.0001.exr"), "-o", file("o.exr"), "--history", file("ao.exr")}, 1,
                 {"history_indirect"});
}

}  // namespace
}  // namespace gloam::test::indirect_test
