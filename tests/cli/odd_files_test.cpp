// Pipes instead of files, folders that cannot be written, drivers that cannot be loaded, images without a finite value.
#include <sys/stat.h>
#include <unistd.h>

#include <limits>

#include "cli/gloam_process.h"

namespace gloam::test::odd_files_test {
namespace {

class OddFiles : public Cli {
 protected:
  void expect_refused(const Result& result, int status, const std::string& says) const {
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
  }
};

/// A command that waited for the pipe's other end would be ended by the limit, with another status.
TEST_F(OddFiles, PipesAreRefusedAtOnce) {
  for (const char* name : {"scene.obj", "scene.gltf", "scene.glb", "camera.json", "display.json", "frame.exr"})
    ASSERT_EQ(mkfifo(path(name).c_str(), 0600), 0);
  const std::map<std::string, Arguments> commands = {
      {"scene.obj", {"capture", path("scene.obj"), "-o", path("a.exr")}},
      {"scene.gltf", {"capture", path("scene.gltf"), "-o", path("a.exr")}},
      {"scene.glb", {"capture", path("scene.glb"), "-o", path("a.exr")}},
      {"camera.json", {"run", "normals", loggia, "-o", path("a.exr"), "--camera", path("camera.json")}},
      {"display.json", {"capture", "plane", "-o", path("a.exr"), "--display", path("display.json")}},
      {"frame.exr", {"info", path("frame.exr")}}};
  for (const auto& [name, command] : commands) {
    const Result result = gloam_within({RLIM_INFINITY, 300}, command);
    expect_refused(result, 1, name + ": is a device or a pipe; name a regular file");
  }
}

TEST_F(OddFiles, PipesThatASceneNamesAreRefusedAtOnce) {
  ASSERT_EQ(mkfifo(path("scene.mtl").c_str(), 0600), 0);
  std::ofstream(path("scene.obj")) << "mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  expect_refused(gloam_within({RLIM_INFINITY, 300}, {"capture", path("scene.obj"), "-o", path("a.exr")}), 1,
                 "scene.mtl: is a device or a pipe");
}

TEST_F(OddFiles, AFolderForKernelsIsNeverMadeWhereOneStands) {
  const std::string here = path("here").string();
  fs::create_directory(here);
  const std::string command = "cd '" + here +
                              "' && env -u HOME -u POCL_CACHE_DIR -u XDG_CACHE_HOME TMPDIR=/nonexistent/x '" + program +
                              "' run normals '" + loggia + "' -o ../normal.exr >/dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(fs::is_empty(here)) << fs::directory_iterator(here)->path();
}

TEST_F(OddFiles, ADriverThatCannotBeLoadedIsToldWithItsCause) {
  fs::create_directory(path("vendors"));
  std::ofstream(path("vendors/own.icd")) << path("libgone.so").string() << "\n";
  expect_refused(gloam({"run", "normals", loggia, "-o", path("a.exr")}, {{"OCL_ICD_VENDORS", path("vendors")}}), 1,
                 "libgone.so: cannot open shared object file");
}

TEST_F(OddFiles, ComparingWhatIsNoNumberNamesTheFile) {
  Frame frame = small_frame();
  frame.views[0].planes["depth"].channels[0].at(3, 2) = std::numeric_limits<float>::quiet_NaN();
  Plane ao = std::move(frame.views[0].planes.at("depth"));
  ao.name = "ao";
  frame.views[0].planes.clear();
  frame.views[0].planes["ao"] = std::move(ao);
  write_frame(path("test.exr"), frame);
  const Result result = gloam({"compare", path("test.exr"), path("test.exr")});
  expect_refused(result, 1, path("test.exr").string() + " against " + path("test.exr").string());
  expect_refused(result, 1, "the test image is nan at pixel (3, 2)");
}

/// Line ends and a terminal's commands in every name that a command takes: each line of the output begins with a word of gloam's.
TEST_F(OddFiles, NamesWithControlCharactersStayOnTheirLine) {
  const std::string odd = "odd\nHACK \x1b[31m";
  fs::create_directory(path(odd));
  const auto in = [&](const char* name) { return path(odd + "/" + odd + name).string(); };
  for (const char* name : {"a.exr", "shot.0001.exr", "shot.0002.exr"}) write_frame(in(name), small_frame());
  ASSERT_EQ(gloam({"run", "ssao", in("a.exr"), "-o", in("ao.exr"), "--radius", "0.5"}).status, 0);
  const std::vector<Arguments> commands = {
      {"info", in("a.exr"), "--lacks"},
      {"info", in("shot.####.exr")},
      {"plan", "ao", in("a.exr")},
      {"run", "ssao", in("a.exr"), "-o", in("b.exr"), "--radius", "0.5"},
      {"run", "ssao", in("shot.####.exr"), "-o", in("s.####.exr"), "--radius", "0.5"},
      {"compare", in("ao.exr"), in("b.exr")},
      {"view", in("a.exr"), "-o", in("v.html")},
      {"auto", in("a.exr"), "-o", in("c.exr"), "--radius", "0.5"},
      {"report", in("none")},
      {"leaderboard", path(odd)},
      {"set", "verify", path(odd)},
      {"score", in("b.exr"), "--frame", in("a.exr"), "--truth", in("ao.exr"), "--json", in("none.json"), "-o",
       in("out")},
      {"capture", in("none.obj"), "-o", in("d.exr")},
      {"run", odd, in("a.exr"), "-o", in("e.exr")},
      {"run", "ssao", in("shot.####.exr"), "-o", in("s.####.exr"), "--radius", "0.5", "--chunks", "2", "--print"}};
  for (const Arguments& command : commands) {
    const Result result = gloam(command);
    for (const std::string& text : {result.out, result.err}) {
      EXPECT_EQ(text.find('\x1b'), std::string::npos) << command[0] << ": " << text;
      EXPECT_EQ(text.find("\nHACK"), std::string::npos) << command[0] << ": " << text;
      EXPECT_NE(text.rfind("HACK", 0), 0u) << command[0] << ": " << text;
    }
  }
}

TEST_F(OddFiles, ChunksOfAFolderOfAnyNameRunInAnyShell) {
  const std::string odd = "nl\n touch HACKED #";
  fs::create_directory(path(odd));
  for (const char* name : {"shot.0001.exr", "shot.0002.exr"}) write_frame(path(odd + "/" + name), small_frame());
  const Arguments words = {"run", "normals", "shot.####.exr", "-o", "n.####.exr", "-q", "--chunks", "2", "--print"};
  fs::current_path(path(odd));
  const Result printed = gloam(words);
  fs::current_path("/");
  ASSERT_EQ(printed.status, 0) << printed.err;
  EXPECT_EQ(std::count(printed.out.begin(), printed.out.end(), '\n'), 2) << printed.out;
  std::ofstream(path("chunks")) << printed.out;
  EXPECT_EQ(std::system(("sh '" + path("chunks").string() + "' >/dev/null").c_str()), 0);
  EXPECT_TRUE(fs::exists(path(odd + "/n.0001.exr")));
  EXPECT_TRUE(fs::exists(path(odd + "/n.0002.exr")));
  EXPECT_FALSE(fs::exists(path(odd + "/HACKED")));
}

/// As root runs a command in the folder of a user who put code where root's is kept.
TEST_F(OddFiles, KernelsOfSomebodyElseAreNotRun) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a folder away";
  fs::permissions(folder, fs::perms(0755));
  fs::create_directory(path("home"));
  ASSERT_EQ(chown(path("home").c_str(), 65534, 65534), 0);
  fs::create_directory(path("tmp"));
  const std::map<std::string, std::string> environment = {{"HOME", path("home")},
                                                          {"XDG_CACHE_HOME", ""},
                                                          {"POCL_CACHE_DIR", ""},
                                                          {"GLOAM_CACHE_DIR", ""},
                                                          {"TMPDIR", path("tmp")}};
  for (int run = 0; run < 2; ++run) {
    const Result result = gloam({"run", "normals", loggia, "-o", path("n.exr")}, environment);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err.find("note: " + path("home").string() + " belongs to user "), 0u) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_TRUE(fs::is_empty(path("home"))) << fs::directory_iterator(path("home"))->path();
    EXPECT_EQ(std::distance(fs::directory_iterator(path("tmp")), {}), 1);  // the same for all processes
  }
  EXPECT_EQ(gloam({"info", loggia}, environment).err.find("belongs"), std::string::npos);
}

TEST_F(OddFiles, NothingIsLeftAmongTheKernels) {
  fs::create_directory(path("cache"));
  const std::map<std::string, std::string> environment = {{"POCL_CACHE_DIR", path("cache")}};
  for (int run = 0; run < 2; ++run)
    EXPECT_EQ(gloam({"run", "normals", loggia, "-o", path("n.exr")}, environment).status, 0);
  for (const auto& entry : fs::directory_iterator(path("cache")))
    EXPECT_NE(entry.path().filename().string().rfind("tempfile_", 0), 0u) << entry.path();
}

/// A command that is interrupted leaves nothing in the folder for temporary files.
TEST_F(OddFiles, AnInterruptedCommandRemovesItsTemporaryFolder) {
  fs::create_directory(path("tmp"));
  const pid_t child = start({"pick", loggia, "--budget", "20ms"}, {{"TMPDIR", path("tmp")}});
  const auto count = [&] { return std::distance(fs::directory_iterator(path("tmp")), {}); };
  for (int i = 0; i < 3000 && count() == 0; ++i) usleep(10'000);
  EXPECT_EQ(count(), 1);
  kill(child, SIGINT);
  EXPECT_EQ(finish(child).status, 128 + SIGINT);
  EXPECT_EQ(count(), 0) << fs::directory_iterator(path("tmp"))->path();
}

TEST_F(OddFiles, APipeWhereARecordIsExpectedIsReplaced) {
  fs::create_directory(path("cache"));
  const std::map<std::string, std::string> environment = {{"GLOAM_CACHE_DIR", path("cache")}};
  ASSERT_EQ(gloam({"auto", loggia, "-o", path("a.exr"), "--budget", "1s"}, environment).status, 0);
  std::vector<fs::path> kept;
  for (const auto& entry : fs::recursive_directory_iterator(path("cache"))) {
    if (entry.is_regular_file()) kept.push_back(entry.path());
  }
  ASSERT_FALSE(kept.empty());
  for (const fs::path& file : kept) {
    fs::remove(file);
    ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  }
  const Result result =
      finish(start({"auto", loggia, "-o", path("a.exr"), "--budget", "1s"}, environment, {RLIM_INFINITY, 100}));
  EXPECT_EQ(result.status, 0) << result.err;
  for (const fs::path& file : kept) EXPECT_TRUE(fs::is_regular_file(file)) << file;
}

TEST_F(OddFiles, KeysOfAMillionLettersAreToldInALine) {
  const std::string million(1'000'000, 'k');
  std::ofstream(path("entry.json")) << "{\"name\": \"m\", \"" << million << "\": 1}";
  std::ofstream(path("bench.json")) << "{\"results\": [{\"" << million << "\": \"" << million;
  write_frame(path("a.exr"), small_frame());
  const auto in_short = [&](const Arguments& words) {
    const Result result = gloam_within({RLIM_INFINITY, 60}, words);
    EXPECT_NE(result.status, 0);
    EXPECT_EQ(result.lines_of_error(), 1) << result.err.substr(0, 200);
    EXPECT_LT(result.err.size(), 4200u);
    EXPECT_EQ(result.err.find("json.exception"), std::string::npos) << result.err.substr(0, 200);
  };
  in_short({"score", path("a.exr"), "--frame", path("a.exr"), "--truth", path("a.exr"), "--json", path("entry.json"),
            "-o", path("out")});
  in_short({"report", folder.string()});
  in_short({"leaderboard", folder.string()});
  in_short({"run", std::string(100'000, 'k'), path("a.exr"), "-o", path("b.exr")});
  in_short({"run", "ssao", path("a.exr"), "-o", path("b.exr"), "--set", std::string(100'000, 'k') + "=1"});
}

}  // namespace
}  // namespace gloam::test::odd_files_test
