// No file that a command reads is written over, and no two outputs are one file: every command, every output, every file read, and every
// way to write a name.
#include <regex>
#include <set>

#include "cli/gloam_process.h"

namespace gloam::test::written_files_test {
namespace {

/// A command, the files that it reads and the flags of the files that it writes. A word that begins with @ is a name in the test's folder.
struct Reading {
  std::string command;
  std::vector<std::string> reads, flags;
  std::string otherwise;  ///< what the command needs where the flag is not -o
};

const std::vector<Reading> readings = {
    {"info @f.exr", {"f.exr", "f.json"}, {"--json"}},
    {"info @f.exr --camera @c.0001.json", {"c.0001.json"}, {"--json"}},
    {"info @h.exr",
     {"h.exr", "h.json"},
     {"--json"}},  // the header has the camera, and the file beside it is the frame's too
    {"info @s.####.exr --frames 1", {"s.0001.exr", "s.0003.exr", "s.camera.json"}, {"--json"}},
    {"plan gtao @f.exr", {"f.exr", "f.json"}, {"--json"}},
    {"plan evidence @f.exr --coefficients @cf.json", {"cf.json"}, {"--json"}},
    {"run gtao @f.exr --radius 0.5", {"f.exr", "f.json"}, {"-o", "--into", "--composite", "--json"}, "-o @new.exr"},
    {"run gtao @f.exr --radius 0.5 --history @a.exr", {"a.exr"}, {"-o", "--json"}, "-o @new.exr"},
    {"run environment @f.exr --radius 0.5 --environment @sky.exr", {"sky.exr"}, {"-o", "--json"}, "-o @new.exr"},
    {"run evidence @f.exr --radius 0.5 --coefficients @cf.json", {"cf.json"}, {"--json"}, "-o @new.exr"},
    {"run gtao @s.####.exr --radius 0.5 --frames 1",
     {"s.0001.exr", "s.0003.exr", "s.camera.json"},
     {"--json"},
     "-o @new.####.exr"},
    {"run gtao @s.####.exr --radius 0.5 --camera @c.####.json",
     {"c.0002.json", "s.0002.exr"},
     {"--json"},
     "-o @new.####.exr"},
    {"run environment @s.####.exr --radius 0.5 --environment @sky.exr", {"sky.exr"}, {"--json"}, "-o @new.####.exr"},
    {"auto @f.exr", {"f.exr", "f.json"}, {"-o", "--composite", "--json"}, "-o @new.exr"},
    {"auto @s.####.exr --radius 0.5 --frames 2", {"s.0002.exr", "s.camera.json"}, {"--json"}, "-o @new.####.exr"},
    {"compare @a.exr @f.exr", {"a.exr", "f.exr"}, {"--json"}},
    {"compare @a.exr @a.exr --frame @f.exr", {"f.exr"}, {"--json"}},
    {"compare @s.####.exr @f.exr", {"s.0002.exr", "f.exr"}, {"--json"}},
    {"compare --stereo @a.exr --frame @f.exr", {"a.exr", "f.exr"}, {"-o", "--json"}},
    {"capture @s.obj --size 16x9", {"s.obj", "s.mtl", "wall.png"}, {"--json"}, "-o @new.exr"},
    {"capture @s.obj --size 16x9 --camera @c.0001.json", {"c.0001.json"}, {"--json"}, "-o @new.exr"},
    {"reference ao @f.exr --scene @s.obj --samples 32 --radius 0.5",
     {"f.exr", "f.json", "s.obj", "s.mtl", "wall.png"},
     {"-o", "--json"},
     "-o @new.exr"},
    {"reference environment @f.exr --scene @s.obj --samples 32 --radius 0.5 --environment @sky.exr",
     {"sky.exr"},
     {"-o", "--json"},
     "-o @new.exr"},
    {"reference ao @s.####.exr --scene @s.obj --samples 32 --radius 0.5",
     {"s.0002.exr", "s.camera.json", "s.mtl"},
     {"--json"},
     "-o @new.####.exr"},
    {"bench --frame @f.exr --truth @t.exr -o @made --techniques gtao --radius 0.5",
     {"f.exr", "f.json", "t.exr"},
     {"--json", "--google-benchmark"}},
    {"pick @f.exr --truth @t.exr --budget 20ms", {"f.exr", "f.json", "t.exr"}, {"--json"}},
    {"report @b", {"b/bench.json"}, {"--json", "--markdown"}},
    {"report @b @b/bench.json --compare", {"b/bench.json"}, {"--json", "--markdown"}},
    {"leaderboard @b", {"b/bench.json"}, {"-o", "--json"}},
    {"view @f.exr --no-open", {"f.exr", "f.json"}, {"-o", "--json"}},
    {"view @s.####.exr --frames 1 --no-open", {"s.0001.exr", "s.0003.exr", "s.camera.json"}, {"-o", "--json"}},
    {"set verify @set", {"set/manifest.json"}, {"--json"}},
    {"stress --from @st.json", {"st.json"}, {"--json", "--markdown"}},
};

/// Commands that read no file of the user's; `score` names the files that it writes by itself (score_command_test.cpp).
const std::set<std::string> others = {"list", "doctor", "completion", "score"};

class WrittenFiles : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    for (const char* made : {"made/scenes", "b", "set", "below"}) fs::create_directories(path(made));
    const auto frame = [](const std::vector<std::string>& planes) {
      Frame made = small_frame(32, 24, planes);
      made.views[0].camera.reset();
      return made;
    };
    for (const char* name : {"f.exr", "s.0001.exr", "s.0002.exr", "s.0003.exr"})
      write_frame(path(name), frame({"depth", "normal", "color"}));
    write_frame(path("h.exr"), small_frame(32, 24, {"depth", "normal", "color"}));
    for (const char* name : {"a.exr", "t.exr"}) write_frame(path(name), frame({"depth", "ao"}));
    Frame sky = small_frame(32, 16, {"color"});
    sky.views[0].camera.reset();
    write_frame(path("sky.exr"), sky);
    for (const char* name : {"f.json", "h.json", "s.camera.json", "c.0001.json", "c.0002.json", "c.0003.json"})
      std::ofstream(path(name)) << R"({"width": 32, "height": 24, "fx": 32, "fy": 32, "cx": 16, "cy": 12,
        "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]})";
    std::ofstream(path("s.obj"))
        << "mtllib s.mtl\nusemtl wall\nv -9 -9 -4\nv 9 -9 -4\nv 0 9 -4\nvt 0 0\nvt 1 0\nvt 0 1\n"
           "f 1/1 2/2 3/3\n";
    std::ofstream(path("s.mtl")) << "newmtl wall\nKd 1 1 1\nmap_Kd wall.png\n";
    ASSERT_EQ(gloam({"info", path("f.exr"), "--picture", path("wall.png")}).status, 0);
    std::ofstream(path("b/bench.json")) << R"({"scenes": [{"name": "hall", "class": "architecture"}], "results": [
      {"technique": "hbao+", "preset": "medium", "scene": "hall", "effect": "ao", "ms": {"median": 4},
       "ratio_to_hbao_plus": 1, "rmse_to_truth": 0.2, "ssim": 0.9, "flip": 0.1}]})";
    for (const char* name : {"cf.json", "st.json", "set/manifest.json"}) std::ofstream(path(name)) << "{}";
  }

  /// The words of a command; a name with @ in this test's folder.
  Arguments words_of(const std::string& command) const {
    Arguments words;
    std::istringstream stream(command);
    for (std::string word; stream >> word;) words.push_back(word[0] == '@' ? path(word.substr(1)).string() : word);
    return words;
  }

  /// Every file below the folder with its content, but the captured output.
  std::map<std::string, std::string> everything() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const std::string name = entry.path().lexically_relative(folder).string();
      if (name == "stdout" || name == "stderr" || entry.is_directory()) continue;
      all[name] = slurp(entry.path());
    }
    return all;
  }

  /// Whether a flag takes names of frames alone.
  static bool is_for_frames(const std::string& command, const std::string& flag) {
    return flag == "--into" || flag == "--composite" || flag == "--sky" ||
           (flag == "-o" && !command.starts_with("view") && !command.starts_with("leaderboard"));
  }

  void expect_nothing_lost(const Arguments& arguments) const {
    const auto before = everything();
    const Result result = gloam(arguments);
    std::string line;
    for (const std::string& word : arguments) line += word + " ";
    EXPECT_EQ(result.status, 2) << line << "\n" << result.err;
    EXPECT_NE(result.err.find("is also"), std::string::npos) << line << "\n" << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << line << "\n" << result.err;
    EXPECT_EQ(everything(), before) << line;
  }

  Arguments command_with(const Reading& reading, const std::string& flag, const std::string& file) const {
    Arguments arguments = words_of(reading.command + (flag == "-o" ? "" : " " + reading.otherwise));
    if (!flag.empty()) arguments.insert(arguments.end(), {flag, file});
    return arguments;
  }
};

TEST_F(WrittenFiles, NoFileThatIsReadIsWrittenOver) {
  for (const Reading& reading : readings) {
    for (const std::string& flag : reading.flags) {
      for (const std::string& file : reading.reads) {
        if (is_for_frames(reading.command, flag) && !file.ends_with(".exr")) continue;
        expect_nothing_lost(command_with(reading, flag, path(file).string()));
      }
    }
  }
}

/// A command that is not in the table would not be tested.
TEST_F(WrittenFiles, EveryCommandIsInTheTable) {
  std::istringstream help(gloam({"--help"}).out);
  static const std::regex row("  ([a-z]+)  +.*");
  std::smatch match;
  int commands = 0;
  for (std::string line; std::getline(help, line);) {
    if (!std::regex_match(line, match, row)) continue;
    ++commands;
    const std::string name = match[1];
    EXPECT_TRUE(others.count(name) ||
                std::any_of(readings.begin(), readings.end(),
                            [&](const Reading& reading) { return reading.command.starts_with(name + " "); }))
        << name;
  }
  EXPECT_GT(commands, 15);
}

TEST_F(WrittenFiles, WhateverTheFileIsCalled) {
  fs::create_directory_symlink(".", path("here"));
  fs::create_directory_symlink(folder, path("below/above"));
  for (const char* name : {"f.exr", "f.json", "s.0003.exr"}) {
    const std::string ending = fs::path(name).extension();
    fs::create_symlink(name, path("link" + ending));
    fs::create_hard_link(path(name), path("hard" + ending));
    const std::vector<std::string> spellings = {"./" + std::string(name),
                                                "here/" + std::string(name),
                                                "below/../" + std::string(name),
                                                "below/above/here/" + std::string(name),
                                                "link" + ending,
                                                "hard" + ending};
    for (const std::string& spelling : spellings) {
      const std::string flag = ending == ".exr" ? "-o" : "--json";
      if (std::string(name) == "s.0003.exr") {  // a frame that is not asked for
        expect_nothing_lost(words_of("info @s.####.exr --frames 1 --json @" + spelling));
        continue;
      }
      expect_nothing_lost(
          command_with({"run gtao @f.exr --radius 0.5", {}, {}, "-o @new.exr"}, flag, path(spelling).string()));
    }
    fs::remove(path("link" + ending));
    fs::remove(path("hard" + ending));
  }
}

TEST_F(WrittenFiles, AResultIsNoFrameOfTheShotThatIsRead) {
  // a link to a frame outside --frames
  fs::create_symlink("../s.0003.exr", path("below/ao.0001.exr"));
  expect_nothing_lost(words_of("run gtao @s.####.exr --radius 0.5 --frames 1 -o @below/ao.####.exr"));
  // a name that is none yet: it would be a frame the next time
  expect_nothing_lost(words_of("run gtao @s.####.exr --radius 0.5 --frames 4 --missing hold -o @s.####.exr"));
  expect_nothing_lost(words_of("auto @s.####.exr --radius 0.5 --frames 4 --missing hold -o @s.%04d.exr"));
  expect_nothing_lost(words_of("run gtao @s.####.exr --radius 0.5 --frames 1 -o @new.####.exr --json @s.0009.exr"));
}

TEST_F(WrittenFiles, NoTwoOutputsAreOneFile) {
  fs::create_directory_symlink(".", path("here"));
  fs::create_symlink("new.exr", path("link.exr"));  // leads to nothing yet
  for (const char* command :
       {"run gtao @f.exr --radius 0.5 -o @new.exr --composite @./new.exr",
        "run gtao @f.exr --radius 0.5 -o @new.exr --composite @link.exr",
        "run gtao @f.exr --radius 0.5 -o @new.exr --json @here/new.exr",
        "run gtao @f.exr --radius 0.5 -o @new.exr --into @here/new.exr",
        "run gtao @s.####.exr --radius 0.5 -o @new.####.exr --json @here/new.0002.exr",
        "run gtao @s.####.exr --radius 0.5 -o @new.####.exr --composite @here/new.%04d.exr",
        "auto @f.exr -o @new.exr --composite @here/new.exr",
        "auto @f.exr -o @new.exr --json @here/new.exr",
        "auto @s.####.exr --radius 0.5 -o @new.####.exr --json @here/new.0003.exr",
        "capture statue -o @new.exr --sky @here/new.exr",
        "capture statue -o @new.exr --json @link.exr",
        "capture gallery --shot walk --frames 1-3 -o @new.####.exr --sky @here/new.0003.exr",
        "reference ao @f.exr --scene @s.obj -o @new.exr --json @here/new.exr",
        "reference ao @f.exr --scene @s.obj -o @new.exr --json @here/new.exr.partial",
        "reference ao @s.####.exr --scene @s.obj -o @new.####.exr --json @here/new.0001.exr",
        "reference ao @s.####.exr --scene @s.obj -o @new.####.exr --picture @new.####.png --json @here/new.0002.png",
        "info @f.exr --picture @new.png --json @here/new.png",
        "info @f.exr --sheet @new.png --picture @here/new.png",
        "compare @a.exr @a.exr -o @new.png --json @here/new.png",
        "compare --stereo @a.exr --anaglyph @new.png --side-by-side @here/new.png",
        "bench --frame @f.exr --truth @t.exr -o @made --techniques gtao --json @here/made/bench.json",
        "view @f.exr --no-open -o @new.html --json @here/new.html",
        "leaderboard @b -o @new.html --json @here/new.html",
        "report @b --markdown @new.md --json @here/new.md",
        "report @b --json @here/b/report.html",
        "stress hbao+ --json @new.json --markdown @here/new.json",
        "set make small -o @set --json @here/set/frames/gallery.exr"})
    expect_nothing_lost(words_of(command));
}

/// The pictures of views have names that the command line does not say.
TEST_F(WrittenFiles, NorThePicturesOfViews) {
  Frame pair = small_frame(32, 24, {"depth", "normal", "color"});
  pair.views.push_back(std::move(small_frame(32, 24, {"depth", "normal", "color"}).views[0]));
  pair.views[0].name = "left";
  pair.views[1].name = "right";
  write_frame(path("pair.exr"), pair);
  expect_nothing_lost(
      words_of("run gtao @pair.exr --radius 0.5 -o @new.exr --picture @new.png --json @./new.right.png"));
  expect_nothing_lost(words_of("auto @pair.exr -o @new.exr --explain @new.png --json @./new.right.png"));
}

/// A file of gloam's own beside the frame is no camera, and is written again.
TEST_F(WrittenFiles, WhatAnEarlierRunWroteIsWrittenAgain) {
  fs::remove(path("f.json"));
  const Arguments commands[] = {words_of("info @f.exr --fov 60 --json @f.json"),
                                words_of("run gtao @f.exr --fov 60 --radius 0.5 -o @new.exr --json @f.json"),
                                words_of("view @f.exr --fov 60 --no-open")};
  for (const Arguments& arguments : commands) {
    for (int i = 0; i < 2; ++i) {
      const Result result = gloam(arguments);
      EXPECT_EQ(result.status, 0) << result.err;
    }
  }
}

/// Whatever opens a file of the user's says so to the ledger of files (base/file_ledger.h). These few open others: gloam's own, the
/// system's, and files that `read_text` or assimp opens after them.
TEST(WhatOpensFiles, TellsTheLedger) {
  const std::map<std::string, std::string> others = {
      {"base/command_line.cpp", "the system's"},   {"base/file_lock.cpp", "gloam's own"},
      {"base/memory.cpp", "the system's"},         {"base/temporary_folder.cpp", "a folder"},
      {"cli/view/view.cpp", "an earlier page"},    {"run/device.cpp", "the system's"},
      {"measure/document.cpp", "the system's"},    {"measure/native.cpp", "the system's"},
      {"run/device_record.cpp", "gloam's own"},    {"run/effect_speeds.cpp", "gloam's own"},
      {"run/kept_folders.cpp", "gloam's own"},     {"run/kernel_cache.cpp", "gloam's own"},
      {"sequence/frame_locks.cpp", "gloam's own"}, {"stress/cases/sizes.cpp", "the system's"}};
  static const std::regex opens(R"(\bifstream\b|\bofstream\b|\bfstream [a-z]|\bfopen\(|\W::open\(|_from_file\()");
  const fs::path host = fs::path(GLOAM_SOURCE_DIR) / "host";
  int found = 0;
  for (const auto& entry : fs::recursive_directory_iterator(host)) {
    const std::string name = entry.path().lexically_relative(host).generic_string(), text = slurp(entry.path());
    if (entry.path().extension() != ".cpp" || !std::regex_search(text, opens)) continue;
    ++found;
    EXPECT_TRUE(others.count(name) || text.find("opens_file(") != std::string::npos)
        << name << " opens a file without opens_file(PATH), so that an output may be written over it";
  }
  EXPECT_GT(found, int(others.size()));
}

}  // namespace
}  // namespace gloam::test::written_files_test
