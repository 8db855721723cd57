// Hard cases 13 and 14: the same image from every lane width and every device; what float and fast mathematics cost.
#include <cmath>

#include "hard_case.h"
#include "kernel_sources.h"

namespace gloam::test {
namespace {

/// Whether the result of a plan has any reason to change with the seed.
bool uses_seed(const Plan& plan) {
  for (const PlannedPass& planned : plan.passes) {
    const auto& defines = planned.pass.defines;
    const bool is_still =
        std::find(defines.begin(), defines.end(), std::pair<std::string, int>("JITTER", 0)) != defines.end();
    if (!is_still && flatten(planned.technique->source).find("frame.seed") != std::string::npos) return true;
  }
  return false;
}

/// What has to agree between lane widths and devices in fast mathematics: every pixel, or the mean over pixels where the
/// technique says why a single pixel may differ ("hard case 13, fast: reason").
bool agrees_by_mean(const Technique& technique) { return !opt_out(technique, 13, "fast").empty(); }

double distance(const Technique& technique, const Frame& a, const Frame& b) {
  const Difference d = difference(a, b);
  return agrees_by_mean(technique) ? d.mean : d.max;
}

std::string distance_name(const Technique& technique) {
  return agrees_by_mean(technique) ? "mean difference" : "difference";
}

TEST_P(HardCase, Row13Seed) {
  SKIP_WHERE_OPTED_OUT(13);
  const Settings few = few_samples(technique());
  int changed = 0;
  for (const Shot& shot : odd_shots()) {
    for (const Math math : {Math::precise, Math::fast}) {
      Frame frame = shoot(shot, room(), false);
      const Frame first = outputs_of(technique(), frame, few, {.math = math, .seed = 5});
      const Frame again = outputs_of(technique(), frame, few, {.math = math, .seed = 5});
      const Frame other = outputs_of(technique(), frame, few, {.math = math, .seed = 6});
      changed += !same_bits(first, again);
      EXPECT_EQ(!same_bits(first, other), uses_seed(plan_for(technique(), frame)));
    }
  }
  report(13, "images of 4 that change from run to run with one seed", changed, 0);
}

TEST_P(HardCase, Row13LaneWidths) {
  SKIP_WHERE_OPTED_OUT(13);
  const Settings few = few_samples(technique());
  int changed = 0;
  double worst = 0;
  for (const Shot& shot : odd_shots()) {
    for (const bool with_normals : {true, false}) {
      Frame frame = shoot(shot, room(), with_normals);
      const Frame precise = outputs_of(technique(), frame, few, {.math = Math::precise, .lanes = 1});
      const Frame fast = outputs_of(technique(), frame, few, {.math = Math::fast, .lanes = 1});
      for (const int lanes : {4, 8, 16}) {
        const bool same =
            same_bits(outputs_of(technique(), frame, few, {.math = Math::precise, .lanes = lanes}), precise);
        EXPECT_TRUE(same) << "lanes " << lanes;
        changed += !same;
        if (!with_normals && !opt_out(technique(), 13, "fast normals from depth").empty()) continue;
        worst = std::max(
            worst,
            distance(technique(), outputs_of(technique(), frame, few, {.math = Math::fast, .lanes = lanes}), fast));
      }
    }
  }
  report(13, "precise: images of 12 with other bits than with one lane", changed, 0);
  report(13, "fast: " + distance_name(technique()) + " to one lane", worst, 1e-5);
}

TEST_P(HardCase, Row13SecondDevice) {
  SKIP_WHERE_OPTED_OUT(13);
  const Settings few = few_samples(technique());
  const char* second = "llvmpipe";
  if (!has_device(second)) {
    std::printf("hard case 13  %s  not run: no %s (Debian: mesa-opencl-icd)\n", technique().name.c_str(), second);
    GTEST_SKIP() << "no OpenCL device " << second << "; Debian's mesa-opencl-icd brings one";
  }
  int changed = 0;
  double worst = 0;
  for (const Shot& shot : odd_shots()) {
    for (const bool with_normals : {true, false}) {
      Frame frame = shoot(shot, room(), with_normals);
      const RunOptions precise{.math = Math::precise}, fast{.math = Math::fast};
      const bool same =
          same_bits(outputs_of(technique(), frame, few, precise), outputs_of(technique(), frame, few, precise, second));
      EXPECT_TRUE(same) << difference(outputs_of(technique(), frame, few, precise),
                                      outputs_of(technique(), frame, few, precise, second))
                               .max;
      changed += !same;
      worst = std::max(worst, distance(technique(), outputs_of(technique(), frame, few, fast),
                                       outputs_of(technique(), frame, few, fast, second)));
    }
  }
  report(13, "precise: images of 4 with other bits on Rusticl", changed, 0);
  report(13, "fast: " + distance_name(technique()) + " between PoCL and Rusticl", worst, 1e-5);
}

/// Stated rather than bounded by an argument: a sample that falls on the border of a pixel may be another pixel's in
/// double, and one sample of many is then another one; two pixels of 19200 by one of 31 sectors are 3.4e-6.
TEST_P(HardCase, Row14FloatAgainstDouble) {
  SKIP_WHERE_OPTED_OUT(14);
  if (!device().info().has_double) GTEST_SKIP() << device().info().name << " has no double";
  for (const bool with_normals : {true, false}) {
    if (!with_normals && !opt_out(technique(), 14, "normals from depth").empty()) continue;
    Frame frame = shoot(perspective(160, 120), room(), with_normals);
    const Frame exact = outputs_of(technique(), frame, {}, {.math = Math::precise, .real = Real::float64});
    for (const Math math : {Math::precise, Math::fast}) {
      const Difference d = difference(outputs_of(technique(), frame, {}, {.math = math}), exact);
      report(14,
             fmt::format("{}, {}: mean difference to double, largest {:.2g}", math == Math::fast ? "fast" : "precise",
                         with_normals ? "exact normals" : "normals from depth", d.max),
             d.mean, 4e-6);
    }
  }
}

}  // namespace
}  // namespace gloam::test
