// Shell completion of `gloam`, tested in bash with the script that the command writes.
#include "cli/gloam_process.h"

namespace gloam::test::completion_test {
namespace {

class Completion : public Cli {
 protected:
  /// What bash offers for the last of the words.
  std::string offered(const std::string& words) {
    const std::string file = path("completion").string();
    std::ofstream(file) << gloam({"completion", "bash"}).out;
    const std::string out = path("offered").string();
    const std::string script = "source '" + file + "' && COMP_WORDS=(" + words +
                               ") && COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) && _gloam && echo \"${COMPREPLY[*]}\" >'" +
                               out + "'";
    const std::string command = "cd '" + folder.string() + "' && bash -c \"" + escaped(script) + "\"";
    EXPECT_EQ(std::system(command.c_str()), 0) << script;
    std::string text = slurp(out);
    if (!text.empty()) text.pop_back();
    return text;
  }

 private:
  static std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) out += std::string(c == '"' || c == '$' || c == '\\' ? "\\" : "") + c;
    return out;
  }
};

TEST_F(Completion, OffersCommandsTechniquesFlagsAndPresets) {
  EXPECT_EQ(offered("gloam rep"), "report");
  EXPECT_EQ(offered("gloam comp"), "compare") << "and not the command that writes this";
  EXPECT_EQ(offered("gloam run hb"), "hbao hbao+");
  EXPECT_EQ(offered("gloam run gtao --pre"), "--preset");
  EXPECT_EQ(offered("gloam run gtao --preset m"), "medium");
  EXPECT_EQ(offered("gloam run gtao --preset = m"), "medium") << "bash takes --preset=m for three words";
  EXPECT_EQ(offered("gloam run gtao --with bent_normal,c"), "bent_normal,cone");
  EXPECT_EQ(offered("gloam stress al"), "alchemy all");
  EXPECT_EQ(offered("gloam capture cor"), "corridor");
  EXPECT_EQ(offered("gloam nothing --x y"), "");
}

TEST_F(Completion, OffersParametersOfTheTechniqueThatIsNamed) {
  EXPECT_EQ(offered("gloam run hbao+ --falloff qua"), "quadratic");
  EXPECT_EQ(offered("gloam run hbao+ --fallo"), "--falloff");
  EXPECT_EQ(offered("gloam run bitmask --fallo"), "");
  EXPECT_EQ(offered("gloam run ao x.exr --radi"), "--radius")
      << "ao stands for a technique, whose parameters these are";
  EXPECT_EQ(offered("gloam run ao x.exr --max-r"), "--max-reach");
  EXPECT_EQ(offered("gloam plan ao x.exr --max-r"), "--max-reach");
}

TEST_F(Completion, KnowsTechniquesAsCommands) {
  EXPECT_EQ(offered("gloam gt"), "gtao");
  EXPECT_EQ(offered("gloam g"), "gaussian gtao");
  EXPECT_EQ(offered("gloam ao x.exr --max-r"), "--max-reach");
  EXPECT_EQ(offered("gloam hbao+ x.exr --falloff = qua"), "quadratic");
  EXPECT_EQ(offered("gloam gtao x.exr --preset m"), "medium");
  std::ofstream(path("frame.exr")) << "x";
  EXPECT_EQ(offered("gloam gtao fram"), "frame.exr");
  EXPECT_EQ(offered("gloam hel"), "help");
  EXPECT_EQ(offered("gloam help comp"), "compare");
}

TEST_F(Completion, OffersFilesOfTheEndingThatIsTaken) {
  for (const char* name : {"frame.exr", "frame.png"}) std::ofstream(path(name)) << "x";
  EXPECT_EQ(offered("gloam run gtao --half fram"), "frame.exr") << "--half takes no value";
  EXPECT_EQ(offered("gloam run gtao frame.exr --picture fram"), "frame.png");
}

/// A flag of the table that is known by another name would get no completion.
TEST_F(Completion, KnowsTheValuesOfEveryFlagThatHasAFewOnly) {
  const std::string bash = gloam({"completion", "bash"}).out;
  for (const char* flag : {"run:--resolution", "run:--depth", "run:--normal-space", "run:--lanes", "run:--math",
                           "run:--real", "run:--compression", "pick:--by", "auto:--mask", "capture:--outline-method",
                           "run:--filter", "run:--elsewhere", "run:--only", "run:--preset", "run:--adaptive",
                           "bench:--techniques", "bench:--scenes", "reference:--falloff"}) {
    const size_t at = bash.find(std::string("    ") + flag + ") ");
    ASSERT_NE(at, std::string::npos) << flag;
    EXPECT_NE(bash.substr(at, bash.find('\n', at) - at).find("_gloam_"), std::string::npos) << flag;
  }
}

TEST_F(Completion, IsWrittenForTwoShellsAndNoOther) {
  EXPECT_EQ(gloam({"completion", "zsh"}).out.rfind("#compdef gloam\n", 0), 0u);
  const Result other = gloam({"completion", "fish"});
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("bash and zsh are"), std::string::npos) << other.err;
  EXPECT_EQ(gloam({"--help"}).out.find("completion"), std::string::npos);
}

}  // namespace
}  // namespace gloam::test::completion_test
