// Maps of relevant surfaces: gloam capture makes those of gloam run stochastic-depth.
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

}  // namespace
}  // namespace gloam::test::relevant_map_test
