// Devices whose division is not correctly rounded, as GPUs are: no plane leaves its range, and what is open stays exactly open.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/run.h"
#include "stress/case.h"
#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::test::quotient_test {
namespace {

/// While it lives, every quotient in kernels is so many units in the last place too large.
class QuotientError {
 public:
  explicit QuotientError(int units) { setenv(variable, std::to_string(units).c_str(), 1); }
  ~QuotientError() { unsetenv(variable); }

 private:
  static constexpr const char* variable = "GLOAM_QUOTIENT_ERROR";
};

/// The results of a technique, or of the technique at half resolution.
Frame results_of(const Technique& technique, Frame& frame, const Settings& settings, int resolution) {
  const Plan plan = plan_for(
      PlanRequest{.outputs = {technique.name}, .settings = few_samples(technique) + settings, .resolution = resolution},
      frame);
  return run(plan, frame, device()).frame;
}

/// Whether a technique states why it is not exactly open at length 0.
bool may_be_closed(const Technique& technique) {
  const std::vector<OptOut> outs = opt_outs(technique);
  return std::any_of(outs.begin(), outs.end(), [](const OptOut& out) { return out.number == 8 && out.part == "open"; });
}

class Quotients : public testing::TestWithParam<std::string> {};

TEST_P(Quotients, LeadNoPlaneOutOfItsRange) {
  const Technique& technique = find_technique(GetParam());
  const bool is_brief = is_only_variant(technique);
  for (const int error : {2, -2}) {
    if (error < 0 && is_brief) continue;
    const QuotientError device_error(error);
    for (int resolution = 1; resolution <= (error > 0 && !is_brief ? 2 : 1); ++resolution) {
      Frame frame = shoot(perspective(24, 16), room());
      try {
        EXPECT_EQ(violation(results_of(technique, frame, {}, resolution)), "") << error << " at 1/" << resolution;
      } catch (const UsageError&) {
        EXPECT_GT(resolution, 1);  // it states why it works only at full resolution
      }
    }
  }
}

TEST_P(Quotients, LeaveOpenWhatIsOpen) {
  const Technique& technique = find_technique(GetParam());
  for (const int error : {2, -2}) {
    if (error < 0 && is_only_variant(technique)) continue;
    const QuotientError device_error(error);
    Frame frame = shoot(perspective(24, 16), room());
    const Settings zero = set_lengths(technique, frame, [](double) { return 0.0; });
    const Plan plan = plan_for(technique, frame, few_samples(technique) + zero);
    if (zero.empty() || unit_interval_outputs(plan).empty() || may_be_closed(technique)) continue;
    const Difference off = distance_from_open(plan, run(plan, frame, device()).frame);
    EXPECT_EQ(off.max, 0) << error << ": " << off.place.plane << " is " << off.place.holds;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Quotients, testing::ValuesIn(technique_names()),
                         [](const testing::TestParamInfo<std::string>& info) { return identifier(info.param); });

}  // namespace
}  // namespace gloam::test::quotient_test
