#include <gtest/gtest.h>

#include <filesystem>

#include "gloam/technique.h"

namespace gloam::registry_test {
namespace {

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
