// gloam run --chunks: commands for several processes, which together write what one process does.
#include "cli/shot_fixture.h"

namespace gloam::test::chunks_test {
namespace {

using Chunks = ShotTest;

std::vector<std::string> lines_of_text(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST_F(Chunks, TogetherWriteWhatOneProcessWrites) {
  make_shot({1, 2, 3, 5, 8});
  const Arguments settings = {"--set", "bias=0.2", "--float", "-q", "--missing", "hold"};
  ASSERT_EQ(run(settings).status, 0);
  const auto whole = contents();
  ASSERT_EQ(whole.size(), 8u);
  for (const auto& [name, unused] : whole) std::filesystem::remove(path(name));
  Arguments divided = settings;
  divided.insert(divided.end(), {"--chunks", "3", "--print"});
  const Result printed = run(divided);
  ASSERT_EQ(printed.status, 0) << printed.err;
  EXPECT_TRUE(contents().empty()) << "nothing is computed";
  const std::vector<std::string> commands = lines_of_text(printed.out);
  ASSERT_EQ(commands.size(), 3u);
  // From the last to the first, from another folder, and one of them twice.
  for (const size_t k : {2u, 1u, 0u, 1u})
    EXPECT_EQ(std::system(("cd / && { " + commands[k] + "; }").c_str()), 0) << commands[k];
  EXPECT_EQ(contents(), whole);
}

TEST_F(Chunks, KeepTheirWordsInQuotes) {
  std::filesystem::create_directory(path("it's a folder"));
  const std::string folder = "it's a folder/";
  for (const int number : {1, 2}) write_frame(path(folder + numbered("shot", number)), frame_of(number));
  const Result printed = gloam({"run", "ao", file(folder + "shot.####.exr"), "-o", file(folder + "ao.####.exr"),
                                "--frames", "1-2", "--chunks", "9", "--print"});
  ASSERT_EQ(printed.status, 0) << printed.err;
  const std::vector<std::string> commands = lines_of_text(printed.out);
  ASSERT_EQ(commands.size(), 2u) << "no more than there are frames";
  for (const std::string& command : commands)
    EXPECT_EQ(std::system((command + " -q > /dev/null").c_str()), 0) << command;
  EXPECT_TRUE(std::filesystem::exists(path(folder + "ao.0002.exr")));
}

TEST_F(Chunks, AreRefusedWhereTheyCannotBeRunByThemselves) {
  make_shot({1, 2});
  std::ofstream(path("cameras.json")) << R"({"width": 64, "height": 48, "cx": 32, "cy": 24, )"
                                      << R"("camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]], )"
                                      << R"("frames": [{"fx": 50, "fy": 50}, {"fx": 51, "fy": 51}]})";
  const Arguments chunks = {"--chunks", "2", "--print"};
  const auto with = [&](Arguments more) {
    more.insert(more.end(), chunks.begin(), chunks.end());
    return run_of(more);
  };
  expect_refused(with({"--json", file("run.json")}), 2, {"--json", "each chunk would write it"});
  expect_refused(with({"--camera", file("cameras.json")}), 2, {"--camera", "list them by number"});
  expect_refused(run_of({"--chunks", "2"}), 2, {"--chunks", "--print"});
  expect_refused(run_of({"--print"}), 2, {"--print", "--chunks"});
  expect_refused(run_of({"--chunks", "0", "--print"}), 2, {"--chunks 0"});
  expect_refused({"run", "ao", file(numbered("shot", 1)), "-o", file("ao.exr"), "--chunks", "2", "--print"}, 2,
                 {"--chunks: is for a shot"});
}

}  // namespace
}  // namespace gloam::test::chunks_test
