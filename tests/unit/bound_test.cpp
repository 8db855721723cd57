// What limits a pass, from counts and peaks by hand.
#include "results/bound.h"

#include <gtest/gtest.h>

namespace gloam::report::bound_test {
namespace {

/// A million pixels; at the peaks 1 ms for 100 instructions, 32 reads and 8 bytes each.
constexpr double pixels = 1e6;
const Peaks peaks{.copy_gb_per_s = 8, .gather_g_per_s = 32, .fma_gflops = 200};

Pass pass(double ms, PassCount count) { return {.name = "a/pass", .ms = {ms, ms, ms}, .per_pixel = count}; }

TEST(Bound, IsTheLongestOfTheThreeTimes) {
  const PassCount count{
      .loads = 64, .instructions = 150, .float_instructions = 120, .bytes_of_planes = 8, .looks_around = true};
  const std::optional<Bound> reads = bound_of(pass(4, count), peaks, pixels, 1);
  ASSERT_TRUE(reads);
  EXPECT_EQ(reads->by, "reads");
  EXPECT_NEAR(reads->share, 2. / 4, 1e-12);

  PassCount of_rows = count;
  of_rows.looks_around = false;  // a filter reads whole rows at once
  const std::optional<Bound> instructions = bound_of(pass(3, of_rows), peaks, pixels, 1);
  ASSERT_TRUE(instructions);
  EXPECT_EQ(instructions->by, "instructions");
  EXPECT_NEAR(instructions->share, 1.5 / 3, 1e-12);

  const std::optional<Bound> of_lanes = bound_of(pass(3, of_rows), peaks, pixels, 16);
  ASSERT_TRUE(of_lanes);
  EXPECT_EQ(of_lanes->by, "instructions");
  EXPECT_NEAR(of_lanes->share, 1.2 / 3, 1e-12);

  of_rows.instructions = 20;
  const std::optional<Bound> copies = bound_of(pass(2, of_rows), peaks, pixels, 1);
  ASSERT_TRUE(copies);
  EXPECT_EQ(copies->by, "copies");
  EXPECT_NEAR(copies->share, 1. / 2, 1e-12);
}

/// The pass is faster than the peak of reads allows: that peak does not limit it.
TEST(Bound, IsNoneThatThePassExceeds) {
  const PassCount count{
      .loads = 64, .instructions = 90, .float_instructions = 90, .bytes_of_planes = 4, .looks_around = true};
  const std::optional<Bound> bound = bound_of(pass(1, count), peaks, pixels, 1);
  ASSERT_TRUE(bound);
  EXPECT_EQ(bound->by, "instructions");
  EXPECT_NEAR(bound->share, 0.9, 1e-12);
}

TEST(Bound, IsUnknownWithoutCountsOrPeaks) {
  const PassCount count{
      .loads = 64, .instructions = 150, .float_instructions = 120, .bytes_of_planes = 8, .looks_around = true};
  EXPECT_FALSE(bound_of({.name = "a/pass", .ms = {1, 1, 1}}, peaks, pixels, 1));
  EXPECT_FALSE(bound_of(pass(1, {.operations = 150, .loads = 64}), peaks, pixels, 1))
      << "an older file has no instructions";
  EXPECT_FALSE(bound_of(pass(0, count), peaks, pixels, 1));
  EXPECT_FALSE(bound_of(pass(1, count), {.copy_gb_per_s = 8, .fma_gflops = 200}, pixels, 1));
  EXPECT_FALSE(bound_of(pass(1, count), {.gather_g_per_s = 32, .fma_gflops = 200}, pixels, 1));
}

}  // namespace
}  // namespace gloam::report::bound_test
