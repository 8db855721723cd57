// gloam score --command: a method's own program, and programs that fail in every way.
#include <chrono>
#include <thread>

#include "cli/browser.h"
#include "cli/score_fixture.h"

namespace gloam::test::score_command_test {
namespace {

using Json = nlohmann::json;

const std::string example = std::string("/usr/bin/python3 ") + GLOAM_SOURCE_DIR + "/contrib/score/plane_ao.py";

class ScoreCommand : public ScoreTest {
 protected:
  static bool has_numpy() { return std::system("/usr/bin/python3 -c 'import numpy' 2>/dev/null") == 0; }

  /// Whether a process is there a little later. One that was killed may wait for its new parent.
  static bool is_running(int process) {
    const auto runs = [&] {
      const std::string status = slurp("/proc/" + std::to_string(process) + "/status");
      return !status.empty() && status.find("State:\tZ") == std::string::npos;
    };
    for (int i = 0; i < 2000 && runs(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return runs();
  }

  /// A program of the shell that copies the truth of an item as its image, after what `before` does.
  Result run(const std::string& before, const Arguments& more = {}) const {
    std::ofstream(path("engine.sh")) << "frame=$1 image=$2 item=$3 number=$4\n"
                                     << before << "\n"
                                     << "truth=" << path("set/truths").string() << "/${item}_ao\n"
                                     << "[ $item = walk ] && truth=$truth.000$number\n"
                                     << "cp $truth.exr $image\n";
    Arguments arguments = {"--command", "sh " + path("engine.sh").string() + " {frame} {image} {item} {frame_number}",
                           "--rounds", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return score(arguments);
  }
};

/// The example of docs/score.md: a method that gloam has not got, through its command and through its images.
TEST_F(ScoreCommand, ScoresAMethodThatGloamHasNotGot) {
  if (!has_numpy()) GTEST_SKIP() << "no NumPy for the example";
  entry({{"name", "plane AO"}, {"link", "https://example.org/plane"}});
  const Result made = score(
      {"--command", example + " --in {frame} --out {image} --camera {camera} --radius {radius}", "--rounds", "2"});
  ASSERT_EQ(made.status, 0) << made.err;
  for (const char* item : {"room", "walk", "pair"}) {
    const Json of_item = row(item, "plane AO");
    ASSERT_TRUE(of_item.is_object()) << item;
    EXPECT_LT(of_item["rmse_to_truth"], 0.16) << item;  // measured: .108 to .128; white has .17
    EXPECT_GT(of_item["rmse_to_truth"], 0.05) << item;
    const Json& whole = of_item["submitted"]["whole"];
    EXPECT_EQ(whole["ms"]["rounds"].size(), 2u) << item;
    EXPECT_EQ(whole["gloam_ms"]["rounds"].size(), 2u) << item;
    EXPECT_EQ(whole["ratio_rounds"].size(), 2u);
    EXPECT_GT(whole["ratio"], 0);
    EXPECT_EQ(whole["gloam_command"].get<std::string>().rfind("gloam run ao frames/", 0), 0u) << whole["gloam_command"];
    EXPECT_TRUE(of_item["ms"].is_null()) << "what is measured whole is no time of kernels";
  }
  // Of the command as it was given, the folders of this machine alone are left out.
  const Json scored_by = row("room", "plane AO")["submitted"]["scored_by"];
  const auto flag = std::find(scored_by.begin(), scored_by.end(), "--command");
  ASSERT_NE(flag, scored_by.end());
  EXPECT_EQ(*(flag + 1),
            "/usr/bin/python3 score/plane_ao.py --in {frame} --out {image} --camera {camera} --radius {radius}");
  EXPECT_TRUE(row("pair", "plane AO")["inconsistency"].is_number());
  EXPECT_TRUE(row("walk", "plane AO")["flicker"].is_number());
  const fs::path images = path("out/submitted/plane-AO");
  for (const char* name : {"room_ao.exr", "walk.0003_ao.exr", "pair_ao.exr"})
    EXPECT_TRUE(fs::exists(images / name)) << name;
  // the same images through JSON: the same figures
  entry({{"name", "plane AO by images"}, {"time_ms", 12.5}});
  const Result scored = score({images.string()});
  ASSERT_EQ(scored.status, 0) << scored.err;
  for (const char* item : {"room", "walk", "pair"}) {
    for (const char* figure : {"rmse_to_truth", "bias", "ssim", "flip", "flicker", "inconsistency"})
      EXPECT_EQ(row(item, "plane AO")[figure], row(item, "plane AO by images")[figure]) << item << " " << figure;
  }
  // as a picture of 16 bits: the same to their rounding
  ASSERT_EQ(score({"--command", example + " --in {frame} --out {image} --camera {camera} --radius {radius}", "--rounds",
                   "1", "--items", "room", "--image-type", "png"})
                .status,
            0);
  EXPECT_TRUE(fs::exists(path("out/submitted/plane-AO-by-images/room_ao.png")));
  EXPECT_NEAR(row("room", "plane AO by images")["rmse_to_truth"], row("room", "plane AO")["rmse_to_truth"], 1e-5);
  // the camera that a program gets is the frame's
  const Json told = gloam({"info", frame("room"), "--json", "-"}).json()["camera"],
             given = gloam({"info", frame("room"), "--camera", (images / "room.camera.json").string(), "--json", "-"})
                         .json()["camera"];
  for (const char* key : {"fx", "fy", "cx", "cy"}) EXPECT_NEAR(given[key], told[key], 1e-3) << key;
  ok({"report", path("out")});
  const std::string page = slurp(path("out/report.html"));
  EXPECT_NE(page.find("plane AO by images"), std::string::npos);
  EXPECT_NE(page.find("https://example.org/plane"), std::string::npos);
  ok({"report", path("out"), "--markdown", path("page.md")});
  EXPECT_NE(slurp(path("page.md")).find("## Submitted methods"), std::string::npos);
}

TEST_F(ScoreCommand, WholeSequencesAtOnce) {
  std::ofstream(path("engine.sh")) << "set -e; case $1 in *walk*) for n in 1 2 3; do cp " << path("set/truths").string()
                                   << "/walk_ao.000$n.exr $(echo $2 | sed s/####/000$n/); done;; *) cp "
                                   << path("set/truths").string() << "/$3_ao.exr $2;; esac\n";
  const Result result =
      score({"--command", "sh " + path("engine.sh").string() + " {frames} {images} {item}", "--rounds", "1"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(row("walk")["rmse_to_truth"], 0);
  EXPECT_EQ(row("walk")["submitted"]["frames"], Json({1, 2, 3}));
  EXPECT_EQ(row("room")["rmse_to_truth"], 0);
  const std::string own = row("walk")["submitted"]["whole"]["gloam_command"];
  EXPECT_NE(own.find("walk.####.exr"), std::string::npos) << own;
}

TEST_F(ScoreCommand, ProgramsThatFailAreOneLineEach) {
  const std::pair<std::string, std::string> told[] = {
      {"[ $item = room ] && { echo 'out of ideas' >&2; exit 3; }", "'sh' ended: exit status 3: out of ideas"},
      {"[ $item = room ] && kill -SEGV $$", "'sh' ended: signal 11 (Segmentation fault)"},
      {"[ $item = room ] && { echo rubbish > $image; exit 0; }", "room_ao.exr: "},
      {"[ $item = room ] && { yes | head -c 1000000; exit 0; }", "'sh' left no "},
      {"[ $item = room ] && { : > $image; exit 0; }", "room_ao.exr: "},
      {"[ $item = room ] && { item=walk; number=1; }", ": is 64x36, and 96x54 is needed"}};
  for (const auto& [before, message] : told) {
    const Result result = run(before);
    EXPECT_EQ(result.status, 1) << result.err;
    EXPECT_EQ(result.lines_of_error(), 3) << before << "\n" << result.err;  // a note on the set
    EXPECT_EQ(result.err.rfind("gloam: room: left out: ", 0), 0u) << result.err;
    EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("gloam: 1 image left out, 2 items scored"), std::string::npos) << result.err;
    EXPECT_EQ(document()["results"].size(), 2u);
    fs::remove_all(path("out"));
  }
}

TEST_F(ScoreCommand, OfASequenceTheOtherFramesAreScored) {
  const Result result = run("[ $item = walk ] && [ $number = 2 ] && exit 7", {"--items", "walk"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err.rfind("gloam: walk frame 2: left out: 'sh' ended: exit status 7", 0), 0u) << result.err;
  EXPECT_EQ(row("walk")["submitted"]["missing_frames"], Json({2}));
}

TEST_F(ScoreCommand, ProgramsThatHangAreEndedWithWhatTheyStarted) {
  // Longer than the harness lets a command run.
  const Result result =
      run("[ $item = room ] && { sleep 100000 & echo $! > " + path("pid").string() + "; sleep 100000; }",
          {"--timeout", "10"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err.rfind("gloam: room: left out: 'sh' ended: still running after 10 s", 0), 0u) << result.err;
  EXPECT_EQ(document()["results"].size(), 2u);
  EXPECT_FALSE(is_running(std::stoi(slurp(path("pid"))))) << "its child is still there";
}

TEST_F(ScoreCommand, ThatIsNotThereIsLeftOutOfAll) {
  const Result result = score({"--command", "no-such-engine {frame} {image}"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("'no-such-engine' cannot be started: No such file or directory"), std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("nothing could be scored"), std::string::npos) << result.err;
}

TEST_F(ScoreCommand, InterruptedItEndsItsChildrenAndKeepsWhatWasScored) {
  std::ofstream(path("engine.sh")) << "case $3 in room) cp " << path("set/truths/room_ao.exr").string()
                                   << " $2;; *) echo $$ > " << path("pid").string() << "; exec sleep 100000;; esac\n";
  const pid_t child =
      start({"score", "--json", path("entry.json"), "--set", path("set"), "-o", path("out"), "--command",
             "sh " + path("engine.sh").string() + " {frame} {image} {item}", "--rounds", "1"});
  for (int i = 0; i < 8000 && slurp(path("pid")).empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ASSERT_FALSE(slurp(path("pid")).empty());
  kill(child, SIGINT);
  const Result result = finish(child);
  EXPECT_EQ(result.status, 128 + SIGINT);
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  EXPECT_NE(result.err.find("what was scored is in " + path("out/bench.json").string()), std::string::npos)
      << result.err;
  EXPECT_EQ(document()["results"].size(), 1u);
  EXPECT_FALSE(is_running(std::stoi(slurp(path("pid")))));
  for (const auto& entry : fs::directory_iterator(path("out/submitted/other")))
    EXPECT_NE(entry.path().filename().string().rfind(".gloam-making-", 0), 0u) << entry.path();
}

/// An image of an earlier run stays where the command makes no new one.
TEST_F(ScoreCommand, AnEarlierImageStaysUntilThereIsANewOne) {
  ASSERT_EQ(run("", {"--items", "room"}).status, 0);
  const fs::path image = path("out/submitted/other/room_ao.exr");
  const std::string before = slurp(image);
  ASSERT_FALSE(before.empty());
  for (const char* fails : {"exit 3", "[ -e $image ] && exit 0; echo half > $image; exit 4", "exit 0"}) {
    EXPECT_EQ(run(fails, {"--items", "room"}).status, 1) << fails;
    EXPECT_TRUE(slurp(image) == before) << fails;
  }
  for (const auto& entry : fs::directory_iterator(image.parent_path()))
    EXPECT_EQ(entry.path().filename().string().rfind(".gloam", 0), std::string::npos) << entry.path();
}

/// A whole sequence too: the images that one run leaves out are told, whatever an earlier run had left.
TEST_F(ScoreCommand, OfAWholeSequenceNoEarlierImageStandsIn) {
  const auto engine = [&](const std::string& numbers) {
    std::ofstream(path("engine.sh")) << "for n in " << numbers << "; do cp " << path("set/truths").string()
                                     << "/walk_ao.000$n.exr $(echo $1 | sed s/####/000$n/); done\n";
    return score(
        {"--command", "sh " + path("engine.sh").string() + " {images} {frames}", "--rounds", "1", "--items", "walk"});
  };
  ASSERT_EQ(engine("1 2 3").status, 0);
  const std::string second = slurp(path("out/submitted/other/walk.0002_ao.exr"));
  const Result result = engine("1 3");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("walk frame 2: left out: 'sh' left no "), std::string::npos) << result.err;
  EXPECT_TRUE(slurp(path("out/submitted/other/walk.0002_ao.exr")) == second);
}

/// What is scored, and what it is scored against, is no file that gloam or the command writes.
TEST_F(ScoreCommand, WritesOverNothingThatItReads) {
  const auto expect_kept = [&](const fs::path& file, const Arguments& arguments) {
    const std::string before = slurp(file);
    ASSERT_FALSE(before.empty()) << file;
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_NE(result.err.find("is also"), std::string::npos) << result.err;
    EXPECT_TRUE(slurp(file) == before) << file;
  };
  const auto with = [&](const Arguments& more) {
    Arguments all = {"score", "--json", path("entry.json"), "-o", path("out"), "--rounds", "1"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const fs::path images = path("out/submitted/other"), pictures = path("out/images/room");
  fs::create_directories(images);
  fs::create_directories(pictures);
  fs::copy_file(frame("room"), images / "room.exr");
  fs::copy_file(truth("room", "ao"), images / "room_ao.exr");
  std::ofstream(images / "room.camera.json") << R"({"width": 96, "height": 54, "fx": 70, "fy": 70, "cx": 48, "cy": 27,
             "camera_to_world": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]})";
  const std::string engine = "false {frame} {image}";
  expect_kept(images / "room_ao.exr",
              with({"--command", engine, "--frame", images / "room.exr", "--truth", images / "room_ao.exr"}));
  expect_kept(images / "room.camera.json",
              with({"--command", engine + " {camera}", "--frame", images / "room.exr", "--truth", truth("room", "ao"),
                    "--camera", images / "room.camera.json"}));
  const auto scored = [&](const fs::path& image) {
    return Arguments{"score",     image,     "--json",      path("entry.json"), "-o",
                     path("out"), "--frame", frame("room"), "--truth",          truth("room", "ao")};
  };
  ASSERT_EQ(gloam({"info", frame("room"), "--picture", pictures / "truth.png"}).status, 0);
  expect_kept(pictures / "truth.png", scored(pictures / "truth.png"));
  fs::copy_file(pictures / "truth.png", pictures / "other_submitted.png");
  expect_kept(pictures / "other_submitted.png", scored(pictures / "other_submitted.png"));
  fs::create_symlink(path("entry.json"), path("out/bench.json"));
  expect_kept(path("entry.json"), scored(truth("room", "ao")));
}

/// Numbers of any digits: {frames} and {images} are patterns.
TEST_F(ScoreCommand, FramesOfAnyDigitsAreAPattern) {
  const auto expect_words = [&](const std::string& frames, const std::string& truths, const std::string& told) {
    const Result result =
        gloam({"score", "--json", path("entry.json"), "-o", path("out"), "--frame", path(frames), "--truth",
               path(truths), "--command", "sh -c 'echo says ${{1##*/}} ${{2##*/}} >&2; exit 1' x {frames} {images}"});
    EXPECT_NE(result.err.find("says " + told), std::string::npos) << result.err;
  };
  for (const int number : {9, 10}) {
    for (const std::string& form : {fmt::format("{}", number), fmt::format("{:02}", number)}) {
      fs::copy_file(frame("walk.0001"), path("one." + form + ".exr"), fs::copy_options::overwrite_existing);
      fs::copy_file(truth("walk", "ao", ".0001"), path("truth." + form + ".exr"), fs::copy_options::overwrite_existing);
    }
  }
  expect_words("one.%d.exr", "truth.%d.exr", "one.#.exr one.####_ao.exr");
  expect_words("one.##.exr", "truth.##.exr", "one.##.exr one.####_ao.exr");
}

class ScoreInBrowser : public BrowserTest {};

/// A submitted row is drawn with its error alone, marked, in chart, table and box.
TEST_F(ScoreInBrowser, SubmittedMethodsAreMarked) {
  if (!has_browser()) GTEST_SKIP() << "no chromium to look with (Debian: chromium)";
  fs::create_directories(path("out"));
  const auto measured = [](const char* technique, double ratio, double rmse) {
    return Json{{"technique", technique},
                {"preset", "medium"},
                {"scene", "hall"},
                {"effect", "ao"},
                {"ms", {{"median", 4 * ratio}}},
                {"ratio_to_hbao_plus", ratio},
                {"rmse_to_truth", rmse},
                {"ssim", 0.9},
                {"flip", 0.1}};
  };
  const Json submitted = {
      {"technique", "Engine AO"},
      {"preset", "submitted"},
      {"scene", "hall"},
      {"effect", "ao"},
      {"ms", {{"median", 2.5}}},
      {"rmse_to_truth", 0.12},
      {"ssim", 0.8},
      {"flip", 0.2},
      {"submitted",
       {{"name", "Engine AO"},
        {"link", "https://example.org"},
        {"time_ms", 2.5},
        {"fit", {{"exponent", 1.5}, {"strength", 0.9}, {"rmse_to_truth", 0.11}}},
        {"whole", {{"ms", {{"median", 100.0}}}, {"gloam_ms", {{"median", 50.0}}}, {"ratio", 2.0}}}}}};
  const Json document = {{"scenes", {{{"name", "hall"}, {"class", "architecture"}}}},
                         {"results", {measured("hbao+", 1, 0.2), submitted, measured("gtao", 1.5, 0.1)}}};
  std::ofstream(path("out/bench.json")) << document.dump();
  const Result report = gloam({"report", path("out")});
  ASSERT_EQ(report.status, 0) << report.err;
  EXPECT_NE(report.out.find("2 rows, 1 submitted row, "), std::string::npos) << report.out;
  const Json result = in_browser(
      path("out/report.html"), "await until(() => document.querySelectorAll('#scatter .point_marks path').length > 0);",
      "result.points = document.querySelectorAll('#scatter .point_marks path').length;"
      "result.levels = document.querySelectorAll('#scatter .level_stars path').length;"
      "click(document.querySelector('#scatter .level_stars path'));"
      "pick(keyOf(data.rows.find(isSubmitted)));"
      "result.box = document.getElementById('picked').textContent;"
      "result.link = document.querySelector('#picked a').href;"
      "result.table = [...document.querySelectorAll('#rows-table tr')].map((tr) => tr.textContent).join('|');"
      "result.badges = document.querySelectorAll('#rows-table .badge').length;"
      "[...document.querySelectorAll('#time-switch button')].find((b) => b.textContent.includes('ms')).click();"
      "await until(() => document.querySelectorAll('#scatter .point_marks path').length === 3);"
      "result.remark = document.getElementById('scatter-remark').textContent;"
      "result.front = sceneNow().front.length;");
  EXPECT_EQ(result["points"], 2);
  EXPECT_EQ(result["levels"], 1);
  EXPECT_EQ(result["front"], 2) << "no submitted row is on the front";
  EXPECT_EQ(result["badges"], 1);
  EXPECT_EQ(result["link"], "https://example.org/");
  const std::string box = result["box"], table = result["table"], remark = result["remark"];
  for (const char* words : {"Engine AO", "submitted", "2.50", "at its best fit", "0.1100", "over gloam run, whole"})
    EXPECT_NE(box.find(words), std::string::npos) << words << " in " << box;
  EXPECT_NE(table.find("Engine AO"), std::string::npos) << table;
  EXPECT_NE(remark.find("as their authors state them"), std::string::npos) << remark;
}

}  // namespace
}  // namespace gloam::test::score_command_test
