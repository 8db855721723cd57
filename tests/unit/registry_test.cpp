#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "gloam/technique.h"
#include "shared/both/params.h"

#define NEAR_PARAMS(P)                     \
  P(float, reach, 2, 0, 10, "", "how far") \
  P(choice, side, left, (left, right), "which")

#define FAR_PARAMS(P) P(int, samples, 3, 1, 16, "", "how many")

PARAMS(NearParams, NEAR_PARAMS)
PARAMS(FarParams, FAR_PARAMS)

namespace gloam::registry_test {
namespace {

TEST(Registry, EachListOfATableIsReadByItself) {
  ParameterValues values(NearParams::table() + FarParams::table());
  values.set("side", "right", "any");
  values.set("samples", "7", "any");
  EXPECT_EQ(values.as<NearParams>().side, NearParams::side_values::right);
  EXPECT_EQ(values.as<NearParams>().reach, 2);
  EXPECT_EQ(values.as<FarParams>().samples, 7);
}

/// Lists are found in a table by their first name.
TEST(Registry, EachParameterOfATechniqueHasANameOfItsOwn) {
  for (const Technique& technique : registry()) {
    std::set<std::string> names;
    for (const Parameter& parameter : technique.parameters)
      EXPECT_TRUE(names.insert(parameter.name).second) << technique.name << ": " << parameter.name;
  }
}

/// A pass written without its members' names compiles when these change their order, and then binds no plane or no file.
TEST(Registry, EveryPassBindsPlanesOfAFileThatExists) {
  for (const Technique& technique : registry()) {
    for (const Pass& pass : technique.passes(ParameterValues(technique.parameters))) {
      const std::string name = technique.name + "/" + pass.name;
      EXPECT_FALSE(pass.writes.empty() && pass.extras.empty()) << name;
      EXPECT_TRUE(pass.source.empty() ||
                  std::filesystem::exists(std::filesystem::path(GLOAM_SOURCE_DIR) / "kernels" / pass.source))
          << name << ": " << pass.source;
    }
  }
}

}  // namespace
}  // namespace gloam::registry_test
