// gloam stress and bench in chunks: commands for several processes, whose files join to what one process writes.
#include "cli/gloam_process.h"

namespace gloam::test::chunk_commands_test {
namespace {

using Json = nlohmann::json;

class ChunkCommands : public Cli {
 protected:
  std::string file(const std::string& name) const { return path(name).string(); }
  Json json_of(const std::string& name) const { return Json::parse(slurp(path(name))); }

  std::vector<std::string> commands_of(const Arguments& command, int chunks) const {
    Arguments all = command;
    all.insert(all.end(), {"--chunks", std::to_string(chunks), "--print"});
    const std::vector<std::string> before = files();
    const Result printed = gloam(all);
    EXPECT_EQ(printed.status, 0) << printed.err;
    EXPECT_EQ(files(), before) << "nothing is computed";
    std::vector<std::string> lines;
    std::istringstream stream(printed.out);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
  /// From another folder. The exit status.
  int shell(const std::string& command) const {
    return WEXITSTATUS(std::system(("cd / && { " + command + "; } >" + file("log") + " 2>&1").c_str()));
  }
  void expect_refusal(const Arguments& arguments, int status, const std::vector<std::string>& says) const {
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_EQ(result.out, "");
    for (const std::string& words : says) EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  }
};

TEST_F(ChunkCommands, HardCasesJoinToWhatOneProcessFinds) {
  const Arguments look = {"stress", "normals,hbao+,dielectric", "--case", "3,11", "--quick", "--against", "none", "-q"};
  const auto with = [&](Arguments more) {
    more.insert(more.begin(), look.begin(), look.end());
    return more;
  };
  ASSERT_EQ(gloam(with({"--json", file("whole.json")})).status, 0);
  const std::vector<std::string> commands = commands_of(with({"--json", file("part.##.json")}), 2);
  ASSERT_EQ(commands.size(), 2u);
  for (const std::string& command : commands) ASSERT_EQ(shell(command), 0) << command << slurp(path("log"));
  const std::string first = slurp(path("part.01.json"));
  ASSERT_EQ(shell(commands[0]), 0);
  EXPECT_EQ(slurp(path("part.01.json")), first) << "a chunk that is run twice writes the same file";
  const Arguments join = {"stress", "--from", file("part.01.json"), file("part.02.json")};
  Arguments to_file = join;
  to_file.insert(to_file.end(), {"--json", file("joined.json")});
  const Result joined = gloam(to_file);
  EXPECT_EQ(joined.status, 0) << joined.err;
  EXPECT_EQ(json_of("joined.json"), json_of("whole.json"));
  EXPECT_NE(joined.out.find("dielectric"), std::string::npos) << joined.out;
  EXPECT_NE(joined.out.find("not in these files: alchemy"), std::string::npos) << joined.out;
  // Pages, too.
  for (const auto& [from, page] : std::map<std::string, std::string>{{"joined.json", "a.md"}, {"whole.json", "b.md"}})
    ASSERT_EQ(gloam({"stress", "--from", file(from), "--markdown", file(page)}).status, 0);
  EXPECT_EQ(slurp(path("a.md")), slurp(path("b.md")));
  expect_refusal({"stress", "--from", file("part.01.json"), file("whole.json")}, 1,
                 {"whole.json", "is also in", "part.01.json", "leave one"});
}

TEST_F(ChunkCommands, ASingleTechniqueIsDividedByItsCases) {
  const std::vector<std::string> commands =
      commands_of({"stress", "gtao", "--quick", "--case", "3,7,11", "--json", file("part.#.json")}, 9);
  ASSERT_EQ(commands.size(), 3u);
  EXPECT_NE(commands[1].find(" stress gtao --quick --case 7 --json "), std::string::npos) << commands[1];
}

TEST_F(ChunkCommands, AFigureBeyondItsBoundIsSeenInTheJoinedFiles) {
  program = GLOAM_WITH_FAULTS;
  const std::vector<std::string> commands =
      commands_of({"stress", "faultless,absolute-epsilon", "--case", "3", "--quick", "--against", "none", "--json",
                   file("part.##.json")},
                  2);
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_EQ(shell(commands[0]), 0) << slurp(path("log"));
  EXPECT_EQ(shell(commands[1]), 1) << slurp(path("log"));
  EXPECT_EQ(gloam({"stress", "--from", file("part.01.json")}).status, 0);
  const Result joined = gloam({"stress", "--from", file("part.01.json"), file("part.02.json")});
  EXPECT_EQ(joined.status, 1);
  EXPECT_EQ(joined.lines_of_error(), 1) << joined.err;
  EXPECT_NE(joined.err.find("beyond"), std::string::npos) << joined.err;
  EXPECT_NE(joined.out.find("again: gloam stress absolute-epsilon --case 3 --trial"), std::string::npos) << joined.out;
  // A run that was broken off has not examined all.
  Json broken = json_of("part.01.json");
  broken["left"] = {"crashes", "absolute-epsilon"};
  std::ofstream(path("part.03.json")) << broken.dump();
  const Result left = gloam({"stress", "--from", file("part.03.json"), file("part.02.json")});
  EXPECT_EQ(left.status, 1);
  EXPECT_NE(left.err.find("not examined, since a run was broken off: crashes;"), std::string::npos) << left.err;
}

TEST_F(ChunkCommands, MeasurementsJoinToWhatOneProcessMeasures) {
  const Arguments bench = {
      "bench", "--scenes", "plane,slab", "--techniques", "hbao,dp-hbao", "--size",      "48x32",       "--rays",
      "8",     "--rounds", "1",          "--variants",   "none",         "--no-growth", "--no-checks", "--no-images"};
  const auto to = [&](const std::string& folder) {
    Arguments all = bench;
    all.insert(all.end(), {"-o", file(folder)});
    return all;
  };
  Arguments whole_of_all = to("whole");
  whole_of_all.push_back("--all");  // as the chunks: within a minute, a busy machine would leave rows out
  ASSERT_EQ(gloam(whole_of_all).status, 0);
  const std::vector<std::string> commands = commands_of(to("part.##"), 4);
  ASSERT_EQ(commands.size(), 4u);
  std::map<std::string, Json> errors;
  const auto key = [](const Json& row) {
    return fmt::format("{} {} {}", row["scene"].get<std::string>(), row["technique"].get<std::string>(),
                       row["preset"].get<std::string>());
  };
  Arguments report = {"report"};
  for (size_t i = 0; i < commands.size(); ++i) {
    ASSERT_EQ(shell(commands[i]), 0) << commands[i] << slurp(path("log"));
    report.push_back(file(fmt::format("part.{:02}", i + 1)));
    const Json part = Json::parse(slurp(fs::path(report.back()) / "bench.json"));
    for (const Json& row : part["results"]) {
      EXPECT_TRUE(errors.emplace(key(row), row["rmse_to_truth"]).second) << key(row) << " is in two chunks";
      EXPECT_GT(row["ratio_to_hbao_plus"], 0) << "each chunk measures its baselines";
    }
  }
  const Json whole = json_of("whole/bench.json")["results"];
  EXPECT_EQ(errors.size(), whole.size());
  for (const Json& row : whole) EXPECT_EQ(errors[key(row)], row["rmse_to_truth"]) << key(row);
  report.insert(report.end(), {"--markdown", file("page.md")});
  const Result page = gloam(report);
  EXPECT_EQ(page.status, 0) << page.err;
  for (const char* words : {"| plane |", "| slab |", "dp-hbao"})
    EXPECT_NE(slurp(path("page.md")).find(words), std::string::npos) << words;
}

TEST_F(ChunkCommands, MeasurementsAreDividedByScenesFirst) {
  const Arguments bench = {"bench", "--scenes", "plane,slab,fence", "-o", file("part.##")};
  const std::vector<std::string> commands = commands_of(bench, 2);
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_NE(commands[0].find("--scenes plane"), std::string::npos) << commands[0];
  EXPECT_EQ(commands[0].find("--no-growth"), std::string::npos) << commands[0];
  EXPECT_NE(commands[1].find("--scenes slab,fence --no-growth"), std::string::npos) << commands[1];
  Arguments more = bench;
  more.insert(more.end(), {"--chunks", "9", "--print"});
  const Result printed = gloam(more);
  EXPECT_EQ(std::count(printed.out.begin(), printed.out.end(), '\n'), 3) << printed.out;
  EXPECT_NE(printed.err.find("--chunks 9: divided into 3"), std::string::npos) << printed.err;
}

TEST_F(ChunkCommands, AreRefusedWhereTheyCannotBeRunByThemselves) {
  const auto with = [](Arguments command) {
    command.insert(command.end(), {"--chunks", "2", "--print"});
    return command;
  };
  expect_refusal(with({"stress", "all"}), 2, {"--chunks 2", "--json stress.##.json"});
  expect_refusal(with({"stress", "all", "--json", file("one.json")}), 2, {"--chunks 2", "stress.##.json"});
  expect_refusal(with({"stress", "all", "--json", file("a.##.json"), "--markdown", file("a.md")}), 2, {"--markdown"});
  expect_refusal(with({"stress", "gtao", "--case", "3", "--trial", "1", "--json", file("a.##.json")}), 2,
                 {"--trial 1"});
  expect_refusal({"stress", "all", "--json", file("a.##.json"), "--chunks", "2"}, 2, {"--chunks", "--print"});
  expect_refusal({"stress", "gtao,nonesuch"}, 2, {"nonesuch"});
  expect_refusal({"stress", "gtao,"}, 2, {"gtao,"});
  expect_refusal(with({"bench", "-o", file("out")}), 2, {"-o", "bench.##"});
  expect_refusal(with({"bench", "-o", file("out.##"), "--json", file("a.json")}), 2, {"--json", "each chunk"});
  expect_refusal(with({"bench", "-o", file("out.##"), "--frame", loggia}), 2, {"--frame", "--techniques"});
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace gloam::test::chunk_commands_test
