// Pipes instead of files, folders that cannot be written, drivers that cannot be loaded, images without a finite value.
#include <sys/stat.h>

#include <limits>

#include "cli/gloam_process.h"

namespace gloam::test {
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
    const Result result = gloam_within({RLIM_INFINITY, 20}, command);
    expect_refused(result, 1, name + ": is a device or a pipe; name a regular file");
  }
}

TEST_F(OddFiles, PipesThatASceneNamesAreRefusedAtOnce) {
  ASSERT_EQ(mkfifo(path("scene.mtl").c_str(), 0600), 0);
  std::ofstream(path("scene.obj")) << "mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  expect_refused(gloam_within({RLIM_INFINITY, 20}, {"capture", path("scene.obj"), "-o", path("a.exr")}), 1,
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

}  // namespace
}  // namespace gloam::test
