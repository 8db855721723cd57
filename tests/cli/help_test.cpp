// What `gloam --help` and its relatives show, and in how wide lines.
#include <regex>
#include <set>

#include "cli/gloam_process.h"

namespace gloam::test::help_test {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

class Help : public Cli {
 protected:
  /// What is printed in lines of so many columns; 0: for a program.
  std::string said(const Arguments& arguments, int columns = 0) const {
    const Result result = gloam(arguments, {{"COLUMNS", columns > 0 ? std::to_string(columns) : ""}});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(result.err.empty()) << result.err;
    return result.out;
  }
  /// The long names in the left column, in order.
  std::vector<std::string> flags_in(const std::string& help) const {
    static const std::regex row("  (?:-[a-zA-Z],)?(--[a-z0-9-]+)(?: .*)?");
    std::vector<std::string> flags;
    std::smatch match;
    for (const std::string& line : lines_of(help))
      if (std::regex_match(line, match, row)) flags.push_back(match[1]);
    return flags;
  }
};

TEST_F(Help, GroupsCommandsByWhatAPersonWants) {
  std::vector<std::string> groups;
  std::set<std::string> commands;
  static const std::regex heading("([A-Z][a-z ]+):"), row("  ([a-z]+)  +.*");
  std::smatch match;
  for (const std::string& line : lines_of(said({"--help"}))) {
    if (std::regex_match(line, match, heading)) groups.push_back(match[1]);
    if (std::regex_match(line, match, row)) commands.insert(match[1]);
  }
  EXPECT_EQ(groups, (Arguments{"Options", "Compute", "Judge", "Choose", "Make scenes and their truth", "Look",
                               "Big jobs", "Examples"}));
  EXPECT_EQ(commands.size(), 17u);
  const std::string error = gloam({"nonsense"}).err, completion = gloam({"completion", "bash"}).out;
  for (const std::string& command : commands) {
    EXPECT_NE(error.find(command), std::string::npos) << "errors name the same commands: " << command;
    EXPECT_NE(completion.substr(0, completion.find("_gloam_techniques")).find(command), std::string::npos) << command;
  }
}

TEST_F(Help, OfARunShowsFirstWhatMostNeed) {
  const std::string brief = said({"run", "--help"}), all = said({"run", "--help-all"});
  const Arguments first = {"--output", "--radius", "--preset", "--picture", "--camera", "--fov", "--depth", "--frames"};
  Arguments shown = flags_in(brief);
  ASSERT_EQ(shown.size(), first.size() + 1);
  EXPECT_EQ(shown.back(), "--help-all");
  shown.pop_back();
  EXPECT_EQ(shown, first);
  const Arguments every = flags_in(all);
  ASSERT_GT(every.size(), 50u);
  EXPECT_EQ(Arguments(every.begin(), every.begin() + 8), first);
  EXPECT_EQ(std::set<std::string>(every.begin(), every.end()).size(), every.size()) << "each flag once";
  const std::string bash = gloam({"completion", "bash"}).out;
  std::smatch match;
  ASSERT_TRUE(std::regex_search(bash, match, std::regex("_gloam_flags\\(\\) \\{[^}]*\n    run\\) echo '([^']*)'")));
  std::istringstream known(match[1]);
  for (std::string flag; known >> flag;)
    EXPECT_TRUE(!flag.starts_with("--") || std::find(every.begin(), every.end(), flag) != every.end()) << flag;
}

TEST_F(Help, IsWholeWhereACommandHasFewFlags) {
  EXPECT_EQ(said({"compare", "--help"}), said({"compare", "--help-all"}));
  const std::string everything = said({"--help-all"});
  for (const char* command : {"run", "compare", "stress", "set"})
    EXPECT_NE(everything.find(said({command, "--help-all"})), std::string::npos) << command;
}

TEST_F(Help, LinesAreAsWideAsTheTerminal) {
  for (const Arguments& arguments : {Arguments{"--help"},
                                     {"--help-all"},
                                     {"gtao", "--help"},
                                     {"list", "techniques"},
                                     {"list", "techniques", "gtao"},
                                     {"list", "scenes"},
                                     {"help", "--only"}}) {
    for (const int columns : {80, 110}) {
      const std::string text = said(arguments, columns);
      for (const std::string& line : lines_of(text)) {
        const bool is_one_word = line.find(' ', line.find_first_not_of(' ')) == std::string::npos;
        const bool is_name = std::regex_match(line, std::regex("  [^ ]+ [^ ]+"));
        EXPECT_TRUE(is_one_word || is_name || line.size() <= size_t(columns)) << line;
      }
      const auto words = [](const std::string& said) {
        std::istringstream stream(std::regex_replace(said, std::regex(" \\\\\n"), " "));
        std::vector<std::string> all;
        for (std::string word; stream >> word;) all.push_back(word);
        return all;
      };
      EXPECT_EQ(words(text), words(said(arguments))) << "nothing is lost";
    }
  }
}

TEST_F(Help, AWrappedExampleIsTheSameCommand) {
  const std::string text = said({"score", "--help"}, 60);
  EXPECT_NE(text.find(" \\\n      --"), std::string::npos) << text;
  EXPECT_NE(text.find("'engine --in {frame} --out {image}'"), std::string::npos) << "what is quoted stays whole";
}

TEST_F(Help, ExamplesBeginWithAo) {
  for (const char* command : {"run", "plan"}) {
    const std::string help = said({command, "--help"});
    const std::string first = help.substr(help.find("Examples:\n") + 10);
    EXPECT_TRUE(first.starts_with(command == std::string("run") ? "  gloam ao " : "  gloam plan ao ")) << first;
  }
}

TEST_F(Help, TellsOfAFlag) {
  for (const char* flag :
       {"--only", "--elsewhere", "--adaptive", "--lanes", "--ladder", "--processes", "--alpha", "--mask"}) {
    const std::string text = said({"help", flag});
    EXPECT_NE(text.find(std::string("\n  ") + flag + " "), std::string::npos) << text;
    if (flag != std::string("--mask")) {  // a plane, and so a technique
      EXPECT_EQ(text, said({"help", flag + 2}));
    }
  }
  EXPECT_NE(said({"help", "--mask"}).find("measured (the default): both ways are timed"), std::string::npos);
  EXPECT_NE(said({"help", "max-reach"}).find("gloam run with alchemy, "), std::string::npos);
  const Result none = gloam({"help", "--onyl"});
  EXPECT_EQ(none.status, 2);
  EXPECT_EQ(none.lines_of_error(), 1);
  EXPECT_NE(none.err.find("no flag '--onyl'"), std::string::npos) << none.err;
}

TEST_F(Help, ListsBeginWithWhatIsRecommended) {
  const std::vector<std::string> lines = lines_of(said({"list", "techniques"}));
  ASSERT_GT(lines.size(), 10u);
  EXPECT_EQ(lines[0], "recommended, where");
  for (size_t i = 1; i <= 5; ++i) EXPECT_TRUE(lines[i].starts_with("* ")) << lines[i];
  EXPECT_TRUE(lines[1].starts_with("* evidence ")) << lines[1];
  EXPECT_EQ(lines[6], "");
}

}  // namespace
}  // namespace gloam::test::help_test
