// The first commands of a person who has a frame and has read nothing: each does what was meant, or names what does.
#include "cli/gloam_process.h"
#include "support/stress.h"

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
  const Frame by_word = FrameFile(path("frame_ao.exr"), {}).read({"ao"}),
              by_run = FrameFile(path("other.exr"), {}).read({"ao"});
  EXPECT_TRUE(same_bits(by_word, by_run));
  expect_has(ao.out, {"wrote " + path("frame_ao.exr").string(), "gloam view ", "gloam compare ", " --help"});
  EXPECT_EQ(run.out.find("gloam view"), std::string::npos) << "who names a file is told of no other commands";
  ASSERT_EQ(gloam({"hbao+", frame, "--preset", "low", "--radius", "0.3"}).status, 0);
  EXPECT_TRUE(fs::exists(path("frame_hbao+.exr")));
  // Its own results are written anew, whatever the flags.
  EXPECT_EQ(gloam({"ao", frame}).status, 0);
  EXPECT_EQ(gloam({"ao", frame, "--background", "1e9"}).status, 0);
  EXPECT_EQ(gloam({"ao", frame}).status, 0);
}

TEST_F(FirstMinute, NoFileIsLostThatHasThisNameForAnotherReason) {
  const auto kept = [&](const std::string& why) {
    const std::string before = slurp(path("frame_gtao.exr"));
    const Result result = gloam({"gtao", frame});
    EXPECT_EQ(result.status, 1) << why;
    expect_has(result.err, {"frame_gtao.exr", "not the result of an earlier call", "-o OUT.exr"});
    EXPECT_EQ(slurp(path("frame_gtao.exr")), before) << why;
  };
  fs::copy_file(frame, path("frame_gtao.exr"));
  kept("a frame");
  ASSERT_EQ(gloam({"run", "gtao", frame, "-o", path("frame_gtao.exr"), "--preset", "ultra"}).status, 0);
  kept("a result that somebody named");
  fs::create_directory(path("other"));
  fs::copy_file(frame, path("other/frame.exr"));
  ASSERT_EQ(gloam({"gtao", path("other/frame.exr")}).status, 0);
  fs::rename(path("other/frame_gtao.exr"), path("frame_gtao.exr"));
  EXPECT_EQ(gloam({"gtao", frame}).status, 0) << "by its header, the file is of the frame beside it";
  ASSERT_EQ(gloam({"run", "gtao", frame, "--into", path("copy.exr")}).status, 0);
  fs::rename(path("copy.exr"), path("frame_gtao.exr"));
  kept("a copy of the frame");
}

TEST_F(FirstMinute, AShotsResultsAreNamed) {
  fs::copy_file(frame, path("shot.0001.exr"));
  const Result result = gloam({"gtao", path("shot.####.exr")});
  EXPECT_EQ(result.status, 2);
  expect_has(result.err, {"give one, such as -o 'gtao.####.exr'"});
}

// A result has no depth: its frame tells the background.
TEST_F(FirstMinute, TheBackgroundIsThatOfTheFrame) {
  const auto pixels = [&](const Arguments& more) {
    Arguments all = {"compare", path("frame_ao.exr"), path("b.exr"), "--json", "-"};
    all.insert(all.end(), more.begin(), more.end());
    const Result result = gloam(all);
    EXPECT_EQ(result.status, 0) << result.err;
    return std::pair(result.json()["pixels"].get<int>(), result.err);
  };
  ASSERT_EQ(gloam({"ao", frame}).status, 0);
  ASSERT_EQ(gloam({"gtao", frame, "-o", path("b.exr")}).status, 0);
  const auto [counted, said] = pixels({});
  EXPECT_EQ(counted, pixels({"--frame", frame}).first);
  EXPECT_LT(counted, 480 * 270);
  expect_has(said, {"frame.exr, which the test was made of"});
  write_frame(frame, small_frame(480, 270));
  EXPECT_EQ(pixels({}).first, 480 * 270) << "another frame of that name";
}

// Programs show what they know: gloam's own channel, AO, they do not.
TEST_F(FirstMinute, AResultIsShownByProgramsThatKnowNoAO) {
  ASSERT_EQ(gloam({"ao", frame}).status, 0);
  FrameFile file(path("frame_ao.exr"), {.as_stored = true, .channels = {{"mask", "Y"}}});
  EXPECT_EQ(file.all_channels(), (Arguments{"AO", "Y"}));
  const Frame both = file.read({"ao", "mask"});
  for (int y = 0; y < both.height(); ++y)
    for (int x = 0; x < both.width(); ++x)
      ASSERT_EQ(both.views[0].find("ao")->channels[0].at(x, y), both.views[0].find("mask")->channels[0].at(x, y));
  ASSERT_EQ(gloam({"capture", "gallery", "-o", path("pair.exr"), "--size", "32x18", "--stereo", "0.065"}).status, 0);
  ASSERT_EQ(gloam({"gtao", path("pair.exr")}).status, 0);
  EXPECT_EQ(FrameFile(path("pair_gtao.exr"), {}).all_channels(), (Arguments{"AO", "Y", "right.AO", "right.Y"}));
}

TEST_F(FirstMinute, PlanesAskedForByNameAreMadeRawToo) {
  EXPECT_EQ(gloam({"plan", "gtao", frame, "--json", "-"}).json()["outputs"], nlohmann::json({"ao"}));
  EXPECT_EQ(gloam({"plan", "ao,ao_raw", frame, "--json", "-"}).json()["outputs"], nlohmann::json({"ao", "ao_raw"}));
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
  expect_has(refused({"help", "gtoa"}), {"no command 'gtoa' (did you mean 'gtao'?)"});
  expect_has(refused({"help", "nonsense"}), {"no command 'nonsense'; there are run, auto,", "(gloam --help)"});
  expect_has(refused({"comapre", "--help"}), {"did you mean 'compare'"});
  expect_has(refused({"comapre", frame}), {"did you mean 'compare'"});
  expect_has(refused({"--versoin"}), {"did you mean '--version'"});
  expect_has(refused({"hlep"}), {"no command 'hlep' (did you mean 'help'?)"});
}

TEST_F(FirstMinute, WhatIsMissingIsNamedWithAnExample) {
  expect_has(refused({"ao"}), {"gloam: ao: FRAME.exr is missing (EXR file, or PNG,",
                               "; give it as in: gloam ao frame.exr (gloam ao --help)"});
  expect_has(refused({"gtao"}), {"gloam: gtao: FRAME.exr is missing", "; give it as in: gloam gtao frame.exr ("});
  expect_has(refused({"run", "ao"}), {"gloam: run: FRAME.exr is missing", "; give it as in: gloam ao frame.exr ("});
  expect_has(refused({"ao", "a.exr", "b.exr", "c.exr"}), {"gloam: ao: one argument too many: 'c.exr'"});
  expect_has(refused({"plan", "gtao"}), {"plan: FRAME.exr is missing", "gloam plan gtao frame.exr"});
  expect_has(refused({"capture", "gallery"}), {"capture: --output FRAME.exr is missing", "as in: gloam capture "});
  expect_has(refused({"ao", "--depth-file", "a.png", "--depth-file", "b.png"}),
             {"gloam: ao: --depth-file is given 2 times (a.png, b.png); give it once"});
}

TEST_F(FirstMinute, AutoNamesItsResultAsRunDoes) {
  const Result result = gloam({"auto", frame, "--mask", "never"});
  ASSERT_EQ(result.status, 0) << result.err;
  expect_has(result.out, {"wrote " + path("frame_auto.exr").string()});
  EXPECT_EQ(gloam({"auto", frame, "--mask", "never"}).status, 0) << "its own result is written anew";
  fs::copy_file(frame, path("frame_auto.exr"), fs::copy_options::overwrite_existing);
  expect_has(gloam({"auto", frame}).err, {"frame_auto.exr", "not the result of an earlier call"});
  fs::remove(path("frame_auto.exr"));
  ASSERT_EQ(gloam({"auto", frame, "--mask", "never", "-o", path("a.png")}).status, 0);
  ASSERT_EQ(gloam({"auto", frame, "--mask", "never", "--explain", path("b.png")}).status, 0);
  EXPECT_EQ(files(), (std::vector<std::string>{"a.png", "b.png", "frame.exr"}));
  fs::remove(path("a.png"));
  fs::remove(path("b.png"));
  expect_has(refused({"auto", frame, "-o", path("a.png"), "--explain", path("b.png")}),
             {"a.png", "b.png", "leave one out"});
}

TEST_F(FirstMinute, HelpIsACommand) {
  const Result whole = gloam({"help"}), of_run = gloam({"help", "run"});
  EXPECT_EQ(whole.status, 0);
  EXPECT_EQ(whole.out, gloam({"--help"}).out);
  EXPECT_EQ(of_run.out, gloam({"run", "--help"}).out);
  const std::string of_gtao = gloam({"gtao", "--help"}).out;
  expect_has(of_gtao, {"Parameters of gtao", "Usage: gloam run", "Flags that most calls need"});
  EXPECT_EQ(of_gtao.rfind("gtao: ambient occlusion", 0), 0u) << of_gtao;
  EXPECT_LT(of_gtao.find("Parameters of gtao"), of_gtao.find("Usage: gloam run"));
  EXPECT_EQ(of_gtao, gloam({"run", "gtao", "--help"}).out);
  expect_has(of_run.out, {"gloam ao --depth-file depth.png "});
}

}  // namespace
}  // namespace gloam::test::first_minute_test
