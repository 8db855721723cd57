// Every flag of every command that takes a number, one of a few words, or text of a form, with text that it does not take. Which flags there
// are is asked of the command itself: a new flag joins, and is refused here until it checks its value or is listed as one of any text.
#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>
#include <set>

#include "cli/gloam_process.h"

namespace gloam::test::typed_flags_test {
namespace {

/// Flags that take names and files: what is wrong with them a frame, a scene, a device or the registry says.
const std::set<std::string> flags_of_any_text = {
    "--adaptive",    "--against",     "--anaglyph",    "--camera",    "--camera-path", "--command",
    "--composite",   "--device",      "--differences", "--display",   "--effects",     "--elsewhere",
    "--environment", "--explain",     "--falloff",     "--filter",    "--frame",       "--from",
    "--history",     "--into",        "--kernel",      "--items",     "--json",        "--markdown",
    "--only",        "--output",      "--outputs",     "--paper",     "--picture",     "--pictures",
    "--plane",       "--planes",      "--preset",      "--presets",   "--scan-line",   "--scene",
    "--scenes",      "--sequence",    "--set",         "--sheet",     "--shot",        "--side-by-side",
    "--sky",         "--sweep",       "--techniques",  "--truth",     "--variants",    "--view",
    "--views",       "--what",        "--with",        "--rows",      "--baseline",    "--google-benchmark",
    "--depth-file",  "--normal-file", "--color-file",  "--plane-file"};

Arguments words_in(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// The first group of what a pattern finds; none where it finds nothing.
std::optional<std::string> found_in(const std::string& text, const std::string& pattern) {
  std::smatch match;
  if (!std::regex_search(text, match, std::regex(pattern))) return {};
  return match[1].str();
}

class TypedFlags : public Cli, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    Cli::SetUp();
    completion = gloam({"completion", "bash"}).out;
  }

  /// What a function of the completion says of a command.
  Arguments said_by(const std::string& function, const std::string& command) const {
    const std::string body = completion.substr(completion.find("\n_gloam_" + function + "() {"));
    return words_in(found_in(body, "\n    " + command + "\\) echo '([^']*)'").value_or(""));
  }

  /// Those that are not of any text.
  Arguments checked_flags() const {
    const Arguments switches = said_by("switches", GetParam());
    Arguments flags;
    for (const std::string& flag : said_by("flags", GetParam())) {
      const bool has_value = flag.rfind("--", 0) == 0 && std::count(switches.begin(), switches.end(), flag) == 0;
      if (has_value && flags_of_any_text.count(flag) == 0) flags.push_back(flag);
    }
    return flags;
  }

  /// What is said of a value; nothing else is given, so that nothing begins.
  std::string said_of(const std::string& flag, const std::string& value) const {
    const Result result = gloam({GetParam(), flag, value});
    EXPECT_EQ(result.status, 2) << flag << " " << value << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << flag << " " << value << result.err;
    EXPECT_TRUE(result.out.empty()) << flag << " " << value << result.out;
    return result.err;
  }
  void expect_refused(const std::string& flag, const std::string& value) const {
    EXPECT_EQ(said_of(flag, value).rfind("gloam: " + flag + " " + value, 0), 0u) << said_of(flag, value);
  }
  void expect_taken(const std::string& flag, const std::string& value) const {
    EXPECT_EQ(said_of(flag, value).find("is not allowed"), std::string::npos) << said_of(flag, value);
  }

  std::string completion;
};

TEST_P(TypedFlags, RefuseTextOfAnotherKind) {
  const bool has_none = GetParam() == std::string("list") || GetParam() == std::string("doctor");
  EXPECT_EQ(checked_flags().empty(), has_none) << "list and doctor alone have none";
  for (const std::string& flag : checked_flags()) {
    for (const char* text : {"abc", "5x", "nan", "1e999", "0x10", "+5", " 5", "5 "}) expect_refused(flag, text);
    EXPECT_NE(said_of(flag, "").find("'" + flag + "'"), std::string::npos) << said_of(flag, "");
  }
}

TEST_P(TypedFlags, TakeNumbersWithinTheRangeThatTheyState) {
  for (const std::string& flag : checked_flags()) {
    const std::string said = said_of(flag, "abc");
    const bool is_whole = said.find("; a whole number from ") != std::string::npos;
    const auto least = found_in(said, " number from ([^ ]+) to "), most = found_in(said, " to ([^ ,]+)");
    if (!least || !most || flag == "--case") continue;  // whose list has numbers of its own
    expect_taken(flag, *least);
    expect_taken(flag, *most);
    if (is_whole) {
      for (const char* text : {"1.5", "1e3", "99999999999"}) expect_refused(flag, text);
      expect_refused(flag, std::to_string(std::stoll(*least) - 1));
      expect_refused(flag, std::to_string(std::stoll(*most) + 1));
      continue;
    }
    const bool takes_infinity = *most == "inf" || said.find("or inf") != std::string::npos;
    if (takes_infinity)
      expect_taken(flag, "inf");
    else
      expect_refused(flag, "inf");
    const double below = std::stod(*least) - 1e-3 * std::max(1.0, std::abs(std::stod(*least)));
    expect_refused(flag, fmt::format("{}", below));
    if (*most != "inf") expect_refused(flag, fmt::format("{}", 1.01 * std::stod(*most)));
  }
}

TEST_P(TypedFlags, AreCompletedWithTheWordsThatTheyTake) {
  for (const std::string& flag : checked_flags()) {
    const auto list = found_in(said_of(flag, "abc"), " is not allowed(?: \\([^)]*\\))?; (.*) are\n$");
    if (!list || list->find("numbers") == 0) continue;
    const Arguments taken = words_in(std::regex_replace(*list, std::regex(", | and "), " "));
    const auto completed =
        found_in(completion, "\n    " + std::string(GetParam()) + ":" + flag + "\\) _gloam_words '([^']*)' ;;");
    ASSERT_TRUE(completed) << flag;
    EXPECT_EQ(words_in(*completed), taken) << flag;
    EXPECT_GE(taken.size(), 2u) << flag;
    for (const std::string& word : taken) expect_taken(flag, word);
  }
}

/// "--quick=5" would be "--quick", and "--quick=0" nothing.
TEST_P(TypedFlags, TakeNoValueWhereTheyAreSwitches) {
  int count = 0;
  for (const std::string& flag : said_by("switches", GetParam())) {
    if (flag.rfind("--", 0) != 0) continue;
    ++count;
    for (const char* value : {"=5", "=0", "=false", "="}) {
      const Result result = gloam({GetParam(), flag + value});
      EXPECT_EQ(result.status, 2) << flag << value;
      EXPECT_EQ(result.err, fmt::format("gloam: {}{} is not allowed: {} takes no value; write {}, or leave it out\n",
                                        flag, value, flag, flag));
    }
  }
  EXPECT_GT(count, 0) << "--help and --quiet at least";
}

TEST_P(TypedFlags, LeaveHelpToThoseWhoAskForIt) {
  for (const std::string& flag : checked_flags()) {
    const Result result = gloam({GetParam(), flag, "abc", "--help"});
    EXPECT_EQ(result.status, 0) << flag << result.err;
    EXPECT_NE(result.out.find("Usage: gloam "), std::string::npos) << flag << result.out;
  }
}

const char* const commands[] = {"info",        "run",   "compare", "plan",   "list",  "capture",
                                "reference",   "bench", "score",   "pick",   "auto",  "report",
                                "leaderboard", "view",  "set",     "stress", "doctor"};

INSTANTIATE_TEST_SUITE_P(Commands, TypedFlags, ::testing::ValuesIn(commands),
                         [](const auto& info) { return std::string(info.param); });

using EveryCommand = Cli;

TEST_F(EveryCommand, IsAskedForItsFlags) {
  const auto known = found_in(gloam({"completion", "bash"}).out, "\n_gloam_commands='([^']*)'");
  ASSERT_TRUE(known);
  Arguments completed = words_in(*known), tested(std::begin(commands), std::end(commands));
  std::sort(completed.begin(), completed.end());
  std::sort(tested.begin(), tested.end());
  EXPECT_EQ(completed, tested);
}

/// What the tests above look for is there to be found.
TEST_F(EveryCommand, HasItsKindOfFlagsTold) {
  const std::pair<Arguments, std::string> told[] = {
      {{"run", "--fov", "5x"}, "gloam: --fov 5x is not allowed; a number from 1 to 179 is\n"},
      {{"run", "--background", "x"},
       "gloam: --background x is not allowed; a number from -3.40282e+38 to 3.40282e+38, or inf or -inf, is\n"},
      {{"run", "--repeat", "1.5"}, "gloam: --repeat 1.5 is not allowed; a whole number from 1 to 10000 is\n"},
      {{"pick", "--rounds", "-1"}, "gloam: --rounds -1 is not allowed; a whole number from 1 to 10000 is\n"},
      {{"pick", "--budget", "3d"},
       "gloam: --budget 3d is not allowed; write a number with its unit, such as 30ms, 500us, 90s, 2m30s or 1h, above "
       "0, or frames per second, such as 60fps\n"},
      {{"auto", "--budget", "0fps"},
       "gloam: --budget 0fps is not allowed; write a number with its unit, such as 30ms, 500us, 90s, 2m30s or 1h, "
       "above "
       "0, or frames per second, such as 60fps\n"},
      {{"reference", "--radius", "nan"},
       "gloam: --radius nan is not allowed; a number from 1e-30 to 1e+30, or inf, is\n"},
      {{"auto", "--mask", "measure"},
       "gloam: --mask measure is not allowed (did you mean 'measured'?); measured, always and never are\n"},
      {{"run", "--depth-encoding", "wrapped,srbg"},
       "gloam: --depth-encoding wrapped,srbg: 'srbg' is not allowed (did you mean 'srgb'?); auto and plain are, or "
       "some of srgb, bottom-up and wrapped\n"},
      {{"capture", "--size", "5x"}, "gloam: --size 5x is not WIDTHxHEIGHT; write 1920x1080\n"},
      {{"capture", "--modules", "3-"},
       "gloam: --modules 3- is not allowed; numbers and ranges are, such as 0,5,10-19\n"},
      {{"stress", "--case", "1,b"}, "gloam: --case b is not allowed; a whole number from 1 to 999 is\n"}};
  for (const auto& [arguments, message] : told) {
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_EQ(result.err, message);
  }
}

/// As written, in base 10, whichever way CLI11 would read them.
TEST_F(EveryCommand, TakesWholeNumbersWithZerosBefore) {
  const Result result =
      gloam({"capture", "plane", "-o", path("frame.exr"), "--size", "8x8", "--peel", "010", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["layers"]["stored"], 10);
}

/// Times have one grammar, whichever flag takes them: with a unit, since the same number would mean seconds here and milliseconds there.
TEST_F(EveryCommand, TakesTheSameTimes) {
  const std::vector<Arguments> commands = {{"auto", "x.exr", "-o", path("y.exr"), "--budget"},
                                           {"pick", "x.exr", "--budget"},
                                           {"bench", "-o", "y", "--frame", "x.exr", "--time"}};
  for (const Arguments& command : commands) {
    const auto said = [&](const std::string& time) {
      Arguments all = command;
      all.push_back(time);
      return gloam(all);
    };
    for (const char* time : {"500us", "30ms", "0.03s", "90s", "2m30s", "1h"})
      EXPECT_EQ(said(time).err.find(std::string(time) + " is not allowed"), std::string::npos)
          << command[0] << " " << said(time).err;
    for (const char* time : {"30", "0s", "-3ms", "ms", "30s2m", "1m1m", "1m30", "3 ms"}) {
      const Result result = said(time);
      EXPECT_EQ(result.status, 2) << command[0] << " " << time;
      EXPECT_NE(result.err.find("write a number with its unit"), std::string::npos) << command[0] << " " << result.err;
    }
  }
}

}  // namespace
}  // namespace gloam::test::typed_flags_test
