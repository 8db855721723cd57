// The results of a run, view by view.
#include "gloam/run.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "run/device_impl.h"
#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::test::run_test {
namespace {

Plane level(const std::string& name, const Layout& layout, float value) {
  Plane plane{name, {}};
  plane.channels.emplace_back(layout, value);
  return plane;
}

TEST(Run, APlaneThatAViewCameWithIsNoResultOfIt) {
  Frame frame = shoot(perspective(48, 32), room());
  const Plan plan = plan_for(find_technique("multiview"), frame);
  const Frame bare = run(plan, frame, device()).frame;
  for (View& view : frame.views) {
    for (const char* ao : {"ao", "ao_raw"}) view.planes[ao] = level(ao, Layout(48, 32), 0.5f);
  }
  const Frame with_ao = run(plan, frame, device()).frame;
  ASSERT_EQ(with_ao.views.size(), 1u) << "the second view is only looked into";
  EXPECT_TRUE(same_bits(bare, with_ao));
}

/// While it lives, launches are waited for together, as on GPUs.
class LaunchesAhead {
 public:
  LaunchesAhead() { setenv(variable, "ahead", 1); }
  ~LaunchesAhead() { unsetenv(variable); }

 private:
  static constexpr const char* variable = "GLOAM_LAUNCHES";
};

/// evidence empties a list between its launches, the others read what earlier launches of their own and of the other view made.
TEST(Run, LaunchesThatAreWaitedForTogetherComputeTheSame) {
  for (const char* name : {"evidence", "stereo-gtao", "temporal-sssr", "lightfield-hbao+"}) {
    const Technique& technique = find_technique(name);
    Frame frame = shoot(perspective(48, 32), room());
    const Plan plan = plan_for(technique, frame, few_samples(technique));
    const RunResult one_by_one = run(plan, frame, device(), {.repeat = 2});
    const LaunchesAhead ahead;
    int told = 0, of = 0;
    const RunResult together = run(plan, frame, device(), {.repeat = 2, .progress = [&](int done, int all) {
                                                             EXPECT_EQ(done, ++told);
                                                             of = all;
                                                           }});
    EXPECT_TRUE(same_bits(one_by_one.frame, together.frame)) << name;
    EXPECT_EQ(told, of) << name;
    EXPECT_EQ(one_by_one.listed, together.listed) << name;
    ASSERT_EQ(one_by_one.passes.size(), together.passes.size()) << name;
    for (const PassTime& pass : together.passes) EXPECT_EQ(pass.ms.size(), 2u) << pass.name;
  }
}

/// Planes go to and from the device's own memory, as on GPUs, which is kept from run to run.
TEST(Run, OnADeviceWithMemoryOfItsOwnComputesTheSame) {
  Device own;
  own.impl().info.shares_memory = false;
  for (const char* name : {"evidence", "dp-gtao", "stereo-gtao", "sssr", "lightfield-hbao+", "evidence"}) {
    const Technique& technique = find_technique(name);
    Frame frame = shoot(perspective(50, 33), room());
    const Plan plan = plan_for(technique, frame, few_samples(technique));
    const Frame expected = run(plan, frame, device()).frame;
    for (int time = 0; time < 2; ++time) EXPECT_TRUE(same_bits(expected, run(plan, frame, own).frame)) << name;
  }
}

/// Planes that were sent ahead, some of them or of two frames at a time.
TEST(Run, OnPlanesThatWereSentAheadComputesTheSame) {
  Device own;
  own.impl().info.shares_memory = false;
  for (const char* name : {"evidence", "dp-gtao", "stereo-gtao", "sssr", "lightfield-hbao+"}) {
    const Technique& technique = find_technique(name);
    Frame frame = shoot(perspective(50, 33), room()), next = shoot(perspective(50, 33), room());
    const Plan plan = plan_for(technique, frame, few_samples(technique));
    plan_for(technique, next, few_samples(technique));
    const Frame expected = run(plan, frame, device()).frame;
    for (int time = 0; time < 2; ++time) {
      std::shared_ptr<Uploads> first = upload(plan, frame, own), second = upload(plan, next, own);
      ASSERT_TRUE(first && second) << name;
      EXPECT_FALSE(upload(plan, next, own)) << "a third frame";
      EXPECT_TRUE(same_bits(expected, run(plan, frame, own, {.uploads = std::move(first)}).frame)) << name;
      EXPECT_TRUE(same_bits(expected, run(plan, next, own, {.uploads = std::move(second)}).frame)) << name;
    }
  }
}

TEST(Run, SendsNothingAheadWhereTheHostsMemoryIsUsed) {
  Frame frame = shoot(perspective(50, 33), room());
  EXPECT_FALSE(upload(plan_for(find_technique("gtao"), frame, {}), frame, device()));
}

}  // namespace
}  // namespace gloam::test::run_test
