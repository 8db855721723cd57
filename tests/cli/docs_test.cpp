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

/// What stands between a text and the next.
std::string between(const std::string& page, const std::string& begin, const std::string& end) {
  const size_t from = page.find(begin) + begin.size();
  return page.substr(from, page.find(end, from) - from);
}

TEST_F(Docs, CommandsOfThePageOnSequencesWork) {
  const std::string page = slurp(fs::path(GLOAM_SOURCE_DIR) / "docs/sequences.md");
  std::ofstream(path("path.json")) << between(page, "```json\n", "```");
  const auto first_of = [&](const std::string& heading) {
    return between(page.substr(page.find(heading)), "```\n", "```");
  };
  const std::string commands = between(page, "Frames to try this on, by `", "`") + "\n" +
                               between(page, "```\n", "```") + first_of("## Into a copy") + first_of("## Composite") +
                               first_of("## What each frame calls for") + first_of("## Accumulating over time") +
                               first_of("## Error and flicker");
  ASSERT_EQ(std::count(commands.begin(), commands.end(), '\n'), 15) << commands;
  const std::string prepared = fmt::format("cd {} && PATH={}:$PATH && set -e\n{}", folder.string(),
                                           fs::path(program).parent_path().string(), commands);
  ASSERT_EQ(std::system(("(" + prepared + ") >" + path("log").string() + " 2>&1").c_str()), 0)
      << commands << slurp(path("log"));
  for (const char* file :
       {"ao.0012.exr", "gtao.0001.exr", "gtao.0011.exr", "full.0012.exr", "copy.0012.exr", "graded.0012.exr",
        "all.0012.exr", "auto.0004.exr", "plot.png", "difference.0004.png", "flicker.json"})
    EXPECT_TRUE(fs::exists(path(file))) << file;
  EXPECT_FALSE(fs::exists(path("gtao.0002.exr")));
}

TEST_F(Docs, CommandThatMeasuresAShotWorks) {
  const std::string page = slurp(fs::path(GLOAM_SOURCE_DIR) / "docs/benchmarking.md");
  const std::string command = between(between(page.substr(page.find("## A sequence")), "```\n", "```"), "", "\n");
  ASSERT_EQ(command.rfind("gloam bench -o out/walk --sequence ", 0), 0u) << command;
  const std::string prepared =
      fmt::format("cd {} && PATH={}:$PATH && {}", folder.string(), fs::path(program).parent_path().string(), command);
  ASSERT_EQ(std::system(("(" + prepared + ") >" + path("log").string() + " 2>&1").c_str()), 0) << slurp(path("log"));
  EXPECT_EQ(nlohmann::json::parse(slurp(path("out/walk/bench.json")))["sequence"]["frames"].size(), 4u);
}

TEST_F(Docs, CommandsThatMakeShotsWork) {
  const std::string page = slurp(fs::path(GLOAM_SOURCE_DIR) / "docs/sequences.md");
  const std::string made = page.substr(page.find("## Making shots")), traced = page.substr(page.find("## Their truth"));
  const std::string commands = between(made, "```\n", "```") + between(traced, "```\n", "```");
  ASSERT_EQ(std::count(commands.begin(), commands.end(), '\n'), 4) << commands;
  const std::string prepared = fmt::format("cd {} && PATH={}:$PATH && set -e\n{}", folder.string(),
                                           fs::path(program).parent_path().string(), commands);
  ASSERT_EQ(std::system(("(" + prepared + ") >" + path("log").string() + " 2>&1").c_str()), 0)
      << commands << slurp(path("log"));
  for (const char* file : {"walk.0009.exr", "gears.0002.exr", "truth.0001.exr", "truth.0002.exr"})
    EXPECT_TRUE(fs::exists(path(file))) << file;
  // The page names every shot that there is.
  for (const nlohmann::json& shot : gloam({"list", "shots", "--json", "-"}).json())
    EXPECT_NE(
        made.find(fmt::format("`{} --shot {}`", shot["scene"].get<std::string>(), shot["shot"].get<std::string>())),
        std::string::npos);
}

TEST_F(Docs, CommandsOfThePageOnSeveralMachinesAreDivided) {
  const std::string page = slurp(fs::path(GLOAM_SOURCE_DIR) / "docs/farm.md");
  const std::string commands = between(page, "for the number of the command:\n\n```\n", "```");
  ASSERT_EQ(std::count(commands.begin(), commands.end(), '\n'), 2) << commands;
  const std::string prepared = fmt::format("cd {} && PATH={}:$PATH && set -e\n{}", folder.string(),
                                           fs::path(program).parent_path().string(), commands);
  ASSERT_EQ(std::system(("(" + prepared + ") >" + path("log").string() + " 2>&1").c_str()), 0)
      << commands << slurp(path("log"));
  for (const auto& [file, count] : std::map<std::string, int>{{"stress.txt", 8}, {"bench.txt", 7}}) {
    const std::string text = slurp(path(file));
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), count) << file;
  }
}

TEST_F(Docs, CommandsOfThePageOnLookingAtFramesWork) {
  const std::string page = slurp(fs::path(GLOAM_SOURCE_DIR) / "docs/view.md");
  const std::string commands = between(page, "```\n", "```");
  ASSERT_EQ(std::count(commands.begin(), commands.end(), '\n'), 5) << commands;
  const std::string prepared = fmt::format("cd {} && PATH={}:$PATH && set -e\n{}", folder.string(),
                                           fs::path(program).parent_path().string(), commands);
  ASSERT_EQ(std::system(("(" + prepared + ") >" + path("log").string() + " 2>&1").c_str()), 0)
      << commands << slurp(path("log"));
  for (const char* file : {"frame.view.html", "look.html"}) EXPECT_TRUE(fs::exists(path(file))) << file;
}

}  // namespace
}  // namespace gloam::test
