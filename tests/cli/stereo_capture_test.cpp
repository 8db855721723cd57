// Two eyes: captured from one camera, and read from two files.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include "cli/gloam_process.h"
#include "gloam/error.h"
#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::test::stereo_capture_test {
namespace {

using glm::dvec2;
using glm::dvec3;

/// The pixel of a world point in an image. The point lies before the camera.
dvec2 projected(const Camera& camera, const dvec3& world) {
  const dvec3 view = camera.pose->world_to_view * (world - camera.pose->position);
  const double reach = camera.orthographic ? 1 : -view.z;
  return {camera.cx + camera.fx * view.x / reach, camera.cy - camera.fy * view.y / reach};
}

/// A point on the camera's axis.
dvec3 on_axis(const Camera& camera, double depth) {
  return camera.pose->position + glm::transpose(camera.pose->world_to_view) * dvec3(0, 0, -depth);
}

/// The world position of a pixel, by the plane `position`.
dvec3 place_at(const View& view, int x, int y) {
  dvec3 place = view.origin;
  for (int i = 0; i < 3; ++i) place[i] += view.planes.at("position").channels[size_t(i)].at(x, y);
  return place;
}

float depth_at(const View& view, int x, int y) { return view.planes.at("depth").channels[0].at(x, y); }

/// Shares of the pixels of one image whose points fall into the other image: the other shows the same surface (its depth there is
/// within 2 % of the point's depth), or something before it, or behind it.
struct Reprojected {
  double found = 0, hidden = 0, seen_through = 0;
};

Reprojected reprojected(const View& from, const View& to, int width, int height) {
  int inside = 0;
  Reprojected counts;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (is_background(depth_at(from, x, y))) continue;
      const dvec3 place = place_at(from, x, y);
      const dvec2 pixel = projected(*to.camera, place);
      if (!(pixel.x >= 0 && pixel.x < width && pixel.y >= 0 && pixel.y < height)) continue;
      const double expected = -(to.camera->pose->world_to_view * (place - to.camera->pose->position)).z;
      const double off = depth_at(to, int(pixel.x), int(pixel.y)) / expected - 1;
      ++inside;
      ++(std::abs(off) < 0.02 ? counts.found : off < 0 ? counts.hidden : counts.seen_through);
    }
  }
  EXPECT_GT(inside, width * height / 2);
  return {counts.found / inside, counts.hidden / inside, counts.seen_through / inside};
}

class Stereo : public Cli {
 protected:
  std::string file(const std::string& name) const { return path(name).string(); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }

  Result capture(const std::string& scene, const std::string& name, const Arguments& more) const {
    Arguments all = {"capture", scene, "-o", file(name), "--json", "-"};
    all.insert(all.end(), more.begin(), more.end());
    return gloam(all);
  }

  Frame captured(const std::string& scene, const Arguments& more, const std::vector<std::string>& planes) const {
    const Result result = capture(scene, "captured.exr", more);
    EXPECT_EQ(result.status, 0) << result.err;
    return FrameFile(path("captured.exr"), {}).read(planes);
  }

  void expect_refused(const Arguments& arguments, int status, const std::string& says) const {
    const std::vector<std::string> before = files();
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(files(), before) << "a refused command leaves nothing behind";
  }
};

class CapturedStereo : public Stereo {
 protected:
  /// The scene `plane` upright, 4 before the camera, which looks along -z.
  Frame wall(const Arguments& more) const {
    Arguments all = {"--tilt", "0", "--size", "64x36", "--planes", "position"};
    all.insert(all.end(), more.begin(), more.end());
    return captured("plane", all, {"depth", "position"});
  }
};

TEST_F(CapturedStereo, ParallelEyesStandBesideTheCamera) {
  const Frame mono = wall({}), pair = wall({"--stereo", "0.5"});
  ASSERT_EQ(pair.views.size(), 2u);
  EXPECT_EQ(pair.views[0].name, "left");
  EXPECT_EQ(pair.views[1].name, "right");
  const Camera middle = *mono.views[0].camera, left = *pair.views[0].camera, right = *pair.views[1].camera;
  EXPECT_NEAR(glm::length(left.pose->position - (middle.pose->position - dvec3(0.25, 0, 0))), 0, 1e-9);
  EXPECT_NEAR(glm::length(right.pose->position - (middle.pose->position + dvec3(0.25, 0, 0))), 0, 1e-9);
  for (const Camera& eye : {left, right}) {
    EXPECT_EQ(eye.pose->world_to_view, middle.pose->world_to_view);
    EXPECT_NEAR(eye.fx, middle.fx, 1e-4);
    EXPECT_NEAR(eye.cx, middle.cx, 1e-4);
    EXPECT_NEAR(eye.cy, middle.cy, 1e-4);
  }
  EXPECT_EQ(FrameFile(path("captured.exr"), {}).number_attribute("gloamStereo"), 0.5);
}

TEST_F(CapturedStereo, DisparityOfParallelEyes) {
  const Frame pair = wall({"--stereo", "0.5"});
  const Camera left = *pair.views[0].camera, right = *pair.views[1].camera;
  for (const int x : {3, 30, 60}) {
    for (const int y : {2, 33}) {
      EXPECT_NEAR(depth_at(pair.views[0], x, y), 4, 1e-5);
      const dvec3 place = place_at(pair.views[0], x, y);
      const dvec2 disparity = projected(left, place) - projected(right, place);
      EXPECT_NEAR(disparity.x, left.fx * 0.5 / 4, 1e-3);
      EXPECT_NEAR(disparity.y, 0, 1e-4);
      // And in the images: the same pixel of the right one shows a point that far to the right.
      EXPECT_NEAR(glm::length(place_at(pair.views[1], x, y) - place - dvec3(0.5, 0, 0)), 0, 1e-5);
    }
  }
}

TEST_F(CapturedStereo, NoDisparityAtTheConvergenceDepth) {
  const Frame mono = wall({}), pair = wall({"--stereo", "0.5", "--convergence", "4"});
  const Camera middle = *mono.views[0].camera, left = *pair.views[0].camera, right = *pair.views[1].camera;
  EXPECT_NEAR(left.cx, middle.cx - middle.fx * 0.25 / 4, 1e-4);
  EXPECT_NEAR(right.cx, middle.cx + middle.fx * 0.25 / 4, 1e-4);
  EXPECT_EQ(left.pose->world_to_view, right.pose->world_to_view) << "frusta are shifted, eyes are not turned";
  EXPECT_NEAR(right.pose->position.x - left.pose->position.x, 0.5, 1e-9);
  for (const int x : {0, 31, 63}) {
    for (const int y : {0, 17, 35}) {
      const dvec3 place = place_at(pair.views[0], x, y);
      EXPECT_NEAR(glm::length(projected(left, place) - projected(right, place)), 0, 1e-3);
      EXPECT_NEAR(glm::length(place_at(pair.views[1], x, y) - place), 0, 1e-5) << "every pixel shows one place";
      EXPECT_NEAR(glm::length(place_at(mono.views[0], x, y) - place), 0, 1e-5) << "and so does the camera between";
    }
  }
  const dvec3 behind = on_axis(middle, 8);
  EXPECT_NEAR(projected(left, behind).x - projected(right, behind).x, left.fx * 0.5 * (1.0 / 8 - 1.0 / 4), 1e-3);
}

TEST_F(CapturedStereo, ToeInTurnsBothEyesToTheConvergencePoint) {
  const std::string camera = R"({"width": 64, "height": 36, "fx": 60, "fy": 60, "cx": 30, "cy": 20,
    "camera_to_world": [[0,0,1,3],[0,1,0,0.5],[-1,0,0,0],[0,0,0,1]]})";  // looks along -x of the world
  write("aside.json", camera);
  const Arguments common = {"--size", "64x36", "--planes", "position", "--camera", file("aside.json")};
  const auto with = [&](Arguments more) {
    more.insert(more.end(), common.begin(), common.end());
    return captured("colonnade", more, {"depth"});
  };
  const Frame mono = with({}), pair = with({"--stereo", "0.8", "--convergence", "3", "--toe-in"});
  const Camera middle = *mono.views[0].camera, left = *pair.views[0].camera, right = *pair.views[1].camera;
  const dvec3 target = on_axis(middle, 3);
  const double distance = std::hypot(0.4, 3);
  for (const Camera& eye : {left, right}) {
    EXPECT_NEAR(glm::length(on_axis(eye, distance) - target), 0, 1e-6);
    EXPECT_NEAR(glm::length(projected(eye, target) - dvec2(30, 20)), 0, 1e-3) << "principal points stay";
    EXPECT_NEAR(glm::determinant(eye.pose->world_to_view), 1, 1e-6);
  }
  EXPECT_NEAR(glm::length(0.5 * (left.pose->position + right.pose->position) - middle.pose->position), 0, 1e-9);
  const dvec3 apart = middle.pose->world_to_view * (right.pose->position - left.pose->position);
  EXPECT_NEAR(glm::length(apart - dvec3(0.8, 0, 0)), 0, 1e-9) << "right is to the right";
  FrameFile written(path("captured.exr"), {});
  EXPECT_NEAR(written.number_attribute("gloamToeIn").value(), std::atan(0.4 / 3) * 180 / M_PI, 1e-5);
  EXPECT_NEAR(written.number_attribute("gloamConvergence").value(), 3, 1e-6);
}

TEST_F(CapturedStereo, EachEyeSeesWhatTheOtherSees) {
  const int width = 192, height = 108;
  for (const Arguments& rig : {Arguments{"--stereo", "0.1"}, Arguments{"--stereo", "0.1", "--convergence", "4"},
                               Arguments{"--stereo", "0.1", "--convergence", "4", "--toe-in"}}) {
    SCOPED_TRACE(fmt::format("{}", fmt::join(rig, " ")));
    Arguments all = rig;
    for (const char* more : {"--size", "192x108", "--planes", "position"}) all.push_back(more);
    Frame pair = captured("colonnade", all, {"depth", "position"});
    ASSERT_EQ(pair.views.size(), 2u);
    for (const size_t from : {0, 1}) {
      const Reprojected shares = reprojected(pair.views[from], pair.views[1 - from], width, height);
      EXPECT_GT(shares.found, 0.88);
      EXPECT_LT(shares.seen_through, 0.06) << "other than at edges nothing is where it should not be";
    }
    std::swap(pair.views[0].camera, pair.views[1].camera);
    EXPECT_LT(reprojected(pair.views[0], pair.views[1], width, height).found, 0.75)
        << "with the eyes exchanged it is not so";
  }
}

TEST_F(CapturedStereo, EyesOnOneSpotAreTheCameraTwice) {
  const Arguments common = {"--size", "64x36", "--peel", "3", "--stochastic", "4"};
  const std::vector<std::string> planes = {"depth", "normal", "color", "peel.02", "peel_count", "stochastic.03"};
  const Frame mono = captured("fence", common, planes);
  Arguments both = common;
  both.insert(both.end(), {"--stereo", "0", "--convergence", "2"});
  Frame pair = captured("fence", both, planes);
  for (View& eye : pair.views) {
    for (const std::string& plane : planes) {
      ASSERT_TRUE(eye.find(plane)) << plane << " of " << eye.name;
      EXPECT_EQ(difference(*eye.find(plane), *mono.views[0].find(plane)).max, 0) << plane << " of " << eye.name;
    }
  }
}

TEST_F(CapturedStereo, SaysWhatWasDone) {
  const Result off_axis = capture(
      "fence", "f.exr", {"--size", "64x36", "--stereo", "0.065", "--convergence", "2", "--picture", file("f.png")});
  ASSERT_EQ(off_axis.status, 0) << off_axis.err;
  const nlohmann::json said = off_axis.json()["stereo"];
  EXPECT_EQ(said["interpupillary_distance"], 0.065);
  EXPECT_EQ(said["convergence"], 2);
  EXPECT_EQ(said["toe_in_degrees"], 0);
  EXPECT_NEAR(said["shift_pixels"], FrameFile(file("f.exr"), {}).camera("left")->fx * 0.065 / 2 / 2, 1e-3);
  EXPECT_EQ(off_axis.json()["view2"], nullptr);
  EXPECT_EQ(files(), (std::vector<std::string>{"f.exr", "f.left.png", "f.right.png"}));
  const nlohmann::json parallel = capture("fence", "f.exr", {"--size", "64x36", "--stereo", "1"}).json()["stereo"];
  EXPECT_EQ(parallel["convergence"], nullptr);
  EXPECT_EQ(parallel["shift_pixels"], 0);
  EXPECT_EQ(capture("fence", "f.exr", {"--size", "64x36"}).json()["stereo"], nullptr);
  EXPECT_NE(gloam({"capture", "fence", "-o", file("f.exr"), "--size", "64x36", "--stereo", "1"}).out.find("parallel"),
            std::string::npos);
}

TEST_F(CapturedStereo, AnOrthographicCameraNeedsToeIn) {
  write("flat.json", R"({"width": 64, "height": 36, "camera_type": "ORTHO", "pixels_per_unit": 12,
    "cx": 32, "cy": 18, "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]]})");
  const Arguments common = {"capture",  "plane",           "-o",       file("p.exr"), "--size", "64x36",
                            "--camera", file("flat.json"), "--stereo", "0.5"};
  expect_refused(common, 2, "--toe-in");
  Arguments off_axis = common;
  off_axis.insert(off_axis.end(), {"--convergence", "4"});
  expect_refused(off_axis, 2, "orthographic");
  off_axis.push_back("--toe-in");
  ASSERT_EQ(gloam(off_axis).status, 0);
  FrameFile turned(file("p.exr"), {});
  const dvec3 nearer(0, 0, 1);
  EXPECT_LT(glm::length(projected(*turned.camera("left"), {0, 0, 0}) - dvec2(32, 18)), 1e-3);
  EXPECT_NEAR(projected(*turned.camera("left"), nearer).x - projected(*turned.camera("right"), nearer).x,
              2 * 12 * std::sin(std::atan(0.25 / 4)), 1e-3);
}

TEST_F(CapturedStereo, RefusesInOneLine) {
  const Arguments capture = {"capture", "plane", "-o", file("x.exr"), "--size", "8x8"};
  const auto refused = [&](const Arguments& more, const std::string& says) {
    Arguments all = capture;
    all.insert(all.end(), more.begin(), more.end());
    expect_refused(all, 2, says);
  };
  for (const char* distance : {"-0.1", "nan", "wide"}) refused({"--stereo", distance}, "--stereo");
  for (const char* depth : {"0", "-2", "nan", "inf"})
    refused({"--stereo", "1", "--convergence", depth}, "--convergence");
  refused({"--stereo", "1", "--toe-in"}, "--convergence D");
  refused({"--convergence", "2"}, "--stereo IPD");
  refused({"--toe-in"}, "--stereo IPD");
  refused({"--stereo", "1", "--convergence", "1e-9"}, "larger depth");
  refused({"--stereo", "1", "--view2", "30"}, "--view2 and --stereo");
  refused({"--stereo", "1", "--planes", "motion"}, "--camera-path");
  write("pair.json", R"({"width": 8, "height": 8, "fx": 9, "fy": 9, "cx": 4, "cy": 4, "views": [
    {"view": "port", "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]]},
    {"view": "starboard", "camera_to_world": [[1,0,0,1],[0,1,0,0],[0,0,1,4],[0,0,0,1]]}]})");
  refused({"--stereo", "1", "--camera", file("pair.json")}, "'port' and 'starboard'");
}

}  // namespace
}  // namespace gloam::test::stereo_capture_test
