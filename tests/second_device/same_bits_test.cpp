// Every kernel on a second OpenCL, Rusticl on llvmpipe: with precise mathematics it gives the bits of the usual device, and with fast
// mathematics nearly the same, as hard case 13 has it.
#include <gtest/gtest.h>

#include <algorithm>

#include "stress/case.h"
#include "support/kernel_runs.h"
#include "support/long.h"
#include "support/techniques.h"
#include "support/unoptimised.h"

namespace gloam::test {
namespace {

constexpr const char* second = "llvmpipe";

/// Small, since compiling takes a hundred times as long; not a multiple of any number of lanes.
const Coverage coverage{.width = 65, .height = 9, .every_setting = is_long_run()};

const bool is_unoptimised = leave_unoptimised({""});

void expect_same_bits(const std::vector<KernelRun>& runs) {
  for (const KernelRun& each : runs) {
    const RunOptions options{.math = Math::precise};
    const Frame here = std::move(run(each.plan, each.frame, device(), options).frame);
    const Frame there = std::move(run(each.plan, each.frame, device(second), options).frame);
    const Difference d = difference(here, there);
    EXPECT_TRUE(same_bits(here, there)) << each.what << ": " << d.place.view << " " << d.place.plane << " ("
                                        << d.place.x << ", " << d.place.y << ") " << d.place.holds << " on " << second;
  }
}

/// Whether the technique's page states why a pixel may differ.
bool states_reason(const Technique& technique, const std::string& part) {
  const std::vector<stress::OptOut> all = stress::opt_outs(technique);
  return std::any_of(all.begin(), all.end(),
                     [&](const stress::OptOut& one) { return one.number == 13 && one.part == part; });
}

void expect_near(const Technique& technique, const KernelRun& first) {
  constexpr double most = 1e-5;
  const RunOptions options{.math = Math::fast};
  const Frame here = std::move(run(first.plan, first.frame, device(), options).frame);
  const Frame there = std::move(run(first.plan, first.frame, device(second), options).frame);
  const Difference d = difference(here, there);
  EXPECT_LE(states_reason(technique, "fast") ? d.mean : d.max, most)
      << first.what << ": " << d.place.view << " " << d.place.plane << " (" << d.place.x << ", " << d.place.y << ") "
      << d.place.holds << " on " << second;
}

#define ONLY_WITH_SECOND_DEVICE() \
  if (!has_device(second)) GTEST_SKIP() << "no OpenCL device " << second << "; Debian's mesa-opencl-icd brings one"

class SecondDevice : public testing::TestWithParam<std::string> {};

TEST_P(SecondDevice, GivesTheSameBits) {
  ONLY_WITH_SECOND_DEVICE();
  expect_same_bits(runs_of(find_technique(GetParam()), coverage));
}

TEST_P(SecondDevice, IsNearInFastMathematics) {
  ONLY_WITH_SECOND_DEVICE();
  const Technique& technique = find_technique(GetParam());
  expect_near(technique, runs_of(technique, coverage).front());
}

TEST(Plans, GiveTheSameBits) {
  ONLY_WITH_SECOND_DEVICE();
  expect_same_bits(runs_of_plans(coverage));
}

INSTANTIATE_TEST_SUITE_P(All, SecondDevice, testing::ValuesIn(technique_names()),
                         [](const testing::TestParamInfo<std::string>& info) { return identifier(info.param); });

}  // namespace
}  // namespace gloam::test
