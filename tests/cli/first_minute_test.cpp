// The first commands of a person who has a frame and has read nothing: each does what was meant, or names what does.
#include "cli/gloam_process.h"

namespace gloam::test::first_minute_test {
namespace {

class FirstMinute : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    frame = path("frame.exr");
    fs::copy_file(loggia, frame);
  }
  /// The one line of a command that is refused.
  std::string refused(const Arguments& arguments) {
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_EQ(files(), std::vector<std::string>{"frame.exr"});
    return result.err;
  }
  void expect_has(const std::string& text, const std::vector<std::string>& words) {
    for (const std::string& word : words)
      EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' is not in: " << text;
  }
  fs::path frame;
};

TEST_F(FirstMinute, ATechniqueIsACommand) {
  const Result ao = gloam({"ao", frame}), run = gloam({"run", "ao", frame, "-o", path("other.exr")});
  ASSERT_EQ(ao.status, 0) << ao.err;
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(slurp(path("frame_ao.exr")).size(), slurp(path("other.exr")).size());
  expect_has(ao.out, {"wrote " + path("frame_ao.exr").string(), "gloam view ", "gloam compare ", " --help"});
  EXPECT_EQ(run.out.find("gloam view"), std::string::npos) << "who names a file is told of no other commands";
  ASSERT_EQ(gloam({"hbao+", frame, "--preset", "low", "--radius", "0.3"}).status, 0);
  EXPECT_TRUE(fs::exists(path("frame_hbao+.exr")));
  // Its own results are written anew.
  EXPECT_EQ(gloam({"ao", frame}).status, 0);
}

TEST_F(FirstMinute, NoFileIsLostThatGloamHasNotWritten) {
  fs::copy_file(frame, path("frame_gtao.exr"));
  const std::string before = slurp(path("frame_gtao.exr"));
  const Result result = gloam({"gtao", frame});
  EXPECT_EQ(result.status, 1);
  expect_has(result.err, {"frame_gtao.exr", "no result of gloam's", "-o OUT.exr"});
  EXPECT_EQ(slurp(path("frame_gtao.exr")), before);
}

TEST_F(FirstMinute, AShotsResultsLieBesideIt) {
  fs::copy_file(frame, path("shot.0001.exr"));
  fs::copy_file(frame, path("shot.0002.exr"));
  const Result result = gloam({"gtao", path("shot.####.exr")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(fs::exists(path("shot_gtao.0001.exr")));
  EXPECT_TRUE(fs::exists(path("shot_gtao.0002.exr")));
  fs::copy_file(frame, path("shot_gtao.0002.exr"), fs::copy_options::overwrite_existing);
  const Result again = gloam({"gtao", path("shot.%04d.exr")});
  EXPECT_EQ(again.status, 1);
  expect_has(again.err, {"shot_gtao.0002.exr", "no result of gloam's"});
}

TEST_F(FirstMinute, PicturesAlone) {
  ASSERT_EQ(gloam({"gtao", frame, "-o", path("a.png")}).status, 0);
  ASSERT_EQ(gloam({"run", "gtao", frame, "--picture", path("b.png")}).status, 0);
  EXPECT_EQ(files(), (std::vector<std::string>{"a.png", "b.png", "frame.exr"}));
  EXPECT_EQ(slurp(path("a.png")), slurp(path("b.png")));
}

TEST_F(FirstMinute, TwoPicturesAreRefused) {
  expect_has(refused({"gtao", frame, "-o", path("a.png"), "--picture", path("b.png")}),
             {"a.png", "b.png", "leave one out"});
}

TEST_F(FirstMinute, TheCommandThatWasMeantIsNamed) {
  const std::string name = frame.string();
  expect_has(refused({frame}), {"is a file", "gloam ao " + name, "gloam info " + name});
  expect_has(refused({"run", frame}), {"gloam run ao " + name});
  expect_has(refused({"run", frame, "gtao"}), {"gloam run gtao " + name});
  expect_has(refused({"plan", frame}), {"gloam plan ao " + name});
  expect_has(refused({"gtoa", frame}), {"did you mean 'gtao'", "each technique is one too"});
  expect_has(refused({"comapre", frame}), {"did you mean 'compare'"});
  expect_has(refused({"--versoin"}), {"did you mean '--version'"});
  expect_has(refused({"ao"}), {"frame is required"});
}

TEST_F(FirstMinute, HelpIsACommand) {
  const Result whole = gloam({"help"}), of_run = gloam({"help", "run"});
  EXPECT_EQ(whole.status, 0);
  EXPECT_EQ(whole.out, gloam({"--help"}).out);
  EXPECT_EQ(of_run.out, gloam({"run", "--help"}).out);
  expect_has(gloam({"gtao", "--help"}).out, {"Usage: gloam run", "Parameters of gtao"});
}

}  // namespace
}  // namespace gloam::test::first_minute_test
