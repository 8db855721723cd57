// The device's table of speeds: times as a fixed part and a part per pixel (host/planner/speeds.h).
#include "planner/speeds.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "run/device_record.h"
#include "run/kept_folders.h"

namespace gloam::test::speeds_test {
namespace {

TEST(SpeedsParts, AreThoseOfTwoSizes) {
  const TimeParts parts = parts_of({{2000, 0.5 + 0.2}, {32000, 0.5 + 3.2}});
  EXPECT_NEAR(parts.fixed_ms, 0.5, 1e-9);
  EXPECT_NEAR(parts.ns_per_pixel, 100, 1e-6);
  EXPECT_NEAR(parts.ms({.pixels = 128'000}), 13.3, 1e-6);
  EXPECT_NEAR(parts.ms({.pixels = 128'000, .views = 2}), 26.6, 1e-6);
}

TEST(SpeedsParts, AreNeverNegativeHoweverNoisyTheTimes) {
  // More than four times as long for four times the pixels, as where a cache is full.
  const TimeParts steep = parts_of({{8000, 1}, {32000, 5}});
  EXPECT_EQ(steep.fixed_ms, 0);
  EXPECT_GT(steep.ns_per_pixel, 125);
  EXPECT_LT(steep.ns_per_pixel, 5e6 / 32000);
  // The larger one took less time.
  const TimeParts flat = parts_of({{8000, 1.1}, {32000, 1}});
  EXPECT_GT(flat.fixed_ms, 0.8);
  EXPECT_NEAR(flat.ns_per_pixel, 0.1 * 1e6 / 32000, 1e-9);
  EXPECT_GT(flat.ms({.pixels = 512'000}), 2);
}

TEST(SpeedsParts, FitManySizesInSharesOfEach) {
  std::vector<MeasuredTime> times;
  for (const double pixels : {2e3, 8e3, 3.2e4, 1.3e5, 2e6})
    times.push_back({pixels, (0.3 + 5e-5 * pixels) * (times.size() % 2 ? 1.05 : 0.95)});
  const TimeParts parts = parts_of(times);
  EXPECT_NEAR(parts.fixed_ms, 0.3, 0.05);
  EXPECT_NEAR(parts.ns_per_pixel, 50, 5);
  for (const MeasuredTime& time : times)
    EXPECT_NEAR(parts.ms({.pixels = time.pixels}) / time.ms, 1, 0.1) << time.pixels;
}

TEST(SpeedsParts, OfOneSizeAreItsPixels) {
  EXPECT_EQ(parts_of({{8000, 2}}).fixed_ms, 0);
  EXPECT_DOUBLE_EQ(parts_of({{8000, 2}}).ns_per_pixel, 250);
  EXPECT_EQ(parts_of({}).ms({.pixels = 1000}), 0);
}

class SpeedsTable : public testing::Test {
 protected:
  void SetUp() override {
    if (path().empty()) GTEST_SKIP() << "nothing can be kept here";
    std::filesystem::remove(path());
  }
  void TearDown() override { std::filesystem::remove(path()); }
  std::filesystem::path path() const { return path_in_cache("speeds", info_); }
  void write(const std::string& text) const {
    std::filesystem::create_directories(path().parent_path());
    std::ofstream(path()) << text;
  }
  bool knows_any() const { return OptionSpeeds(info_).knows("gtao, low, full", {.pixels = 1}); }

  const DeviceInfo info_{.platform = "made up", .name = "of speeds_test"};
  const std::string head_ = "{\"device\": \"" + key_of(info_) + "\", \"kernels\": \"" + hash_of_kernels() + "\", ";
};

TEST_F(SpeedsTable, KeepsTheNewestOfEachSize) {
  OptionSpeeds speeds(info_);
  speeds.add("gtao, low, full", {.pixels = 2000}, 9);
  speeds.add("gtao, low, full", {.pixels = 2010}, 0.7);
  speeds.add("gtao, low, full", {.pixels = 32000, .views = 2}, 7.4);
  speeds.add("hbao, low, full", {.pixels = 2000}, 1);
  speeds.add("hbao, low, full", {.pixels = 8000}, 0);
  speeds.keep();
  const OptionSpeeds kept(info_);
  EXPECT_TRUE(kept.knows("gtao, low, full", {.pixels = 512'000}));
  EXPECT_FALSE(kept.knows("gtao, low, full", {.pixels = 513'000})) << "sixteen times the pixels, at most";
  EXPECT_FALSE(kept.knows("hbao, low, full", {.pixels = 2000})) << "one size does not tell the parts";
  EXPECT_NEAR(kept.expected_ms("gtao, low, full", {.pixels = 128'000}), 13.3, 0.1);
  EXPECT_EQ(kept.expected_ms("ssao, low, full", {.pixels = 1000}), 0);
}

TEST_F(SpeedsTable, IsMadeAnewWhereItIsOldOrDamaged) {
  write(head_ + "\"times\": {\"gtao, low, full\": [[100, 1], [1000, 2]]}}");
  EXPECT_TRUE(knows_any());
  for (const std::string rest : {"\"ns_per_pixel\": {\"gtao, low, full\": 250}}", "\"times\": 1}", "\"times\": {",
                                 "\"times\": {\"gtao, low, full\": [[100, 1], [1000]]}}",
                                 "\"times\": {\"gtao, low, full\": [[100, 1], [1000, \"2\"]]}}",
                                 "\"times\": {\"gtao, low, full\": [[100, 1], [-5, 2], [1000, 0], [1e99, null]]}}"}) {
    write(head_ + rest);
    EXPECT_FALSE(knows_any()) << rest;
  }
  write("{\"device\": \"another\", \"kernels\": \"" + hash_of_kernels() +
        "\", \"times\": {\"gtao, low, full\": [[100, 1], [1000, 2]]}}");
  EXPECT_FALSE(knows_any());
}

}  // namespace
}  // namespace gloam::test::speeds_test
