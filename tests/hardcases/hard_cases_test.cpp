// Every hard case on every technique of the registry, as `gloam stress --quick` runs them. A new technique or case adds tests by
// itself.
#include <gtest/gtest.h>

#include "stress/case.h"
#include "support/techniques.h"

namespace gloam::test {
namespace {

class HardCases : public testing::TestWithParam<std::string> {};

void expect_held(const CaseResult& result) {
  for (const Finding& f : result.findings) {
    const std::string line =
        fmt::format("hard case {}  {}  worst {:.3g}  bound {:.3g}  ({}; trial {}: {}; {} {} ({}, {}) {})",
                    result.number, result.technique, f.worst, f.bound, f.what, f.trial, f.conditions, f.place.view,
                    f.place.plane, f.place.x, f.place.y, f.place.holds);
    std::printf("%s\n", line.c_str());
    EXPECT_TRUE(f.held()) << line;
  }
  EXPECT_EQ(result.broken, "") << "hard case " << result.number;
}

TEST_P(HardCases, Hold) {
  const Technique& technique = find_technique(GetParam());
  const Subject subject{.technique = &technique, .device = &device(), .extent = Extent::quick};
  for (const Case& hard_case : cases()) {
    const CaseResult result = examine(hard_case, subject);
    if (!result.opted_out.empty()) {
      std::printf("hard case %d  %s  opted out: %s\n", result.number, result.technique.c_str(),
                  result.opted_out.c_str());
      continue;
    }
    for (const std::string& reason : result.passed_over)
      std::printf("hard case %d  %s  passed over: %s\n", result.number, result.technique.c_str(), reason.c_str());
    std::printf("hard case %d  %s  %d trials, %.1f s\n", result.number, result.technique.c_str(), result.trials,
                result.seconds);
    expect_held(result);
  }
}

/// Case 13 again, with Rusticl besides PoCL: two implementations for CPUs.
TEST_P(HardCases, HoldOnSecondDevice) {
  const char* second = "llvmpipe";
  if (!has_device(second)) GTEST_SKIP() << "no OpenCL device " << second << "; Debian's mesa-opencl-icd brings one";
  const Subject subject{.technique = &find_technique(GetParam()),
                        .device = &device(),
                        .others = {&device(second)},
                        .extent = Extent::quick};
  expect_held(examine(find_case(13), subject));
}

INSTANTIATE_TEST_SUITE_P(All, HardCases, testing::ValuesIn(technique_names()),
                         [](const testing::TestParamInfo<std::string>& info) { return identifier(info.param); });

}  // namespace
}  // namespace gloam::test
