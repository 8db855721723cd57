// What suits a device, and what its compiler is told of it.
#include "run/tuning.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "run/kernels.h"

namespace gloam::test::tuning_test {
namespace {

using Json = nlohmann::ordered_json;

TEST(Tuning, IsReadAsItIsKept) {
  const Tuning tuning{1, {128, 64}, {32}, true};
  const std::optional<Tuning> read = tuning_in(document_of(tuning));
  ASSERT_TRUE(read);
  EXPECT_EQ(document_of(*read), document_of(tuning));
  EXPECT_EQ(
      document_of(tuning),
      Json::parse(R"({"lanes": 1, "group": 128, "group_of_others": 32, "registers": 64, "gathers_by_loads": true})"));
}

/// As gloam kept them when all kernels had one group size.
TEST(Tuning, OfOneGroupSizeIsThatOfAllKernels) {
  const std::optional<Tuning> read = tuning_in(Json{{"lanes", 8}, {"group", 16}});
  ASSERT_TRUE(read);
  EXPECT_EQ(document_of(*read), document_of(Tuning{8, {16, 0}, {16, 0}}));
}

TEST(Tuning, ThatKernelsCannotRunWithIsNone) {
  for (const char* text :
       {R"({"lanes": 3, "group": 16})", R"({"lanes": 4, "group": -8})", R"({"lanes": 4, "group": 2000})",
        R"({"lanes": 4, "group": 16, "group_of_others": -1})", R"({"lanes": 4, "group": 16, "registers": -1})", "null"})
    EXPECT_FALSE(tuning_in(Json::parse(text))) << text;
}

/// Only kernels that read far around each pixel hold so much, and only NVIDIA's compiler takes a limit.
TEST(Tuning, LimitsRegistersWhereTheCompilerTakesALimit) {
  const Plan plan = make_plan({.outputs = {"gtao"}}, {"depth", "normal"}, "");
  const Tuning limited{1, {256, 64}, {256, 0}};
  DeviceInfo nvidia, other;
  nvidia.usual = limited;
  const auto options = [&](size_t pass, const DeviceInfo& info) {
    return build_options(plan.passes[pass], info, {}, limited);
  };
  ASSERT_TRUE(plan.passes.front().pass.footprint.is_wide);
  EXPECT_NE(options(0, nvidia).find(" -cl-nv-maxrregcount=64"), std::string::npos);
  EXPECT_EQ(options(1, nvidia).find("maxrregcount"), std::string::npos);
  EXPECT_EQ(options(0, other).find("maxrregcount"), std::string::npos);
}

TEST(Tuning, TellsKernelsToLoadOneByOne) {
  const Plan plan = make_plan({.outputs = {"sssr"}}, {"depth", "normal", "color", "roughness", "reflectance"}, "");
  for (const PlannedPass& pass : plan.passes) {
    EXPECT_NE(build_options(pass, {}, {}, {.lanes = 16, .gathers_by_loads = true}).find(" -D GATHERS_BY_LOADS=1"),
              std::string::npos);
    EXPECT_EQ(build_options(pass, {}, {}, {.lanes = 16}).find("GATHERS"), std::string::npos);
  }
}

/// Records of older gloams.
TEST(Tuning, WithoutAWayToGatherHasTheUsualOne) {
  const Json kept{{"lanes", 16}, {"group", 16}};
  EXPECT_TRUE(tuning_in(kept, {.lanes = 16, .gathers_by_loads = true})->gathers_by_loads);
  EXPECT_FALSE(tuning_in(kept)->gathers_by_loads);
}

TEST(Tuning, OptionsSetTheGroupsOfAllKernels) {
  DeviceInfo info;
  info.tuning = {4, {256, 64}, {128, 0}};
  const Tuning tuning = tuning_for(info, {.lanes = 8, .group = 16});
  EXPECT_EQ(document_of(tuning), document_of(Tuning{8, {16, 64}, {16, 0}}));
}

}  // namespace
}  // namespace gloam::test::tuning_test
