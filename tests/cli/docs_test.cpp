// Pages of docs/ agree with the program. Their snippets are run by tests/docs.
#include "cli/gloam_process.h"

namespace gloam::test::docs_test {
namespace {

using Docs = Cli;

TEST_F(Docs, PageOnTechniquesFollowsTheRegistry) {
  const Result listed = gloam({"list", "techniques", "--markdown"});
  ASSERT_EQ(listed.status, 0);
  EXPECT_EQ(slurp(fs::path(GLOAM_SOURCE_DIR) / "docs/techniques.md"), listed.out)
      << "docs/techniques.md is stale: run script/update-techniques and commit the page";
}

TEST_F(Docs, PageOnSequencesNamesEveryShot) {
  const std::string page = slurp(fs::path(GLOAM_SOURCE_DIR) / "docs/sequences.md");
  const std::string made = page.substr(page.find("## Making shots"));
  for (const nlohmann::json& shot : gloam({"list", "shots", "--json", "-"}).json())
    EXPECT_NE(
        made.find(fmt::format("`{} --shot {}`", shot["scene"].get<std::string>(), shot["shot"].get<std::string>())),
        std::string::npos);
}

}  // namespace
}  // namespace gloam::test::docs_test
