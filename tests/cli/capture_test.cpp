// gloam capture and gloam reference, as a user runs them.
#include <cmath>

#include "base/lists.h"
#include "cli/gloam_process.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::test::capture_test {
namespace {

class CaptureCommand : public Cli {
 protected:
  std::string file(const std::string& name) const { return path(name).string(); }

  void expect_refused(const Arguments& arguments, int status, const std::string& says) {
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(files().empty()) << "a refused command leaves nothing behind";
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }
};

TEST_F(CaptureCommand, WritesEveryPlane) {
  const Result result = gloam({"capture", "plane", "-o", file("p.exr"), "--size", "64x36", "--tilt", "30", "--peel",
                               "3", "--picture", file("p.png"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["scene"], "plane: tilt=30");
  EXPECT_EQ(result.json()["faces"], 8192);
  EXPECT_EQ(result.json()["size"], nlohmann::json({64, 36}));
  EXPECT_EQ(result.json()["layers"]["mean"], 1);
  const nlohmann::json info = gloam({"info", file("p.exr"), "--json", "-"}).json();
  std::vector<std::string> planes;
  for (const auto& plane : info["planes"]) planes.push_back(plane["name"]);
  for (const char* plane : {"depth", "normal", "albedo", "color", "roughness", "reflectance", "position", "back_depth",
                            "instance", "peel_count", "peel.00", "peel.02"})
    EXPECT_TRUE(std::find(planes.begin(), planes.end(), plane) != planes.end()) << plane << " in " << info["planes"];
  for (const char* plane : {"motion", "ambient", "metallic", "emission"})
    EXPECT_TRUE(std::find(planes.begin(), planes.end(), plane) == planes.end()) << plane << " is written unasked";
  EXPECT_EQ(info["camera"]["source"], "scene camera 'main'") << info["camera"];
  EXPECT_EQ(files(), (std::vector<std::string>{"p.exr", "p.png"}));
}

TEST_F(CaptureCommand, AmbientLightAndWhatColourHolds) {
  ASSERT_EQ(gloam({"capture", "gallery", "-o", file("g.exr"), "--size", "48x27", "--planes", "color,ambient,metallic"})
                .status,
            0);
  FrameFile frame(file("g.exr"), {});
  EXPECT_EQ(frame.common_planes(), (std::vector<std::string>{"depth", "color", "ambient", "metallic"}));
  EXPECT_EQ(frame.text_attribute("gloamColorHolds"), "ambient,shadows");
  ASSERT_EQ(gloam({"capture", "gallery", "-o", file("n.exr"), "--size", "48x27", "--planes", "normal,ambient"}).status,
            0);
  EXPECT_EQ(FrameFile(file("n.exr"), {}).text_attribute("gloamColorHolds"), "") << "has no colour";
}

TEST_F(CaptureCommand, EyeAndTargetOverTheScenesCamera) {
  ASSERT_EQ(gloam({"capture", "plane", "-o", file("p.exr"), "--size", "33x33", "--tilt", "0", "--eye", "0,0,7.5",
                   "--target", "0,0,0", "--fov", "30", "--planes", "depth"})
                .err,
            "");
  FrameFile frame(file("p.exr"), {});
  const Camera camera = *frame.camera("");
  EXPECT_NEAR(camera.fx, 33 / 2.0 / std::tan(15 * M_PI / 180), 1e-3);
  EXPECT_NEAR(camera.pose->position.z, 7.5, 1e-6);
  EXPECT_NEAR(frame.read({"depth"}).views[0].planes.at("depth").channels[0].at(16, 16), 7.5, 1e-5);
  EXPECT_EQ(frame.common_planes(), std::vector<std::string>{"depth"});
}

TEST_F(CaptureCommand, TwoViewsFromACameraFile) {
  write("pair.camera.json", R"({"width": 64, "height": 36, "fx": 60, "fy": 60, "cx": 32, "cy": 18, "views": [
    {"view": "left", "camera_to_world": [[1,0,0,-0.05],[0,1,0,0],[0,0,1,4],[0,0,0,1]]},
    {"view": "right", "cx": 30, "camera_to_world": [[1,0,0,0.05],[0,1,0,0],[0,0,1,4],[0,0,0,1]]}]})");
  ASSERT_EQ(gloam({"capture", "plane", "-o", file("pair.exr"), "--size", "64x36", "--camera", file("pair.camera.json"),
                   "--planes", "depth,normal"})
                .err,
            "");
  FrameFile frame(file("pair.exr"), {});
  EXPECT_EQ(frame.views(), (std::vector<std::string>{"left", "right"}));
  EXPECT_NEAR(frame.camera("right")->cx, 30, 1e-4);
}

TEST_F(CaptureCommand, APathGivesOneFramePerCameraWithMotion) {
  write("path.json", R"({"width": 64, "height": 36, "fx": 60, "fy": 60, "cx": 32, "cy": 18, "frames": 3, "path": [
    {"camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]]},
    {"camera_to_world": [[1,0,0,1],[0,1,0,0],[0,0,1,4],[0,0,0,1]]}]})");
  ASSERT_EQ(gloam({"capture", "plane", "--tilt", "0", "-o", file("walk.exr"), "--size", "64x36", "--camera-path",
                   file("path.json"), "--planes", "depth"})
                .err,
            "");
  EXPECT_EQ(files(), (std::vector<std::string>{"path.json", "walk.0001.exr", "walk.0002.exr", "walk.0003.exr"}));
  FrameFile second(file("walk.0002.exr"), {});
  EXPECT_NEAR(second.camera("")->pose->position.x, 0.5, 1e-6) << "halfway";
  const Frame frame = second.read({"motion"});
  EXPECT_NEAR(frame.views[0].planes.at("motion").channels[0].at(40, 20), 0.5 * 60 / 4, 1e-3)
      << "from further left, it was further right";
  EXPECT_NEAR(FrameFile(file("walk.0001.exr"), {}).read({"motion"}).views[0].planes.at("motion").channels[0].at(40, 20),
              0, 1e-6);
}

TEST_F(CaptureCommand, StochasticDepth) {
  const Result result = gloam({"capture",
                               "fence",
                               "-o",
                               file("f.exr"),
                               "--size",
                               "64x36",
                               "--planes",
                               "normal",
                               "--stochastic",
                               "4",
                               "--stochastic-surfaces",
                               "all",
                               "--stochastic-subset",
                               "stratified",
                               "--alpha",
                               "0.3",
                               "--stochastic-seed",
                               "7",
                               "--json",
                               "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["stochastic"], nlohmann::json({{"samples", 4},
                                                         {"surfaces", "all"},
                                                         {"subset", "stratified"},
                                                         {"alpha", 0.3},
                                                         {"seed", 7},
                                                         {"radius", nullptr},
                                                         {"max_reach", nullptr}}));
  const double chosen = result.json()["seconds"]["stochastic"], traced = result.json()["seconds"]["trace"];
  EXPECT_GT(chosen, 0);
  EXPECT_LT(chosen, traced) << "a part of it";
  EXPECT_EQ(result.json()["view2"], nullptr);
  FrameFile frame(file("f.exr"), {});
  EXPECT_EQ(frame.common_planes(), (std::vector<std::string>{"depth", "normal", "stochastic.00", "stochastic.01",
                                                             "stochastic.02", "stochastic.03"}));
  EXPECT_EQ(frame.number_attribute("gloamStochasticAlpha"), double(0.3f));
  EXPECT_EQ(frame.text_attribute("gloamStochasticSeed"), "7");
  EXPECT_EQ(frame.text_attribute("gloamStochasticSurfaces"), "all");
  EXPECT_EQ(frame.text_attribute("gloamStochasticSubset"), "stratified");
  EXPECT_EQ(gloam({"run", "sd-hbao+", file("f.exr"), "-o", file("ao.exr")}).status, 0) << "of use as it is";
}

TEST_F(CaptureCommand, TheUsualStochasticMapHoldsTheNearestHiddenSurfaces) {
  const Result result = gloam({"capture", "fence", "-o", file("f.exr"), "--size", "64x36", "--planes", "normal",
                               "--peel", "3", "--stochastic", "2", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["stochastic"], nlohmann::json({{"samples", 2},
                                                         {"surfaces", "hidden"},
                                                         {"subset", "nearest"},
                                                         {"alpha", nullptr},
                                                         {"seed", nullptr},
                                                         {"radius", nullptr},
                                                         {"max_reach", nullptr}}));
  FrameFile file_of_map(file("f.exr"), {});
  EXPECT_EQ(file_of_map.text_attribute("gloamStochasticSurfaces"), "hidden");
  EXPECT_EQ(file_of_map.text_attribute("gloamStochasticSubset"), "nearest");
  const Frame frame = file_of_map.read({"depth", "stochastic.00", "peel.01", "peel.02"});
  int held = 0;
  for (int y = 0; y < 36; ++y) {
    for (int x = 0; x < 64; ++x) {
      const auto at = [&](const char* plane) { return frame.views[0].planes.at(plane).channels[0].at(x, y); };
      if (is_background(at("stochastic.00"))) continue;
      ++held;
      EXPECT_GT(at("stochastic.00"), at("depth"));
      EXPECT_EQ(at("stochastic.00"), at(at("peel.01") > at("depth") ? "peel.01" : "peel.02"));
    }
  }
  EXPECT_GT(held, 100);
}

TEST_F(CaptureCommand, TheStochasticMapIsWhatTheTechniqueMakesOfTheLayers) {
  ASSERT_EQ(
      gloam({"capture", "fence", "-o", file("layers.exr"), "--size", "64x36", "--planes", "depth", "--peel", "64"})
          .status,
      0);
  std::vector<std::string> samples;
  for (int i = 0; i < 8; ++i) samples.push_back(layer_name("stochastic", i));
  for (const auto& [of_capture, of_run] : std::initializer_list<std::pair<Arguments, Arguments>>{
           {{}, {}},
           {{"--stochastic-surfaces", "all", "--stochastic-subset", "stratified", "--stochastic-seed", "9"},
            {"--surfaces", "all", "--subset", "stratified", "--seed", "9"}}}) {
    Arguments capture = {"capture", "fence",    "-o",    file("f.exr"),  "--size",
                         "64x36",   "--planes", "depth", "--stochastic", "8"},
              run = {"run", "stochastic-depth", file("layers.exr"), "-o", file("made.exr"), "--samples", "8"};
    capture.insert(capture.end(), of_capture.begin(), of_capture.end());
    run.insert(run.end(), of_run.begin(), of_run.end());
    ASSERT_EQ(gloam(capture).status, 0);
    ASSERT_EQ(gloam(run).status, 0);
    Frame captured = FrameFile(file("f.exr"), {}).read(samples);
    const Frame made = FrameFile(file("made.exr"), {}).read(samples);
    EXPECT_EQ(plane_names(captured).size(), 8u);
    EXPECT_TRUE(same_bits(captured, made));
    captured.views[0].planes.at("stochastic.00").channels[0].at(30, 20) = -1;
    EXPECT_FALSE(same_bits(captured, made));
  }
}

TEST_F(CaptureCommand, ASecondView) {
  const Result result = gloam({"capture", "fence", "-o", file("f.exr"), "--size", "64x36", "--stochastic", "2",
                               "--peel", "2", "--view2", "-30", "--picture", file("f.png"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const nlohmann::json second = result.json()["view2"];
  EXPECT_EQ(second["degrees"], -30);
  EXPECT_LT(second["nearest"], second["median"]);
  EXPECT_LT(second["median"], second["farthest"]);
  EXPECT_LE(double(second["degrees_across"]), 120);
  EXPECT_EQ(files(), (std::vector<std::string>{"f.exr", "f.main.png", "f.view2.png"}));
  FrameFile frame(file("f.exr"), {});
  EXPECT_EQ(frame.views(), (std::vector<std::string>{"main", "view2"}));
  EXPECT_EQ(frame.number_attribute("gloamSecondView"), -30);
  const std::vector<std::string> planes = frame.common_planes();
  for (const char* plane : {"depth", "color", "back_depth", "position", "peel_count", "peel.01", "stochastic.01"})
    EXPECT_TRUE(std::find(planes.begin(), planes.end(), plane) != planes.end()) << plane;
  const Pose first = *frame.camera("main")->pose, turned = *frame.camera("view2")->pose;
  EXPECT_LT((first.world_to_view * (turned.position - first.position)).x, 0) << "to the left";
}

TEST_F(CaptureCommand, MultiviewWorksOnTheViewNamedFirst) {
  ASSERT_EQ(gloam({"capture", "fence", "-o", file("f.exr"), "--size", "64x36", "--planes", "depth,normal",
                   "--stochastic", "4", "--view2", "30"})
                .status,
            0);
  const auto ao_of = [&](const std::string& views) {
    EXPECT_EQ(gloam({"run", "multiview", file("f.exr"), "-o", file("ao.exr"), "--views", views}).status, 0) << views;
    FrameFile written(file("ao.exr"), {});
    EXPECT_EQ(written.views(), std::vector<std::string>{views.substr(0, views.find(','))});
    return written.read({"ao"});
  };
  const Frame first = ao_of("main,view2");
  Frame second = ao_of("view2,main");
  second.views[0].name = "main";
  EXPECT_FALSE(same_bits(first, second));
  EXPECT_EQ(gloam({"info", file("f.exr"), "--views", "view2,main", "--json", "-"}).json()["views"],
            nlohmann::json({"view2", "main"}));
}

TEST_F(CaptureCommand, ASecondViewOfAnOrthographicCamera) {
  write("flat.json", R"({"width": 64, "height": 36, "view": "plan", "camera_type": "ORTHO", "pixels_per_unit": 12,
    "cx": 32, "cy": 18, "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]]})");
  const Result result = gloam({"capture", "plane", "--tilt", "20", "-o", file("p.exr"), "--size", "64x36", "--camera",
                               file("flat.json"), "--view2", "45", "--planes", "normal", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_GT(double(result.json()["view2"]["units_across"]), 0);
  EXPECT_TRUE(FrameFile(file("p.exr"), {}).camera("view2")->orthographic);
}

TEST_F(CaptureCommand, RefusesASecondViewInOneLine) {
  const Arguments capture = {"capture", "plane", "-o", file("x.exr"), "--size", "8x8"};
  const auto with = [&](const Arguments& more) {
    Arguments all = capture;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  for (const char* angle : {"0", "91", "-90.5", "nan", "right"}) expect_refused(with({"--view2", angle}), 2, "--view2");
  expect_refused(with({"--view2", "30", "--camera-path", "p.json"}), 2, "--camera-path");
  expect_refused(with({"--view2", "30", "--planes", "motion"}), 2, "motion");
  expect_refused(with({"--view2", "30", "--eye", "0,0,9", "--target", "0,0,20"}), 1, "shows nothing");
  write("pair.json", R"({"width": 8, "height": 8, "fx": 9, "fy": 9, "cx": 4, "cy": 4, "views": [
    {"view": "left", "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]]},
    {"view": "right", "camera_to_world": [[1,0,0,1],[0,1,0,0],[0,0,1,4],[0,0,0,1]]}]})");
  const Result result = gloam(with({"--view2", "30", "--camera", file("pair.json")}));
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  EXPECT_NE(result.err.find("'left'"), std::string::npos) << result.err;
  EXPECT_EQ(files(), std::vector<std::string>{"pair.json"});
}

TEST_F(CaptureCommand, RefusesStochasticDepthInOneLine) {
  const Arguments capture = {"capture", "plane", "-o", file("x.exr"), "--size", "8x8"};
  const auto refused = [&](const Arguments& more, const std::string& says) {
    Arguments all = capture;
    all.insert(all.end(), more.begin(), more.end());
    expect_refused(all, 2, says);
  };
  for (const char* samples : {"0", "17", "-1", "4.5", "many"}) refused({"--stochastic", samples}, "--stochastic");
  for (const char* alpha : {"-1", "2", "nan"})
    refused({"--stochastic", "4", "--stochastic-subset", "stratified", "--alpha", alpha}, "--alpha");
  for (const char* seed : {"-1", "2147483648"}) refused({"--stochastic", "4", "--stochastic-seed", seed}, "seed");
  refused({"--alpha", "0.2"}, "--stochastic S");
  refused({"--stochastic-seed", "2"}, "--stochastic S");
  refused({"--stochastic-surfaces", "all"}, "--stochastic S");
  refused({"--stochastic-subset", "nearest"}, "--stochastic S");
  refused({"--stochastic", "4", "--stochastic-surfaces", "seen"}, "all");
  refused({"--stochastic", "4", "--stochastic-subset", "random"}, "stratified");
  // The usual map is not random.
  refused({"--stochastic", "4", "--alpha", "0.2"}, "--stochastic-subset stratified");
  refused({"--stochastic", "4", "--stochastic-seed", "2"}, "--stochastic-subset stratified");
  // Only what is relevant depends on a radius.
  refused({"--stochastic-radius", "2"}, "--stochastic S");
  refused({"--stochastic", "4", "--stochastic-radius", "2"}, "--stochastic-surfaces relevant");
  refused({"--stochastic", "4", "--stochastic-reach", ".2"}, "--stochastic-surfaces relevant");
  for (const char* radius : {"0", "-1", "nan", "inf"})
    refused({"--stochastic", "4", "--stochastic-surfaces", "relevant", "--stochastic-radius", radius},
            "--stochastic-radius");
  refused({"--stochastic", "4", "--stochastic-surfaces", "relevant", "--stochastic-reach", "1.5"},
          "--stochastic-reach");
  refused({"--stochastic", "4", "--stochastic-surfaces", "relevant", "--display",
           GLOAM_SOURCE_DIR "/data/displays/small.json"},
          "use --stochastic-surfaces hidden");
}

TEST_F(CaptureCommand, RefusesInOneLine) {
  expect_refused({"capture", "plan", "-o", file("x.exr")}, 2, "did you mean 'plane'");
  expect_refused({"capture", "no.obj", "-o", file("x.exr")}, 1, "no.obj");
  expect_refused({"capture", "plane", "-o", file("x.exr"), "--camera", "man"}, 2, "did you mean 'main'");
  expect_refused({"capture", "plane", "-o", file("x.exr"), "--size", "64"}, 2, "--size 64");
  expect_refused({"capture", "plane", "-o", file("x.exr"), "--size", "0x5"}, 2, "width");
  expect_refused({"capture", "plane", "-o", file("x.exr"), "--size", "65536x65536"}, 2, "--size");
  expect_refused({"capture", "plane", "-o", file("x.exr"), "--peel", "65"}, 2, "--peel");
  expect_refused({"capture", "plane", "-o", file("x.exr"), "--planes", "depht"}, 2, "did you mean 'depth'");
  expect_refused({"capture", "plane", "-o", file("x.exr"), "--planes", "motion"}, 2, "--camera-path");
  expect_refused({"capture", "plane", "-o", file("x.exr"), "--tilt", "95"}, 2, "0 to 89.9");
  expect_refused({"capture", "plane", "-o", file("x.exr"), "--set", "faces=5"}, 2, "faces");
  expect_refused({"capture", "plane", "-o", file("x.exr"), "--eye", "1,2,3"}, 2, "--target");
  expect_refused({"capture", "plane", "-o", file("x.exr"), "--eye", "1,2", "--target", "0,0,0"}, 2, "--eye 1,2,3");
  expect_refused({"capture", "plane", "-o", file("no/x.exr")}, 1, "is not a folder");
  expect_refused({"capture", "plane", "-o", file("x.exr"), "--compression", "dwaa"}, 2,
                 "--compression dwaa is not allowed; none, ");
  expect_refused({"capture", "plane", "-o", file("x.png")}, 2, ".exr");
  expect_refused({"capture", "plane", "-o", file("x.exr"), "--set", "hbao+.bias=1"}, 2, "tilt can be set");
  expect_refused({"capture", "plane", "-o", file("x.exr"), "--planes", "normal", "--picture", file("x.png")}, 2,
                 "color");
  expect_refused({"capture", "plane", "-o", file("x.exr"), "--camera-path", "p.json", "--fov", "50"}, 2,
                 "--camera-path");
  expect_refused({"capture", "plane", "-o", file("x.exr"), "--eye", "0,0,1", "--target", "0,0,1"}, 2, "same point");
}

// Cameras for which Embree would fail an assertion and end the program.
TEST_F(CaptureCommand, CamerasAtTheEdgeOfWhatCanBe) {
  EXPECT_EQ(
      gloam({"capture", "plane", "-o", file("a.exr"), "--size", "8x8", "--eye", "0,5e-200,0", "--target", "0,0,0"})
          .status,
      0);
  EXPECT_EQ(
      gloam({"capture", "plane", "-o", file("b.exr"), "--size", "8x8", "--eye", "1e12,0,1e12", "--target", "0,0,0"})
          .status,
      0);
  write("behind.json", R"({"width": 8, "height": 8, "camera_type": "ORTHO", "pixels_per_unit": 4, "cx": 4, "cy": 4,
    "near": -10, "far": 20, "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,-3],[0,0,0,1]]})");
  EXPECT_EQ(
      gloam({"capture", "plane", "--tilt", "0", "-o", file("c.exr"), "--size", "8x8", "--camera", file("behind.json")})
          .err,
      "");
  const Frame frame = FrameFile(file("c.exr"), {}).read({"peel.00", "position"});
  EXPECT_NEAR(frame.views[0].planes.at("position").channels[2].at(4, 4), 3, 1e-6) << "the plane behind the eye is seen";
}

TEST_F(CaptureCommand, APathMayNotOverwriteItsScene) {
  write("walk.0001.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("path.json", R"({"width": 8, "height": 8, "fx": 9, "fy": 9, "cx": 4, "cy": 4, "path": [
    {"camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]]},
    {"camera_to_world": [[1,0,0,1],[0,1,0,0],[0,0,1,4],[0,0,0,1]]}]})");
  const std::string before = slurp(path("walk.0001.obj"));
  EXPECT_EQ(
      gloam({"capture", file("walk.0001.obj"), "-o", file("walk.obj"), "--camera-path", file("path.json")}).status, 2);
  EXPECT_EQ(slurp(path("walk.0001.obj")), before);
}

TEST_F(CaptureCommand, APathIsOfOneKindOfCamera) {
  write("path.json", R"({"width": 8, "height": 8, "cx": 4, "cy": 4, "path": [
    {"fx": 9, "fy": 9, "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]]},
    {"camera_type": "ORTHO", "pixels_per_unit": 4, "camera_to_world": [[1,0,0,1],[0,1,0,0],[0,0,1,4],[0,0,0,1]]}]})");
  const Result result =
      gloam({"capture", "plane", "-o", file("w.exr"), "--size", "8x8", "--camera-path", file("path.json")});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("one kind"), std::string::npos) << result.err;
  EXPECT_EQ(files(), std::vector<std::string>{"path.json"});
}

TEST_F(CaptureCommand, ReferenceKeepsItsHandsOffOthersFiles) {
  ASSERT_EQ(gloam({"capture", "plane", "-o", file("p.exr"), "--size", "16x9", "--planes", "depth"}).status, 0);
  write("r.exr.partial", "somebody's");
  Result result = gloam({"reference", "ao", file("p.exr"), "-o", file("r.exr")});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("move it away"), std::string::npos) << result.err;
  EXPECT_EQ(slurp(path("r.exr.partial")), "somebody's");
  fs::rename(file("p.exr"), file("q.exr.partial"));
  result = gloam({"reference", "ao", file("q.exr.partial"), "-o", file("q.exr")});
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_TRUE(fs::exists(file("q.exr.partial")));
}

TEST_F(CaptureCommand, ReferenceOfACapturedFrame) {
  ASSERT_EQ(gloam({"capture", "plane", "-o", file("p.exr"), "--size", "64x36", "--planes", "depth,normal"}).status, 0);
  const Result result = gloam({"reference", "ao", file("p.exr"), "-o", file("r.exr"), "--samples", "50", "--picture",
                               file("r.png"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["scene"], "plane: tilt=60") << "the frame names it";
  EXPECT_EQ(result.json()["samples"], 64);
  EXPECT_EQ(result.json()["noise"], 0);
  FrameFile reference(file("r.exr"), {});
  EXPECT_NEAR(reference.number_attribute("aoRadius").value(), 0.5, 1e-6);
  EXPECT_EQ(reference.number_attribute("aoNoise"), 0);
  EXPECT_EQ(reference.text_attribute("aoFalloff"), "none");
  EXPECT_EQ(files(), (std::vector<std::string>{"p.exr", "r.exr", "r.png"})) << "no checkpoint is left";
  const nlohmann::json compared = gloam({"compare", file("r.exr"), file("r.exr"), "--json", "-"}).json();
  EXPECT_EQ(compared["rmse"], 0);
  EXPECT_EQ(compared["plane"], "ao");
}

TEST_F(CaptureCommand, ReferenceWithATechniquesOwnFalloff) {
  ASSERT_EQ(gloam({"capture", "plane", "-o", file("p.exr"), "--size", "64x36", "--planes", "depth,normal"}).status, 0);
  EXPECT_EQ(gloam({"reference", "ao", file("p.exr"), "-o", file("r.exr"), "--samples", "32", "--falloff", "hbao+",
                   "--set", "hbao+.bias=0.2"})
                .err,
            "");
  EXPECT_EQ(FrameFile(file("r.exr"), {}).text_attribute("aoFalloff"), "hbao+");
  EXPECT_NE(FrameFile(file("r.exr"), {}).text_attribute("aoFalloffParameters").find("bias=0.2"), std::string::npos);
}

TEST_F(CaptureCommand, ReferenceRefusesInOneLine) {
  const std::string out = file("r.exr");
  expect_refused({"reference", "shadow", loggia, "-o", out}, 2, "no 'shadow'");
  expect_refused({"reference", "ao", loggia, "-o", out}, 2, "--scene");
  expect_refused({"reference", "ao", loggia, "--scene", "plane", "-o", out}, 1, "is not what the frame shows");
  expect_refused({"reference", "ao", loggia, "--scene", "plane", "-o", out, "--falloff", "hbaos"}, 2,
                 "did you mean 'hbao");
  expect_refused({"reference", "ao", loggia, "--scene", "plane", "-o", out, "--radius", "0"}, 2, "--radius");
  expect_refused({"reference", "ao", loggia, "--scene", "plane", "-o", out, "--radius", "-1"}, 2, "1e+30, or inf, is");
  expect_refused({"reference", "ao", loggia, "--scene", "plane", "-o", out, "--samples", "0"}, 2, "--samples");
  expect_refused({"reference", "ao", loggia, "--scene", "plane", "-o", out, "--set", "hbao+.bias=0.3"}, 2,
                 "with --falloff hbao+");
  expect_refused(
      {"reference", "ao", loggia, "--scene", "plane", "-o", out, "--falloff", "hbao+", "--set", "hbao+.radius=0.3"}, 2,
      "--radius");
  expect_refused({"reference", "ao", loggia, "--scene", "plane", "-o", out, "--radius", "inf", "--falloff", "hbao+"}, 2,
                 "finite");
  // Options of another kind, and names that are nearly right.
  const auto refused = [&](const char* kind, const char* option, const char* value, const std::string& why) {
    expect_refused({"reference", kind, loggia, "--scene", "plane", "-o", out, option, value}, 2, why);
  };
  refused("bounce", "--radius", "1", "did you mean 'bounces'?");
  refused("specular-occlusion", "--radius", "1", "did you mean 'specular_occlusion'?");
  refused("reflection", "--radius", "0.5", "--radius 0.5: is for ao, ");
  refused("bounces", "--falloff", "hbao+", "--falloff hbao+: is for ao, and bounces has none; leave it out");
  refused("bounces", "--set", "hbao+.bias=0.3", "--set hbao+.bias: sets a falloff");
  refused("ao", "--bounces", "2", "--bounces 2: is for bounces, and ao has none; leave it out");
  refused("contact", "--radius", "1", "--radius 1: is for ao, ");
  refused("ao", "--length", "1", "--length 1: is for contact, and ao has none; leave it out");
  refused("indirect", "--light-direction", "0,1,0", "--light-direction 0,1,0: is for contact, and indirect has none");
  refused("contact", "--light-direction", "0,0,0",
          "--light-direction 0,0,0 is not allowed; a direction that is not 0 is");
  refused("contact", "--light-direction", "0,nan,1", "--light-direction nan is not allowed");
  refused("contact", "--light-position", "1,2", "is not a point");
  refused("contact", "--light-angle", "81", "a number from 0 to 80 is");
  refused("environment", "--radius", "1", "give --environment FILE.exr");
  refused("environment", "--environment-axes", "openxr", "did you mean 'openexr'?");
  refused("ao", "--environment", loggia.c_str(), "is for environment and composite, and ao has none; leave it out");
  expect_refused({"reference", "environment", loggia, "--scene", "plane", "-o", out, "--environment", loggia}, 1,
                 "no lat-long environment");
  expect_refused({"reference", "contact", loggia, "--scene", "plane", "-o", out, "--light-position", "0,1,0",
                  "--light-direction", "0,1,0"},
                 2, "--light-direction and --light-position are two lights; give one of them");
  refused("bounces", "--bounces", "1025", "a whole number from 0 to 1024 is");
}

/// Each kind of truth has its plane, its noise, and states its samples and what it is.
TEST_F(CaptureCommand, EveryKindOfReferenceStatesWhatItIs) {
  ASSERT_EQ(gloam({"capture", "slab", "-o", file("s.exr"), "--size", "64x36"}).status, 0);
  ASSERT_EQ(gloam({"capture", "plane", "-o", file("sky.exr"), "--size", "64x32", "--planes", "color"}).status, 0);
  for (const std::string kind :
       {"ao", "reflection", "bounces", "specular_occlusion", "indirect", "environment", "contact", "composite"}) {
    const std::string plane = kind == "composite" ? "color" : kind;
    Arguments arguments = {"reference", kind, file("s.exr"), "-o", file("r.exr"), "--samples", "40", "--json", "-"};
    if (kind == "environment") arguments.insert(arguments.end(), {"--environment", file("sky.exr")});
    if (kind == "contact") arguments.insert(arguments.end(), {"--light-direction", "1,0.1,0.5", "--light-angle", "10"});
    const Result result = gloam(arguments);
    ASSERT_EQ(result.status, 0) << kind << result.err;
    FrameFile reference(file("r.exr"), {});
    EXPECT_EQ(reference.number_attribute(plane + "Samples"), 64) << kind;
    EXPECT_NEAR(reference.number_attribute(plane + "Noise").value(), double(result.json()["noise"]), 1e-6) << kind;
    EXPECT_GT(double(result.json()["noise"]), 0) << kind;
    EXPECT_EQ(reference.number_attribute(plane + "Radius").has_value(),
              kind != "reflection" && kind != "contact" && kind != "composite")
        << kind;
    EXPECT_NE(reference.text_attribute(plane + "Definition"), "") << kind;
    EXPECT_EQ(reference.text_attribute("gloamScene"), "slab: height=1");
    EXPECT_TRUE(contains(reference.common_planes(), plane) && contains(reference.common_planes(), plane + "_noise"));
    // Compared with itself there is no error.
    const nlohmann::json same = gloam({"compare", file("r.exr"), file("r.exr"), "--json", "-"}).json();
    EXPECT_EQ(same["rmse"], 0) << kind;
  }
}

TEST_F(CaptureCommand, ListsScenes) {
  const nlohmann::json scenes = gloam({"list", "scenes", "--json", "-"}).json();
  bool found = false;
  for (const auto& scene : scenes) {
    EXPECT_NE(scene["summary"], "");
    found = found || (scene["name"] == "plane" && scene["parameters"][0]["name"] == "tilt");
  }
  EXPECT_TRUE(found);
  EXPECT_NE(gloam({"capture", "plane", "--help"}).out.find("--tilt"), std::string::npos);
}

}  // namespace
}  // namespace gloam::test::capture_test
