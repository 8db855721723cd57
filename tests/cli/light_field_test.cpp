// Light-field displays from the command line: capturing, computing, comparing, and refusals.
#include "cli/gloam_process.h"
#include "gloam/error.h"

namespace gloam::test::light_field_test {
namespace {

constexpr const char* small_display = R"({"name": "small", "observer": {"distance": 3},
  "screen": {"width": 1.6, "height": 1.2},
  "modules": {"resolution": [64, 48], "count": 6, "line": {"from": [-0.3, 0, -1.5], "to": [0.3, 0, -1.5]}}})";

constexpr const char* one_camera = R"({"width": 64, "height": 48, "fx": 60, "fy": 60, "cx": 32, "cy": 24,
  "camera_to_world": [[1,0,0,0],[0,1,0,1.5],[0,0,1,4],[0,0,0,1]]})";

class Display : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    write("small.json", small_display);
  }

  std::string file(const std::string& name) const { return path(name).string(); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }

  Result capture(const std::string& name, const Arguments& more) const {
    Arguments all = {"capture", "colonnade", "-o", file(name), "--display", file("small.json")};
    all.insert(all.end(), more.begin(), more.end());
    return gloam(all);
  }

  void expect_captured(const std::string& name, const Arguments& more = {}) const {
    const Result result = capture(name, more);
    ASSERT_EQ(result.status, 0) << result.err;
  }

  void expect_refused(const Arguments& arguments, int status, const std::vector<std::string>& words) const {
    const std::vector<std::string> before = files();
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_EQ(result.err.rfind("gloam: ", 0), 0u) << result.err;
    for (const std::string& word : words)
      EXPECT_NE(result.err.find(word), std::string::npos) << "'" << word << "' is not in: " << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(files(), before) << "a refused command leaves nothing behind";
  }
};

TEST_F(Display, EveryModuleIsAView) {
  const Result result = capture("F.exr", {"--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["size"], (nlohmann::json{64, 48}));
  const FrameFile frame(file("F.exr"), {});
  EXPECT_EQ(frame.views(), (Arguments{"module00", "module01", "module02", "module03", "module04", "module05"}));
  for (const std::string& view : frame.views()) {
    ASSERT_TRUE(frame.camera(view) && frame.camera(view)->slits) << view;
  }
  EXPECT_NEAR(frame.camera("module04")->slits->module.x, 0.18, 1e-12);
  EXPECT_NE(frame.text_attribute("gloamDisplay").find("world_to_physical"), std::string::npos)
      << "the header says which part of the world the scene's camera has chosen";
}

TEST_F(Display, SomeModulesAndAnotherSize) {
  const Result result = capture("F.exr", {"--modules", "0,3-5", "--size", "32x24", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["size"], (nlohmann::json{32, 24}));
  FrameFile some(file("F.exr"), {});
  EXPECT_EQ(some.views(), (Arguments{"module00", "module03", "module04", "module05"}));
  // Their images are the same as among all modules.
  expect_captured("all.exr", {"--size", "32x24"});
  const Frame a = some.read({"depth"}), b = FrameFile(file("all.exr"), {.views = some.views()}).read({"depth"});
  for (size_t i = 0; i < 4; ++i) {
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 32; ++x)
        ASSERT_EQ(a.views[i].planes.at("depth").channels[0].at(x, y),
                  b.views[i].planes.at("depth").channels[0].at(x, y))
            << i << ": " << x << ", " << y;
  }
}

TEST_F(Display, AFileForEachModule) {
  const Result result = capture("F.exr", {"--modules", "1,4", "--separate", "--picture", file("F.png"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["files"], (nlohmann::json{file("F.module01.exr"), file("F.module04.exr")}));
  EXPECT_EQ(files(), (Arguments{"F.module01.exr", "F.module01.png", "F.module04.exr", "F.module04.png", "small.json"}));
  const FrameFile alone(file("F.module04.exr"), {});
  EXPECT_EQ(alone.views(), Arguments{"module04"});
  EXPECT_NEAR(alone.camera("module04")->slits->module.x, 0.18, 1e-12);
}

/// The middle observer sees the camera's image.
TEST_F(Display, ShowsWhatACameraFrames) {
  write("cam.json", one_camera);
  expect_captured("F.exr", {"--camera", file("cam.json"), "--modules", "2"});
  const Camera camera = *FrameFile(file("F.exr"), {}).camera("module02");
  EXPECT_NEAR(camera.pose->position.y, 1.5, 1e-9);
  EXPECT_NEAR(camera.pose->position.z, 4, 1e-9);
}

TEST_F(Display, RunWithReuseAndCompare) {
  expect_captured("F.exr");
  const Result result = gloam({"run", "lightfield-ssao", file("F.exr"), "-o", file("O.exr"), "--set", "reuse=on",
                               "--keep-depth", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const nlohmann::json said = result.json();
  EXPECT_EQ(said["technique"], "lightfield-ssao");
  std::map<std::string, Arguments> views;
  for (const auto& pass : said["passes"]) views[pass["name"]].push_back(pass["view"]);
  // Every fourth view is a key view, and the last one, which would be too far from one.
  EXPECT_EQ(views["lightfield-ssao/estimate"], (Arguments{"module02", "module05"}));
  EXPECT_EQ(views["lightfield-ssao/reuse"], (Arguments{"module00", "module01", "module03", "module04"}));
  EXPECT_EQ(views["lightfield-ssao/newly visible"], views["lightfield-ssao/reuse"]);
  const size_t last = said["passes"].size() - 1;
  EXPECT_EQ(said["passes"][last]["view"], "module05") << "in the order of the views";
  // From the result alone: it has depths and cameras.
  const Result compared = gloam({"compare", "--stereo", file("O.exr"), "--views", "module02,module03", "--json", "-"});
  ASSERT_EQ(compared.status, 0) << compared.err;
  EXPECT_EQ(compared.json()["views"], (nlohmann::json{"module02", "module03"}));
  EXPECT_GT(compared.json()["pixels"], 2 * 64 * 48 * 0.7) << "the views see the same surfaces";
  EXPECT_LT(compared.json()["inconsistency"]["mean"], 0.05);
}

/// With many views each pass has one line.
TEST_F(Display, TimesAreSummedOverManyViews) {
  expect_captured("F.exr");
  const Result all = gloam({"run", "lightfield-ssao", file("F.exr"), "-o", file("O.exr"), "--set", "reuse=on"});
  ASSERT_EQ(all.status, 0) << all.err;
  EXPECT_NE(all.out.find("6 views"), std::string::npos) << all.out;
  EXPECT_NE(all.out.find("2 of them  lightfield-ssao/estimate"), std::string::npos) << all.out;
  EXPECT_NE(all.out.find("4 of them  lightfield-ssao/reuse"), std::string::npos) << all.out;
  const Result some = gloam({"run", "lightfield-ssao", file("F.exr"), "-o", file("P.exr"), "--views",
                             "module00,module03", "--set", "reuse=off"});
  ASSERT_EQ(some.status, 0) << some.err;
  EXPECT_NE(some.out.find("module03  lightfield-ssao/estimate"), std::string::npos) << some.out;
}

TEST_F(Display, ViewsInAnyOrder) {
  expect_captured("F.exr");
  const auto run = [&](const std::string& views, const std::string& out) {
    const Result result = gloam({"run", "lightfield-hbao+", file("F.exr"), "-o", file(out), "--views", views, "--set",
                                 "reuse=on", "--set", "key_views=2"});
    ASSERT_EQ(result.status, 0) << result.err;
  };
  run("module05,module04,module03", "reversed.exr");
  EXPECT_EQ(FrameFile(file("reversed.exr"), {}).views(), (Arguments{"module05", "module04", "module03"}));
  run("module01", "alone.exr");
  EXPECT_EQ(FrameFile(file("alone.exr"), {}).views(), Arguments{"module01"});
}

TEST_F(Display, InfoSaysWhichDisplayAndWhatRuns) {
  expect_captured("F.exr", {"--modules", "1"});
  const Result text = gloam({"info", file("F.exr")});
  ASSERT_EQ(text.status, 0) << text.err;
  EXPECT_NE(text.out.find("module of display 'small', header"), std::string::npos) << text.out;
  const nlohmann::json said = gloam({"info", file("F.exr"), "--json", "-"}).json();
  EXPECT_EQ(said["camera"]["type"], "two slits");
  EXPECT_EQ(said["camera"]["display"], "small");
  EXPECT_NEAR(said["camera"]["module"][0], -0.18, 1e-12);
  EXPECT_EQ(said["camera"]["observer_distance"], 3);
  const Arguments runs = said["runs"];
  const auto can = [&](const char* name) { return std::find(runs.begin(), runs.end(), name) != runs.end(); };
  EXPECT_TRUE(can("lightfield-ssao") && can("lightfield-hbao+") && can("positions"));
  EXPECT_FALSE(can("hbao+") || can("gtao") || can("normals"));
  EXPECT_EQ(said["lacks"]["hbao+"], Arguments{"cameras with one eye"});
  const Result each = gloam({"info", file("F.exr"), "--lacks"});
  EXPECT_NE(each.out.find("lacks  hbao+: cameras with one eye"), std::string::npos) << each.out;
}

/// AO is called for, by a technique that supports such views; reflections have none.
TEST_F(Display, AutoComputesWhatItsViewsAllow) {
  expect_captured("F.exr");
  const Result result = gloam({"auto", file("F.exr"), "-o", file("O.exr"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const FrameFile written(file("O.exr"), {});
  EXPECT_EQ(written.views().size(), 6u);
  EXPECT_TRUE(written.camera("module03")->slits) << "the cameras travel";
  const Arguments planes = written.common_planes();
  EXPECT_NE(std::find(planes.begin(), planes.end(), "ao"), planes.end());
  const nlohmann::json effects = result.json()["effects"];
  EXPECT_EQ(effects[0]["runs"], "lightfield-ssao");
  EXPECT_GT(effects.size(), 3u);
  for (size_t i = 1; i < effects.size(); ++i) {
    EXPECT_EQ(effects[i]["runs"], nullptr) << effects[i];
    EXPECT_NE(effects[i]["why"].get<std::string>().find("a single centre of projection"), std::string::npos);
  }
}

TEST_F(Display, ReferenceAndItsError) {
  expect_captured("F.exr", {"--modules", "2,3"});
  const Result reference = gloam({"reference", "ao", file("F.exr"), "-o", file("R.exr"), "--samples", "64"});
  ASSERT_EQ(reference.status, 0) << reference.err;
  const auto error_of = [&](const char* radius) {
    EXPECT_EQ(gloam({"run", "lightfield-ssao", file("F.exr"), "-o", file("O.exr"), "--radius", radius}).status, 0);
    const Result compared = gloam({"compare", file("O.exr"), file("R.exr"), "--json", "-"});
    EXPECT_EQ(compared.status, 0) << compared.err;
    return compared.json()["rmse"].get<double>();
  };
  EXPECT_LT(error_of("0.6"), 0.75 * error_of("0")) << "without a radius nothing is occluded";
}

/// Other techniques need a single centre of projection.
TEST_F(Display, OtherTechniquesRefuseItsViews) {
  expect_captured("F.exr", {"--modules", "1-3"});
  for (const char* technique : {"hbao+", "gtao", "ssao", "normals", "corner-mask"})
    expect_refused({"run", technique, file("F.exr"), "-o", file("O.exr")}, 1,
                   {technique, "view 'module01'", "light-field display", "lightfield-hbao+ and lightfield-ssao"});
  expect_refused({"run", "stereo-ao", file("F.exr"), "-o", file("O.exr"), "--views", "module02,module03"}, 1,
                 {"stereo-ao", "view 'module02'", "light-field display"});
  for (const char* depth : {"ray", "ndc", "reversed"})
    expect_refused({"run", "lightfield-ssao", file("F.exr"), "-o", file("O.exr"), "--depth", depth}, 2,
                   {"F.exr", "--depth"});
  // A technique that could run lacks normals, which cannot be made from such views.
  expect_refused({"run", "lightfield-ssao", file("F.exr"), "-o", file("O.exr"), "--plane", "normal=none"}, 1,
                 {"lightfield-ssao", "normals needs one", "a frame with normal"});
  // Nor can other requests be met.
  const auto beside = [&](const Arguments& more, const std::string& what) {
    Arguments all = {"run", "lightfield-ssao", file("F.exr"), "-o", file("O.exr")};
    all.insert(all.end(), more.begin(), more.end());
    expect_refused(all, 1, {"lightfield-ssao", what + " needs one; leave it out"});
  };
  beside({"--filter", "bilateral"}, "bilateral");
  beside({"--only", "corner-mask"}, "corner-mask");
  beside({"--resolution", "half"}, "what --resolution or --adaptive adds");
  beside({"--adaptive", "low"}, "what --resolution or --adaptive adds");
}

/// A plane as mask needs no single centre of projection.
TEST_F(Display, OnlyWhereAPlaneWantsIt) {
  expect_captured("F.exr", {"--modules", "1"});
  ASSERT_EQ(gloam({"run", "lightfield-ssao", file("F.exr"), "-o", file("O.exr"), "--only", "roughness"}).status, 0);
}

TEST_F(Display, ReuseHasOneTechnique) {
  expect_captured("F.exr", {"--modules", "1-3"});
  expect_refused({"run", "lightfield-ssao", file("F.exr"), "-o", file("O.exr"), "--only", "roughness", "--elsewhere",
                  "lightfield-hbao+", "--set", "lightfield-ssao.reuse=on"},
                 2, {"--elsewhere lightfield-hbao+", "reuse=on"});
}

TEST_F(Display, WrongModules) {
  const auto refused = [&](const std::string& modules, const std::vector<std::string>& words) {
    expect_refused({"capture", "colonnade", "-o", file("F.exr"), "--display", file("small.json"), "--modules", modules},
                   2, words);
  };
  refused("4-2", {"--modules", "2", "from 4 to 5"});
  refused("9-3", {"--modules 9", "from 0 to 5"});
  refused("6", {"--modules 6", "from 0 to 5"});
  refused("0-6", {"--modules 6", "from 0 to 5"});
  refused("1,1", {"--modules 1,1", "module 1 twice"});
  refused("0-2,2", {"--modules 0-2,2", "module 2 twice"});
  refused("left", {"--modules left"});
  refused("2-", {"--modules"});
  refused("-1", {"--modules"});
}

TEST_F(Display, FlagsThatDoNotGoTogether) {
  const Arguments capture = {"capture", "colonnade", "-o", file("F.exr")};
  const auto refused = [&](const Arguments& more, const std::vector<std::string>& words) {
    Arguments all = capture;
    all.insert(all.end(), more.begin(), more.end());
    expect_refused(all, 2, words);
  };
  refused({"--modules", "1"}, {"--modules", "--display FILE"});
  refused({"--separate"}, {"--separate", "--display FILE"});
  refused({"--display", file("small.json"), "--stereo", "0.1"}, {"--stereo and --display"});
  refused({"--display", file("small.json"), "--view2", "10"}, {"--view2 and --display"});
  nlohmann::json placed = nlohmann::json::parse(small_display);
  placed["region_of_interest"] = {{"physical", {{"size", {1.6, 1.2, 1}}}}, {"world", {{"size", {8, 6, 5}}}}};
  write("placed.json", placed.dump());
  refused({"--display", file("placed.json"), "--eye", "0,1,2"}, {"placed.json", "leave out --camera, --eye"});
  refused({"--display", file("placed.json"), "--shot", "dolly"}, {"placed.json", "leave out --shot"});
}

TEST_F(Display, ACameraIsNoDisplay) {
  write("cam.json", one_camera);
  expect_refused({"capture", "colonnade", "-o", file("F.exr"), "--display", file("cam.json")}, 1,
                 {"cam.json", "no field of a display", "observer, screen, modules"});
  expect_refused({"capture", "colonnade", "-o", file("F.exr"), "--camera", file("small.json")}, 1,
                 {"small.json", "light-field display", "--display"});
  expect_refused({"capture", "colonnade", "-o", file("F.exr"), "--display", file("none.json")}, 1, {"none.json"});
  write("broken.json", "{\"observer\": {\"distance\": NaN}}");
  expect_refused({"capture", "colonnade", "-o", file("F.exr"), "--display", file("broken.json")}, 1,
                 {"broken.json: observer.distance is not finite"});
}

TEST_F(Display, AnOldFileTakesItsDisplayFromAFlag) {
  Frame frame = small_frame(16, 12, {"depth", "normal"});
  frame.views[0].name = "module03";
  frame.views[0].camera.reset();
  write_frame(path("old.exr"), frame);
  nlohmann::json placed = nlohmann::json::parse(small_display);
  placed["world_to_physical"]["linear"] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  write("placed.json", placed.dump());
  const Result result = gloam({"run", "lightfield-ssao", file("old.exr"), "-o", file("O.exr"), "--camera",
                               file("placed.json"), "--radius", "1"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NEAR(FrameFile(file("O.exr"), {}).camera("module03")->slits->module.x, 0.06, 1e-12);
  expect_refused({"run", "normals", file("old.exr"), "-o", file("O.exr"), "--camera", file("small.json")}, 1,
                 {"small.json", "does not say which part of the world"});
}

TEST_F(Display, ADamagedHeaderIsToldInOneLine) {
  expect_captured("F.exr", {"--modules", "1", "--size", "16x12"});
  std::string bytes = slurp(path("F.exr"));
  const size_t at = bytes.find("\"distance\"");
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, 10, "\"disdance\"");
  std::ofstream(path("F.exr"), std::ios::binary) << bytes;
  expect_refused({"run", "normals", file("F.exr"), "-o", file("O.exr")}, 1,
                 {"F.exr: attribute gloamDisplay: observer.disdance is no field", "did you mean 'distance'"});
}

}  // namespace
}  // namespace gloam::test::light_field_test
