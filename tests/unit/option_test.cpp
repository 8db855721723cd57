// Options in messages (gloam/option.h).
#include "gloam/option.h"

#include <gtest/gtest.h>

#include "gloam/plan.h"
#include "unit/message_of.h"

namespace gloam::test {
namespace {

/// The tests of this program hold the words of the command.
const bool is_command = (set_caller(Caller::command), true);

class Options : public testing::Test {
 public:
  void TearDown() override { set_caller(Caller::command); }
};

TEST_F(Options, AreSpelledAsTheCallerWritesThem) {
  ASSERT_TRUE(is_command);
  EXPECT_EQ(option("temporal"), "--temporal");
  EXPECT_EQ(option("normal-axes", "x,-y,z"), "--normal-axes x,-y,z");
  EXPECT_EQ(option("view", "left"), "--view left");
  EXPECT_EQ(channels_option("depth", "Layer.Z"), "--plane depth=Layer.Z");
  set_caller(Caller::python);
  EXPECT_EQ(option("temporal"), "temporal=");
  EXPECT_EQ(option("normal-axes", "x,-y,z"), "normal_axes='x,-y,z'");
  EXPECT_EQ(option("near", "0.5"), "near=0.5");
  EXPECT_EQ(option("camera", "FILE"), "camera=FILE");
  EXPECT_EQ(option("view", "left"), "views='left'");
  EXPECT_EQ(channels_option("depth", "Layer.Z"), "channels={'depth': 'Layer.Z'}");
  set_caller(Caller::program);
  EXPECT_EQ(option("temporal"), "PlanRequest::temporal");
  EXPECT_EQ(option("real", "float"), "RunOptions::real = float");
  EXPECT_EQ(channels_option("depth", "Layer.Z"), "ReadOptions::channels[\"depth\"] = Layer.Z");
  EXPECT_EQ(option("a-new-one"), "a_new_one");
}

TEST_F(Options, OfAPlanAreNamedInItsErrors) {
  const auto refused = [] {
    return message_of([] { make_plan({.outputs = {"gtao"}, .elsewhere = "ssao"}, {"depth", "normal"}, ""); });
  };
  EXPECT_EQ(refused(), "--elsewhere ssao: needs a mask; add --only MASK");
  set_caller(Caller::python);
  EXPECT_EQ(refused(), "elsewhere='ssao': needs a mask; add only=MASK");
  set_caller(Caller::program);
  EXPECT_EQ(refused(), "PlanRequest::elsewhere = ssao: needs a mask; add PlanRequest::only = MASK");
}

}  // namespace
}  // namespace gloam::test
