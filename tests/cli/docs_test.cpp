// Generated pages of docs/ agree with the program.
#include "cli/gloam_process.h"

namespace gloam::test {
namespace {

using Docs = Cli;

TEST_F(Docs, PageOnTechniquesFollowsTheRegistry) {
  const Result listed = gloam({"list", "techniques", "--markdown"});
  ASSERT_EQ(listed.status, 0);
  EXPECT_EQ(slurp(fs::path(GLOAM_SOURCE_DIR) / "docs/techniques.md"), listed.out)
      << "docs/techniques.md is stale: run script/update-techniques and commit the page";
}

}  // namespace
}  // namespace gloam::test
