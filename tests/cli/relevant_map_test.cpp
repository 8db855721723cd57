// Maps of relevant surfaces: gloam capture makes those of gloam run stochastic-depth, and what such a map does not serve is refused.
#include <cmath>

#include "cli/gloam_process.h"
#include "gloam/planes.h"
#include "support/techniques.h"

namespace gloam::test::relevant_map_test {
namespace {

using Json = nlohmann::json;

class RelevantMap : public Cli {
 protected:
  std::string file(const std::string& name) const { return path(name).string(); }

  Result done(Arguments arguments, const Arguments& more = {}) const {
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return result;
  }

  void refused(const Arguments& arguments, const std::vector<std::string>& says) const {
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    for (const std::string& words : says) EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  }

  Frame map_in(const std::string& name) const {
    return FrameFile(file(name), {}).read({"stochastic.00", "stochastic.01", "stochastic.02", "stochastic.03"});
  }

  /// A capture's map of relevant surfaces and the one that stochastic-depth makes of its layers hold the same depths.
  void expect_same_map(const Arguments& scene, const Arguments& of_map = {}, const Arguments& of_run = {}) const {
    SCOPED_TRACE(Json(scene).dump() + Json(of_map).dump());
    Arguments capture = {"capture"};
    capture.insert(capture.end(), scene.begin(), scene.end());
    capture.insert(capture.end(), {"--planes", "depth", "--stochastic", "4"});
    done(capture, {"-o", file("layers.exr"), "--peel", "64", "--stochastic-surfaces", "hidden"});
    const Frame hidden = map_in("layers.exr");
    Arguments relevant = {"-o", file("map.exr"), "--stochastic-surfaces", "relevant"};
    relevant.insert(relevant.end(), of_map.begin(), of_map.end());
    done(capture, relevant);
    done({"run", "stochastic-depth", file("layers.exr"), "-o", file("made.exr"), "--samples", "4", "--keep-margin",
          "--set", "surfaces=relevant"},
         of_run);
    const Frame captured = map_in("map.exr"), made = map_in("made.exr");
    EXPECT_GT(held_in(captured), 0);
    EXPECT_LT(held_in(captured), held_in(hidden)) << "something is left out";
    EXPECT_TRUE(same_bits(captured, made));
  }

  /// The depth and normals of one file with the map that a run has made of it.
  void put_beside_depth(const std::string& frame, const std::string& map, const std::string& to) const {
    Frame both = FrameFile(file(frame), {}).read({"depth", "normal"});
    FrameFile made(file(map), {});
    Frame samples = made.read({"stochastic.00", "stochastic.01", "stochastic.02", "stochastic.03"});
    for (size_t v = 0; v < both.views.size(); ++v)
      for (auto& [name, plane] : samples.views[v].planes) both.views[v].planes.emplace(name, std::move(plane));
    both.attributes["gloamParameters"] = made.text_attribute("gloamParameters");
    write_frame(file(to), both);
  }

  static int held_in(const Frame& frame) {
    int held = 0;
    for (const View& view : frame.views)
      for (const auto& [name, plane] : view.planes)
        for (int y = 0; y < frame.height(); ++y)
          for (int x = 0; x < frame.width(); ++x) held += std::isfinite(plane.channels[0].at(x, y));
    return held;
  }
};

TEST_F(RelevantMap, OfACaptureIsThatOfTheTechnique) {
  std::ofstream(path("flat.camera.json"))
      << R"({"width": 96, "height": 54, "orthographic": true, "pixels_per_unit": 9.7,
    "cx": 48.3, "cy": 26.1, "camera_to_world": [[1,0,0,0],[0,1,0,1.5],[0,0,1,6],[0,0,0,1]]})";
  for (const char* scene : {"corridor", "colonnade"}) expect_same_map({scene, "--size", "96x54"});
  expect_same_map({"gallery", "--size", "96x54", "--camera", file("flat.camera.json")});
  expect_same_map({"colonnade", "--size", "96x54"}, {"--stochastic-radius", "0.1", "--stochastic-reach", "0.05"},
                  {"--radius", "0.1", "--max_reach", "0.05"});
  expect_same_map({"colonnade", "--size", "96x54"}, {"--stochastic-subset", "stratified", "--stochastic-seed", "3"},
                  {"--subset", "stratified", "--seed", "3"});
}

TEST_F(RelevantMap, OfEveryViewAndOfAMargin) {
  expect_same_map({"colonnade", "--size", "80x45", "--stereo", "0.065", "--convergence", "2"});
  expect_same_map({"corridor", "--size", "80x45", "--view2", "20"});
  expect_same_map({"corridor", "--size", "80x45", "--overscan", "11px"});
}

TEST_F(RelevantMap, SaysHowItWasMade) {
  const Result result = done({"capture", "colonnade", "-o", file("map.exr"), "--size", "64x36", "--planes", "normal",
                              "--stochastic", "2", "--stochastic-surfaces", "relevant", "--json", "-"});
  const Json map = result.json()["stochastic"];
  EXPECT_EQ(map["surfaces"], "relevant");
  EXPECT_EQ(map["max_reach"], 0.25);
  EXPECT_EQ(map["radius"], result.json()["ao_radius"]) << "the one that suits the scene";
  const FrameFile frame(file("map.exr"), {});
  EXPECT_EQ(frame.text_attribute("gloamStochasticSurfaces"), "relevant");
  EXPECT_EQ(frame.number_attribute("gloamStochasticRadius"), frame.number_attribute("aoRadius"));
  EXPECT_EQ(frame.number_attribute("gloamStochasticReach"), 0.25);
  done({"run", "sd-gtao", file("map.exr"), "-o", file("ao.exr"), "--samples", "2"});
}

TEST_F(RelevantMap, OfAFileHasTheRadiusThatSuitsItsFirstFrame) {
  // Panels behind each other: a scene of a file has no radius of its own.
  std::ofstream(path("panels.obj"))
      << "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nv -9 -9 -1\nv 9 -9 -1\nv 9 9 -1\nv -9 9 -1\n"
         "v -9 -9 -9\nv 9 -9 -9\nv 9 9 -9\nv -9 9 -9\nf 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\nf 9 10 11\n"
         "f 9 11 12\n";
  std::ofstream(path("path.json")) << R"({"width": 64, "height": 36, "fx": 40, "fy": 40, "cx": 32, "cy": 18, "path": [
    {"camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,20],[0,0,0,1]]},
    {"camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,5],[0,0,0,1]]}]})";
  const Arguments capture = {"capture",
                             file("panels.obj"),
                             "--size",
                             "64x36",
                             "--camera-path",
                             file("path.json"),
                             "--planes",
                             "depth",
                             "--stochastic",
                             "2",
                             "--stochastic-surfaces",
                             "relevant"};
  done(capture, {"-o", file("all.exr")});
  done(capture, {"-o", file("one.####.exr"), "--frames", "2"});
  const FrameFile first(file("all.0001.exr"), {});
  EXPECT_GT(first.number_attribute("gloamStochasticRadius").value_or(0), 1) << "far from the panels";
  for (const char* name : {"all.0002.exr", "one.0002.exr"}) {
    EXPECT_EQ(FrameFile(file(name), {}).number_attribute("gloamStochasticRadius"),
              first.number_attribute("gloamStochasticRadius"))
        << name;
  }
}

TEST_F(RelevantMap, OfOneViewIsRefusedForTheOther) {
  const std::vector<std::string> says = {"gloam: multiview: looks among one view's stochastic depths",
                                         "surfaces=hidden"};
  const Arguments capture = {"capture", "corridor", "--size", "64x36", "--planes", "normal", "--view2", "20"};
  done(capture, {"-o", file("layers.exr"), "--peel", "8"});
  const Arguments multiview = {"run", "multiview", file("layers.exr"), "-o", file("ao.exr")};
  done(multiview);
  Arguments relevant = multiview;
  relevant.insert(relevant.end(), {"--set", "stochastic-depth.surfaces=relevant"});
  refused(relevant, says);
  // Stored by a capture, or by a run.
  done(capture, {"-o", file("map.exr"), "--stochastic", "4", "--stochastic-surfaces", "relevant"});
  refused({"run", "multiview", file("map.exr"), "-o", file("ao.exr")}, {says[0], "--stochastic-surfaces hidden"});
  done({"run", "stochastic-depth", file("layers.exr"), "-o", file("made.exr"), "--set", "surfaces=relevant"});
  put_beside_depth("layers.exr", "made.exr", "both.exr");
  refused({"run", "multiview", file("both.exr"), "-o", file("ao.exr")}, {says[0], "--stochastic-surfaces hidden"});
  // Each view by itself reads it.
  EXPECT_EQ(done({"run", "sd-hbao+", file("map.exr"), "-o", file("ao.exr")}).err.find("relevant"), std::string::npos);
}

TEST_F(RelevantMap, ServesTwoEyesThatAgreeWithANote) {
  done({"capture", "corridor", "-o", file("eyes.exr"), "--size", "96x54", "--planes", "normal", "--stereo", "0.1",
        "--peel", "16"});
  const auto ao_with = [&](const std::string& surfaces) {
    const Result result = done({"run", "stereo-sd-hbao+", file("eyes.exr"), "-o", file("ao.exr"), "--samples", "16",
                                "--set", "surfaces=" + surfaces, "--filter", "none"});
    EXPECT_EQ(result.err.find("looks in the other eye's map too") != std::string::npos, surfaces == "relevant")
        << result.err;
    return FrameFile(file("ao.exr"), {}).read({"ao_raw"});
  };
  EXPECT_TRUE(same_bits(ao_with("hidden"), ao_with("relevant"))) << "eyes so close show nearly the same";
}

TEST_F(RelevantMap, IsTooSmallForARangeBeyondTheRadius) {
  done({"capture", "corridor", "-o", file("layers.exr"), "--size", "64x36", "--planes", "normal", "--peel", "8"});
  const auto notes = [&](const std::string& technique, const Arguments& settings) {
    return done({"run", technique, file("layers.exr"), "-o", file("ao.exr")}, settings).err;
  };
  const std::string words = "sd-ssao: range 2 lets surfaces count that are farther away";
  EXPECT_NE(notes("sd-ssao", {"--set", "surfaces=relevant"}).find(words), std::string::npos);
  EXPECT_EQ(notes("sd-ssao", {}).find("farther away"), std::string::npos);
  EXPECT_EQ(notes("sd-ssao", {"--set", "surfaces=relevant", "--set", "range=0.5"}).find("farther away"),
            std::string::npos);
  EXPECT_EQ(notes("sd-gtao", {"--set", "surfaces=relevant"}).find("farther away"), std::string::npos);
}

TEST_F(RelevantMap, OfAFileIsForItsRadius) {
  done({"capture", "corridor", "-o", file("map.exr"), "--size", "64x36", "--planes", "normal", "--stochastic", "4",
        "--stochastic-surfaces", "relevant", "--stochastic-radius", "0.3"});
  const auto notes = [&](const std::string& technique, const std::string& radius) {
    return done({"run", technique, file("map.exr"), "-o", file("ao.exr"), "--radius", radius}).err;
  };
  EXPECT_NE(notes("sd-gtao", "0.6").find("sd-gtao: the map's surfaces are relevant within 0.3 scene units"),
            std::string::npos);
  EXPECT_EQ(notes("sd-gtao", "0.3").find("relevant"), std::string::npos);
  EXPECT_EQ(notes("gtao", "0.6").find("relevant"), std::string::npos) << "reads no map";
  EXPECT_NE(notes("sd-ssao", "0.3").find("farther away than the radius"), std::string::npos);
  // Of a run too.
  done({"capture", "corridor", "-o", file("layers.exr"), "--size", "64x36", "--planes", "normal", "--view2", "20",
        "--peel", "8"});
  done({"run", "stochastic-depth", file("layers.exr"), "-o", file("made.exr"), "--set", "surfaces=relevant", "--radius",
        "0.3"});
  put_beside_depth("layers.exr", "made.exr", "map.exr");
  EXPECT_NE(notes("sd-gtao", "0.6").find("within 0.3 scene units"), std::string::npos);
}

}  // namespace
}  // namespace gloam::test::relevant_map_test
