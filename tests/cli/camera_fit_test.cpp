// Frames without a camera whose positions tell it, through the command; and cameras that positions contradict.
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "cli/gloam_process.h"
#include "support/seen_frame.h"

namespace gloam::test::camera_fit_test {
namespace {

using Json = nlohmann::json;
using glm::dvec3;

class CameraByPositions : public Cli {
 protected:
  Json info(const std::string& frame, const Arguments& flags = {}) const {
    Arguments arguments = {"info", path(frame), "--json", "-"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.json();
  }

  static std::string notes(const Json& document) {
    std::string all;
    for (const std::string note : document["assumed"]) all += note + "\n";
    return all;
  }

  /// Checks the note of a fit, and the camera against the one that the scene was seen by.
  void expect_fit(const Json& document, const Camera& truth, double pixels) const {
    EXPECT_EQ(document["camera_from"], "fit") << notes(document);
    ASSERT_FALSE(document["camera"].is_null()) << notes(document);
    const Json& camera = document["camera"];
    EXPECT_NEAR(camera["fx"], truth.fx, pixels);
    EXPECT_NEAR(camera["fy"], truth.fy, pixels);
    EXPECT_NEAR(camera["cx"], truth.cx, pixels);
    EXPECT_NEAR(camera["cy"], truth.cy, pixels);
    EXPECT_NE(notes(document).find("fitted from P"), std::string::npos) << notes(document);
    EXPECT_LT(document["camera_residual_pixels"], std::max(0.5, pixels));
    EXPECT_GE(document["camera_residual_pixels_99"], document["camera_residual_pixels"]);
  }

  double rmse(const std::string& test, const std::string& reference) const {
    const Result result = gloam({"compare", path(test), path(reference), "--json", "-"});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.json()["rmse"];
  }

  /// AO of the frame, with and without its camera beside it.
  void expect_same_ao(const SeenFrame& seen, double bound) const {
    const auto run = [&](const std::string& out) {
      const Result result = gloam({"run", "gtao", path("frame.exr"), "-o", path(out), "--radius", "1"});
      EXPECT_EQ(result.status, 0) << result.err;
    };
    run("without.exr");
    seen.write_camera(path("frame.camera.json"));
    run("with.exr");
    fs::remove(path("frame.camera.json"));
    EXPECT_LT(rmse("without.exr", "with.exr"), bound);
  }
};

TEST_F(CameraByPositions, WorldSpaceNormalsAreUsed) {
  SeenFrame seen;
  seen.write(path("frame.exr"), {"P", "Z", "N"});
  const Json document = info("frame.exr");
  expect_fit(document, seen.camera, 0.01);
  EXPECT_NE(notes(document).find("fitted from P and Z: fx 250.00 fy 250.00 cx 160.00 cy 90.00, residual"),
            std::string::npos);
  EXPECT_NE(notes(document).find("; Z is planar"), std::string::npos) << notes(document);
  EXPECT_EQ(document["normal_space"], "world");
  EXPECT_EQ(document["depth_convention"], "z");
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(document["camera"]["position"][size_t(c)], seen.camera.pose->position[c], 1e-3);
  expect_same_ao(seen, 1e-3);
  const Result run = gloam({"run", "gtao", path("frame.exr"), "-o", path("out.exr")});
  EXPECT_NE(run.err.find("camera fitted from P and Z"), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("normals: not used"), std::string::npos) << run.err;
  EXPECT_EQ(info("out.exr")["camera_from"], "header") << "a result carries the camera";
}

TEST_F(CameraByPositions, DepthIsMadeWhereThereIsNone) {
  SeenFrame seen;
  seen.is_background = [](int x, int y) { return x > 250 && y < 40; };
  seen.write(path("frame.exr"), {"P", "N"});
  const Json document = info("frame.exr");
  expect_fit(document, seen.camera, 0.01);
  EXPECT_NE(notes(document).find("depth: made from the positions"), std::string::npos) << notes(document);
  EXPECT_NEAR(document["background_share"], 69 * 40.0 / (320 * 180), 1e-9);
  ASSERT_EQ(gloam({"run", "gtao", path("frame.exr"), "-o", path("ao.exr"), "--radius", "1", "--keep-depth"}).status, 0);
  const Frame out = FrameFile(path("ao.exr"), {}).read({"depth", "ao"});
  const Channel& z = out.views[0].planes.at("depth").channels[0];
  for (const auto& [x, y] : {std::pair(10, 10), {130, 100}, {300, 170}})
    EXPECT_NEAR(z.at(x, y), wavy_depth({x + 0.5, y + 0.5}), 1e-4) << x << ' ' << y;
  EXPECT_TRUE(is_background(z.at(300, 10)));
  expect_same_ao(seen, 1e-3);
}

TEST_F(CameraByPositions, DepthIsMadeFromPositionsAndTheCameraBeside) {
  SeenFrame seen;
  seen.write(path("frame.exr"), {"P"});
  seen.write_camera(path("frame.camera.json"));
  const Json document = info("frame.exr");
  EXPECT_EQ(document["camera_from"], "json");
  EXPECT_LT(document["camera_residual_pixels"], 0.01);
  EXPECT_EQ(gloam({"run", "hbao+", path("frame.exr"), "-o", path("ao.exr")}).status, 0);
  const Result ndc = gloam({"run", "hbao+", path("frame.exr"), "-o", path("ao.exr"), "--depth", "ray"});
  EXPECT_NE(ndc.err.find("--depth has no effect"), std::string::npos) << ndc.err;
  const Result hidden = gloam({"run", "hbao+", path("frame.exr"), "-o", path("ao.exr"), "--plane", "depth=none"});
  EXPECT_EQ(hidden.status, 1) << "a hidden depth is not made";
}

TEST_F(CameraByPositions, DepthAlongTheRayIsRecognised) {
  SeenFrame seen;
  seen.stored_depth = [](double, double ray) { return ray; };
  seen.write(path("frame.exr"), {"P", "Z"});
  const Json document = info("frame.exr");
  expect_fit(document, seen.camera, 0.01);
  EXPECT_EQ(document["depth_convention"], "ray");
  EXPECT_NE(notes(document).find("depth: 'Z' is the distance along the ray, as the positions show"), std::string::npos);
  const Json flagged = info("frame.exr", {"--depth", "z"});
  EXPECT_EQ(flagged["depth_convention"], "z");
  EXPECT_NE(notes(flagged).find("--depth overrules the positions"), std::string::npos) << notes(flagged);
  seen.write_camera(path("frame.camera.json"));
  EXPECT_EQ(info("frame.exr")["depth_convention"], "ray") << "whoever gives the camera";
}

TEST_F(CameraByPositions, DepthInOtherUnitsIsScaled) {
  SeenFrame seen;
  seen.stored_depth = [](double z, double) { return 100 * z; };
  seen.write(path("frame.exr"), {"P", "Z"});
  const Json document = info("frame.exr");
  expect_fit(document, seen.camera, 0.01);
  EXPECT_NE(notes(document).find("'Z' is 100 times as long"), std::string::npos) << notes(document);
  for (const Json& plane : document["planes"]) EXPECT_TRUE(plane["name"] != "depth" || plane["max"] < 11) << plane;
}

TEST_F(CameraByPositions, DepthOfNoKindIsSaid) {
  SeenFrame seen;
  seen.stored_depth = [](double z, double) { return 1 - 0.5 / z; };
  seen.write(path("frame.exr"), {"P", "Z"});
  const Json document = info("frame.exr"), stated = info("frame.exr", {"--plane", "depth=Z"});
  EXPECT_NE(notes(document).find("depth: made from the positions, since 'Z' is neither their planar distance"),
            std::string::npos)
      << notes(document);
  for (const Json& plane : document["planes"]) EXPECT_TRUE(plane["name"] != "depth" || plane["max"] > 2) << plane;
  EXPECT_NE(notes(stated).find("depth: 'Z' is neither the planar distance"), std::string::npos) << notes(stated);
}

TEST_F(CameraByPositions, HalfFloatsFarOriginsAndBackgroundDoNotBreakIt) {
  SeenFrame half;
  half.is_half = true;
  half.is_background = [](int x, int y) { return (x / 20 + y / 20) % 3 == 0; };
  half.write(path("half.exr"), {"P", "Z"});
  expect_fit(info("half.exr"), half.camera, 0.5);

  SeenFrame far;
  far.camera.pose->position += dvec3(1e6, 0, -1e6);
  far.write(path("far.exr"), {"P", "Z"});
  const Json document = info("far.exr");
  expect_fit(document, far.camera, 1.5);
  EXPECT_NE(notes(document).find("the rounding of the positions makes"), std::string::npos) << notes(document);

  SeenFrame odd;
  odd.is_background = [](int x, int) { return x < 120; };
  for (const glm::vec3 background : {glm::vec3(INFINITY), glm::vec3(NAN), glm::vec3(-7, 3, 1), glm::vec3(1e10f)}) {
    odd.background_position = background;
    odd.write(path("odd.exr"), {"P"});
    const Json found = info("odd.exr");
    expect_fit(found, odd.camera, 0.01);
    EXPECT_NEAR(found["background_share"], 120.0 / 320, 1e-9) << background.x;
  }
}

/// Half of the positions are mixed with the background: alpha tells which.
TEST_F(CameraByPositions, PixelsOfPartsOfSurfacesAreLeftOut) {
  SeenFrame seen;
  seen.alpha = [](int x, int y) { return (x / 3 + y / 5) % 2 == 0 ? 0.4 : 1.0; };
  seen.write(path("frame.exr"), {"P", "A"});
  expect_fit(info("frame.exr"), seen.camera, 0.01);
  seen.write(path("without.exr"), {"P"});
  EXPECT_TRUE(info("without.exr")["camera"].is_null()) << "half of them contradict";
}

/// A header with worldToCamera alone tells the pose, and positions the lens.
TEST_F(CameraByPositions, ThePoseOfTheHeaderStays) {
  SeenFrame seen;
  seen.change = [&](Imf::Header& header) {
    const glm::dmat3 turn = seen.camera.pose->world_to_view;
    const dvec3 moved = -(turn * seen.camera.pose->position);
    Imath::M44f m;  // rows: where the world's axes lead; z ahead
    for (int row = 0; row < 3; ++row)
      for (int c = 0; c < 3; ++c) m[row][c] = float(turn[row][c] * (c == 2 ? -1 : 1));
    for (int c = 0; c < 3; ++c) m[3][c] = float(moved[c] * (c == 2 ? -1 : 1));
    header.insert("worldToCamera", Imf::M44fAttribute(m));
  };
  seen.write(path("frame.exr"), {"P", "Z", "N"});
  const Json document = info("frame.exr");
  expect_fit(document, seen.camera, 0.01);
  EXPECT_EQ(notes(document).find("does not fit"), std::string::npos) << notes(document);
  SeenFrame other = seen;
  other.change = [&](Imf::Header& header) {
    seen.change(header);
    header.typedAttribute<Imf::M44fAttribute>("worldToCamera").value()[3][0] += 0.5f;
  };
  other.write(path("other.exr"), {"P", "Z", "N"});
  EXPECT_NE(notes(info("other.exr")).find("does not fit the positions"), std::string::npos);
}

TEST_F(CameraByPositions, WindowsAndThePlaceInThePixelAreKept) {
  SeenFrame moved;
  moved.display = {-40, 25, 280, 205};
  moved.data = {-10, 40, 250, 190};
  moved.camera.cx = 120;
  moved.camera.cy = 115;
  moved.write(path("moved.exr"), {"P", "Z"});
  expect_fit(info("moved.exr"), moved.camera, 0.01);

  SeenFrame corner;
  corner.sample = {0, 0};
  corner.write(path("corner.exr"), {"P", "Z"});
  const Json document = info("corner.exr");
  EXPECT_NEAR(document["camera"]["cx"], 160.5, 0.01) << "depths are those of the corners as well";
  EXPECT_NE(notes(document).find("positions are those of the pixels' corners"), std::string::npos) << notes(document);
}

TEST_F(CameraByPositions, OrthographicCameras) {
  SeenFrame seen;
  seen.camera.orthographic = true;
  seen.camera.fx = seen.camera.fy = 40;
  seen.write(path("frame.exr"), {"P", "Z", "N"});
  const Json document = info("frame.exr");
  expect_fit(document, seen.camera, 0.01);
  EXPECT_EQ(document["camera"]["type"], "orthographic");
  expect_same_ao(seen, 1e-3);
  seen.write(path("frame.exr"), {"P", "N"});
  expect_same_ao(seen, 1e-3);
}

TEST_F(CameraByPositions, ViewsAreFittedEachByItself) {
  SeenFrame left, right;
  right.camera.pose->position += dvec3(0.1, 0, 0);
  right.camera.cx = 150;
  for (SeenFrame* eye : {&left, &right}) eye->write(path(eye == &left ? "f_left.exr" : "f_right.exr"), {"P", "Z", "N"});
  const Result run = gloam({"run", "stereo-evidence", path("f_left.exr"), path("f_right.exr"), "-o", path("out.exr")});
  ASSERT_EQ(run.status, 0) << run.err;
  FrameFile out(path("out.exr"), {});
  EXPECT_NEAR(out.camera("left")->cx, 160, 0.01);
  EXPECT_NEAR(out.camera("right")->cx, 150, 0.01);
  EXPECT_NEAR(out.camera("right")->pose->position.x - out.camera("left")->pose->position.x, 0.1, 1e-3);
}

TEST_F(CameraByPositions, FramesOfAShotAreFittedEachByItself) {
  SeenFrame seen;
  for (int frame = 1; frame <= 2; ++frame) {
    seen.camera.fx = seen.camera.fy = 200 + 50 * frame;
    seen.write(path(fmt::format("shot.{:04}.exr", frame)), {"P", "Z"});
  }
  const Json shot = gloam({"info", path("shot.####.exr"), "--json", "-"}).json();
  EXPECT_EQ(shot["frames"][1]["camera"], "fitted to positions");
  const Result run = gloam({"run", "ssao", path("shot.####.exr"), "-o", path("ao.####.exr"), "--radius", "1"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(FrameFile(path("ao.0001.exr"), {}).camera("")->fx, 250, 0.01);
  EXPECT_NEAR(FrameFile(path("ao.0002.exr"), {}).camera("")->fx, 300, 0.01);
}

TEST_F(CameraByPositions, WhatElseGivesACameraWins) {
  SeenFrame seen;
  seen.write(path("frame.exr"), {"P", "Z", "N"});
  const Json flagged = info("frame.exr", {"--fov", "65.2385"});  // 2 atan(160 / 250)
  EXPECT_EQ(flagged["camera_from"], "flag");
  EXPECT_EQ(flagged["normal_space"], "world") << "the pose is the fit's";
  EXPECT_EQ(notes(flagged).find("does not fit"), std::string::npos) << notes(flagged);
  const Json wrong = info("frame.exr", {"--fov", "40"});
  EXPECT_NEAR(wrong["camera"]["fx"], 160 / std::tan(20 * M_PI / 180), 1e-6);
  EXPECT_NE(notes(wrong).find("--fov does not fit the positions"), std::string::npos) << notes(wrong);

  seen.write_camera(path("frame.camera.json"));
  const Json beside = info("frame.exr");
  EXPECT_EQ(beside["camera_from"], "json");
  EXPECT_LT(beside["camera_residual_pixels"], 0.01);
  EXPECT_EQ(notes(beside).find("fit"), std::string::npos) << notes(beside);
}

TEST_F(CameraByPositions, ACameraFileOfAnotherFrameIsSaid) {
  SeenFrame seen, other;
  seen.write(path("frame.exr"), {"P", "Z", "N"});
  other.camera.pose->world_to_view = turned_view(0.55, -0.2);
  other.write_camera(path("frame.camera.json"));
  const Result run = gloam({"run", "gtao", path("frame.exr"), "-o", path("out.exr")});
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.err.find("frame.camera.json does not fit the positions: they lie"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("fx 250.00"), std::string::npos) << run.err;
  EXPECT_NEAR(FrameFile(path("out.exr"), {}).camera("")->pose->world_to_view[0][0], std::cos(0.55), 1e-6) << "but used";
}

TEST_F(CameraByPositions, PositionsInCameraSpaceAreRecognised) {
  for (const double ahead : {-1.0, 1.0}) {
    SeenFrame seen;
    seen.camera.pose->world_to_view = turned_view(1.2, -0.5);
    const Pose pose = *seen.camera.pose;
    seen.stored = [&](const dvec3& p) {
      const dvec3 v = pose.world_to_view * (p - pose.position);
      return dvec3(v.x, v.y, -ahead * v.z);
    };
    seen.write(path("frame.exr"), {"P", "Z", "N"});
    const Json document = info("frame.exr");
    expect_fit(document, seen.camera, 0.01);
    EXPECT_NE(notes(document).find("P is in camera space"), std::string::npos) << notes(document);
    EXPECT_TRUE(document["camera"]["position"].is_null());
    EXPECT_NE(notes(document).find("normals: not used"), std::string::npos) << "a world of unknown pose";
    seen.write(path("alone.exr"), {"P"});
    EXPECT_EQ(gloam({"run", "gtao", path("alone.exr"), "-o", path("out.exr")}).status, 0);
    seen.write_camera(path("frame.camera.json"));
    const Json beside = info("frame.exr");
    EXPECT_EQ(beside["normal_space"], "world");
    EXPECT_NE(notes(beside).find("P is in camera space and not used"), std::string::npos) << notes(beside);
    EXPECT_EQ(notes(beside).find("does not fit"), std::string::npos) << notes(beside);
    fs::remove(path("frame.camera.json"));
  }
}

TEST_F(CameraByPositions, WhatTellsNoCameraIsRefusedWithTheReason) {
  SeenFrame wall;
  wall.depth = [](const glm::dvec2&) { return 5.0; };
  wall.write(path("wall.exr"), {"P", "Z", "N"});
  const Json document = info("wall.exr");
  EXPECT_TRUE(document["camera"].is_null());
  EXPECT_TRUE(document["camera_from"].is_null());
  EXPECT_NE(notes(document).find("camera: not fitted to the positions P: all of them lie in one plane"),
            std::string::npos)
      << notes(document);
  EXPECT_EQ(document["camera_lines"].size(), 3u);
  const Result run = gloam({"run", "gtao", path("wall.exr"), "-o", path("out.exr")});
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.err.find("60 degrees is assumed"), std::string::npos) << run.err;

  wall.write(path("alone.exr"), {"P"});
  const Result alone = gloam({"run", "gtao", path("alone.exr"), "-o", path("none.exr")});
  EXPECT_EQ(alone.status, 1);
  EXPECT_NE(alone.err.find("alone.exr: has no depth, and none can be made from its positions: all of them"),
            std::string::npos)
      << alone.err;
  EXPECT_FALSE(fs::exists(path("none.exr")));
  EXPECT_EQ(gloam({"info", path("alone.exr")}).status, 0);

  SeenFrame empty;
  empty.is_background = [](int, int) { return true; };
  empty.write(path("empty.exr"), {"P"});
  EXPECT_NE(notes(info("empty.exr")).find("0 of the pixels looked at show one"), std::string::npos);
}

TEST_F(CameraByPositions, ATiltedPlaneIsFittedByASaidAssumption) {
  SeenFrame seen;
  seen.depth = [](const glm::dvec2& p) { return 1 / (0.05 + 0.0006 * p.y + 0.0002 * p.x); };
  seen.write(path("frame.exr"), {"P", "Z"});
  const Json document = info("frame.exr");
  expect_fit(document, seen.camera, 0.1);
  EXPECT_NE(notes(document).find("square pixels and a centred lens are assumed"), std::string::npos) << notes(document);
}

/// pbrt's matrices are for column vectors, and its NDC covers the shorter side. At (0, 0, 0), looking along +z, 90 degrees over the
/// height of 180 pixels.
TEST_F(CameraByPositions, MatricesOfPbrt) {
  SeenFrame seen;
  seen.change = [](Imf::Header& header) {
    // Columns of a row-vector matrix stand in rows here: x' = x, y' = y, z' = z, moved by (1, 2, 3).
    header.insert("worldToCamera", Imf::M44fAttribute(Imath::M44f(1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1)));
    // x: 0.5 (x + 1) + 0.5 w, y the same, w = z + 3.
    header.insert("worldToNDC",
                  Imf::M44fAttribute(Imath::M44f(0.5, 0, 0.5, 2, 0, 0.5, 0.5, 2.5, 0, 0, 1, 2.9f, 0, 0, 1, 3)));
  };
  seen.write(path("frame.exr"), {"Z"});
  const Json document = info("frame.exr");
  EXPECT_EQ(document["camera_from"], "header") << notes(document);
  EXPECT_NEAR(document["camera"]["fx"], 90, 1e-3);
  EXPECT_NEAR(document["camera"]["fy"], 90, 1e-3);
  EXPECT_NEAR(document["camera"]["cx"], 160, 1e-3);
  EXPECT_NEAR(document["camera"]["cy"], 90, 1e-3);
  EXPECT_EQ(document["camera"]["position"], Json({-1, -2, -3}));
  EXPECT_NE(notes(document).find("as pbrt writes them"), std::string::npos) << notes(document);
}

/// A header as Unreal writes it, over positions that show that it is read right.
TEST_F(CameraByPositions, UnrealsAttributesLeadToThePositions) {
  SeenFrame seen;
  seen.camera.pose->position = {100, 200, 300};
  // Looks along +y of Unreal's left-handed world: right is -x, up is z.
  seen.camera.pose->world_to_view = glm::dmat3(-1, 0, 0, 0, 0, -1, 0, 1, 0);
  seen.change = [](Imf::Header& header) {
    const std::map<std::string, std::string> texts = {{"curPos/x", "100"},
                                                      {"curPos/y", "200"},
                                                      {"curPos/z", "300"},
                                                      {"curRot/pitch", "0"},
                                                      {"curRot/yaw", "90"},
                                                      {"curRot/roll", "0"},
                                                      {"FinalImage/fov", "65.238490"}};
    for (const auto& [name, text] : texts) header.insert("unreal/camera/" + name, Imf::StringAttribute(text));
  };
  seen.write(path("frame.exr"), {"P", "Z", "N"});
  const Json document = info("frame.exr");
  EXPECT_EQ(document["camera_from"], "header");
  EXPECT_LT(document["camera_residual_pixels"], 0.01) << notes(document);
}

/// What a renderer's frame without camera and positions leads to: three lines for Blender.
TEST_F(CameraByPositions, InfoPrintsThreeLinesForBlender) {
  SeenFrame seen;
  seen.change = [](Imf::Header& header) { header.insert("Frame", Imf::StringAttribute("0042")); };
  seen.write(path("shot \"a\".exr"), {"Z", "N"});
  const std::string of_anybody = gloam({"info", path("shot \"a\".exr")}).out;
  EXPECT_EQ(of_anybody.find("import bpy"), std::string::npos) << "the file of another program";
  EXPECT_NE(of_anybody.find("The camera is not known: --fov DEG"), std::string::npos) << of_anybody;
  seen.change = [](Imf::Header& header) {  // as Blender stamps a file of one layer
    for (const auto& [name, text] : std::map<std::string, std::string>{
             {"Frame", "0042"}, {"Scene", "Scene"}, {"File", "<untitled>"}, {"Date", "2026/11/21 00:23:10"}})
      header.insert(name, Imf::StringAttribute(text));
  };
  seen.write(path("shot \"a\".exr"), {"Z", "N"});
  const std::string out = gloam({"info", path("shot \"a\".exr")}).out;
  const size_t start = out.find("import bpy, json");
  ASSERT_NE(start, std::string::npos) << out;
  EXPECT_NE(out.find("s.frame_set(42)"), std::string::npos) << out;
  EXPECT_NE(out.find("/shot \\\"a\\\".camera.json\", \"w\")"), std::string::npos) << out;
  EXPECT_EQ(std::count(out.begin() + long(start), out.end(), '\n'), 3) << out;
  seen.write_camera(path("camera.json"));
  const std::string known = gloam({"info", path("shot \"a\".exr")}).out;
  EXPECT_EQ(known.find("import bpy"), std::string::npos);
  EXPECT_EQ(known.find("The camera is not known"), std::string::npos);
}

class BlenderCamera : public CameraByPositions {
 protected:
  int blender(const std::string& arguments) const {
    return std::system(fmt::format("blender -b {} >>'{}' 2>&1", arguments, path("blender.log").string()).c_str());
  }
};

/// The lines, run in Blender on the scene of the frame, write a camera that leads to Blender's own positions.
TEST_F(BlenderCamera, LinesWriteTheCameraOfTheFrame) {
  if (std::system("command -v blender >/dev/null") != 0) GTEST_SKIP() << "no blender to run the lines in";
  ASSERT_EQ(
      blender(fmt::format("--factory-startup --python-exit-code 1 -P '{}/tests/blender/render_positions.py' -- '{}'",
                          GLOAM_SOURCE_DIR, folder.string())),
      0)
      << slurp(path("blender.log"));
  for (const std::string name : {"shift", "ortho", "eyes"}) {
    const Json before = info(name + ".exr", {"--plane", "position=none"});
    ASSERT_EQ(before["camera_lines"].size(), 3u) << name;
    std::string lines;
    for (const std::string line : before["camera_lines"]) lines += line + "\n";
    std::ofstream(path("lines.py")) << lines;
    ASSERT_EQ(blender(fmt::format("'{0}/{1}.blend' --python-exit-code 1 --python-expr \"$(cat '{0}/lines.py')\"",
                                  folder.string(), name)),
              0)
        << slurp(path("blender.log"));
    const Json fitted = info(name + ".exr", {"--camera", path(name + ".camera.json")});
    const Json after = info(name + ".exr");
    EXPECT_EQ(after["camera_from"], "json") << name;
    EXPECT_EQ(after["camera"], fitted["camera"]);
    for (const auto& [view, camera] : after["cameras"].items())
      EXPECT_LT(camera["residual_pixels"], 0.01) << name << view;
    fs::remove(path(name + ".camera.json"));
    const Json fit = info(name + ".exr");
    EXPECT_EQ(fit["camera_from"], "fit") << name;
    for (const char* number : {"fx", "fy", "cx", "cy"})
      EXPECT_NEAR(fit["camera"][number], after["camera"][number], 0.01) << name << ' ' << number;
  }
}

}  // namespace
}  // namespace gloam::test::camera_fit_test
