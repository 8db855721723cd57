// The results of a run, view by view.
#include "gloam/run.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace gloam::test::run_test
