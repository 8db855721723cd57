// Cameras: found beside a frame, read from JSON, read from and written to OpenEXR's matrices.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "camera/camera_json.h"
#include "camera/camera_search.h"
#include "camera/matrices.h"
#include "frame/field_of_view.h"
#include "gloam/error.h"
#include "unit/read_channel.h"

namespace gloam::camera_test {
namespace {

namespace fs = std::filesystem;
using namespace gloam;
using glm::dvec2;
using glm::dvec3;
using gloam::test::read_channel;
using gloam::test::read_vector;
using nlohmann::json;

const Window hd{0, 0, 960, 540};

/// The definition in camera.h, written out.
dvec2 pixel_of(const Camera& camera, const dvec3& world) {
  const dvec3 view = camera.pose->world_to_view * (world - camera.pose->position);
  const double reach = camera.orthographic ? 1 : -view.z;
  return {camera.cx + camera.fx * view.x / reach, camera.cy - camera.fy * view.y / reach};
}

dvec3 world_of(const Camera& camera, const dvec2& pixel, double depth) {
  const double reach = camera.orthographic ? 1 : depth;
  const dvec3 view((pixel.x - camera.cx) / camera.fx * reach, (camera.cy - pixel.y) / camera.fy * reach, -depth);
  return camera.pose->position + glm::transpose(camera.pose->world_to_view) * view;
}

void expect_near(const dvec3& a, const dvec3& b, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

void expect_near(const dvec2& a, const dvec2& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
}

/// The message that `call` throws: one line that holds every one of `parts`.
template <typename Call>
void expect_error(Call call, const std::vector<std::string>& parts) {
  try {
    call();
  } catch (const Error& e) {
    const std::string message = e.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    for (const std::string& part : parts)
      EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is not in: " << message;
    return;
  }
  ADD_FAILURE() << "no Error, expected one with '" << parts.front() << "'";
}

/// A folder of its own for each test, removed afterwards.
class CameraFile : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::temp_directory_path() / (std::string("gloam_camera_") + info->name());
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return folder / name;
  }
  fs::path write(const json& document) const { return write("camera.json", document.dump()); }
  std::map<std::string, Camera> read(const json& document, const Window& display = hd) {
    return read_camera_file(write(document), display, assumed);
  }
  std::string found(const std::string& frame) const {
    const auto file = find_camera_file(folder / frame);
    return file ? file->filename().string() : "none";
  }
  void expect_refused(const json& document, const std::vector<std::string>& parts) {
    std::vector<std::string> all = {(folder / "camera.json").string()};
    all.insert(all.end(), parts.begin(), parts.end());
    expect_error([&] { read(document); }, all);
  }

  fs::path folder;
  std::vector<std::string> assumed;
};

/// A camera at (1, 2, 3) that looks along the world's +x with +z up: right is -y.
json looking_along_x() {
  return json::parse(R"({
    "width": 960, "height": 540, "near": 0.1, "far": 50, "camera_type": "PERSP",
    "views": [{"view": "mono", "fx": 600, "fy": 500, "cx": 470, "cy": 280,
      "camera_to_world": [[0, 0, -1, 1], [-1, 0, 0, 2], [0, 1, 0, 3], [0, 0, 0, 1]]}]})");
}

// --- Finding the file

TEST_F(CameraFile, LongestPrefixWins) {
  for (const char* name : {"garden.camera.json", "garden_ortho.camera.json", "garden_lens_shift.camera.json",
                           "apartment_stereo.camera.json", "apartment_mono.camera.json"})
    write(name, "{}");
  EXPECT_EQ(found("garden_ortho.exr"), "garden_ortho.camera.json");
  EXPECT_EQ(found("garden_lens_shift.exr"), "garden_lens_shift.camera.json");
  EXPECT_EQ(found("garden_rgbaz_openexr_float.exr"), "garden.camera.json");
  EXPECT_EQ(found("apartment_mono.0001.exr"), "apartment_mono.camera.json");
  EXPECT_EQ(found("apartment_individual_L.exr"), "none");
  EXPECT_EQ(found("gard.exr"), "none");
  // Whatever the order in which the folder lists them.
  write("shot.0001.camera.json", "{}");
  write("shot.camera.json", "{}");
  EXPECT_EQ(found("shot.0001.exr"), "shot.0001.camera.json");
  EXPECT_EQ(found("shot.0002.exr"), "shot.camera.json");
}

TEST_F(CameraFile, CameraJsonOfTheFolderServesTheRest) {
  write("camera_stereo.json", "{}");
  EXPECT_EQ(found("kitchen_user.exr"), "camera_stereo.json");
  write("kitchen.camera.json", "{}");
  EXPECT_EQ(found("kitchen_user.exr"), "kitchen.camera.json");
  EXPECT_EQ(found("garden.exr"), "camera_stereo.json");
}

TEST_F(CameraFile, TwoCandidatesAreAnErrorThatNamesBoth) {
  write("camera.json", "{}");
  write("camera_stereo.json", "{}");
  expect_error([&] { found("kitchen.exr"); }, {"kitchen.exr", "camera.json", "camera_stereo.json", "--camera"});
  write("kitchen.camera.json", "{}");
  EXPECT_EQ(found("kitchen.exr"), "kitchen.camera.json");
  write("kitchen.json", looking_along_x().dump());
  expect_error([&] { found("kitchen.exr"); }, {"kitchen.camera.json", "kitchen.json"});
}

TEST_F(CameraFile, OtherJsonCountsOnlyWhenItHoldsACamera) {
  write("shot.json", R"({"size": [4, 4], "views": ["left", "right"], "camera": {"fx": 3}})");  // as `gloam info` writes
  write("sho.json", "[1, 2");
  write("sh.json", "[1, 2]");
  write("s.json", R"({"views": []})");
  fs::create_directory(folder / "shot.camera.json");
  EXPECT_EQ(found("shot.exr"), "none");
  write("sho.json", looking_along_x().dump());
  EXPECT_EQ(found("shot.exr"), "sho.json");
  EXPECT_EQ(find_camera_file(folder / "absent" / "shot.exr"), std::nullopt);
}

// --- Reading JSON

TEST_F(CameraFile, PixelsAndPoseAsWritten) {
  const Camera camera = read(looking_along_x()).at("");
  EXPECT_FALSE(camera.orthographic);
  EXPECT_EQ(camera.near, 0.1);
  EXPECT_EQ(camera.far, 50);
  EXPECT_EQ(camera.source, "camera.json");
  EXPECT_EQ(camera.pose->position, dvec3(1, 2, 3));
  EXPECT_TRUE(assumed.empty());
  // 10 along the axis, 2 to the right (-y), 1 up.
  expect_near(pixel_of(camera, {11, 0, 4}), {470 + 600 * 0.2, 280 - 500 * 0.1}, 1e-9);
}

TEST_F(CameraFile, WorldToCameraSuffices) {
  json document = looking_along_x();
  json& view = document["views"][0];
  view.erase("camera_to_world");
  view["world_to_camera"] = {{0, -1, 0, 2}, {0, 0, 1, -3}, {-1, 0, 0, 1}, {0, 0, 0, 1}};
  const Camera camera = read(document).at("");
  expect_near(camera.pose->position, {1, 2, 3}, 1e-12);
  expect_near(pixel_of(camera, {11, 0, 4}), {590, 230}, 1e-9);
}

TEST_F(CameraFile, PerspectiveFromProjection) {
  json document = looking_along_x();
  json& view = document["views"][0];
  for (const char* field : {"fx", "fy", "cx", "cy"}) view.erase(field);
  document.erase("camera_type");
  // Left -0.5, right 1, bottom -0.25, top 0.75 at near 0.5.
  view["projection_gl"] = {{2 * 0.5 / 1.5, 0, 0.5 / 1.5, 0}, {0, 2 * 0.5 / 1, 0.5, 0}, {0, 0, -1.1, -1}, {0, 0, -1, 0}};
  const Camera camera = read(document).at("");
  EXPECT_FALSE(camera.orthographic);
  const dvec3 along_axis(1 + 2, 2, 3);  // depth 2: the frustum is 4 times what it is at near
  expect_near(pixel_of(camera, along_axis + dvec3(0, 2, -1)), {0, 540}, 1e-9);
  expect_near(pixel_of(camera, along_axis + dvec3(0, -4, 3)), {960, 0}, 1e-9);
}

TEST_F(CameraFile, OrthographicFromProjectionAndFromPixels) {
  json document = looking_along_x();
  json& view = document["views"][0];
  for (const char* field : {"fx", "fy", "cx", "cy"}) view.erase(field);
  document["camera_type"] = "ORTHO";
  // Left -4, right 12, bottom -3, top 6.
  view["projection_gl"] = {{2 / 16.0, 0, 0, -0.5}, {0, 2 / 9.0, 0, -1 / 3.0}, {0, 0, -0.1, -1}, {0, 0, 0, 1}};
  const Camera derived = read(document).at("");
  EXPECT_TRUE(derived.orthographic);
  EXPECT_NEAR(derived.fx, 60, 1e-9);
  EXPECT_NEAR(derived.fy, 60, 1e-9);
  expect_near(pixel_of(derived, {9, 2 + 4, 3 - 3}), {0, 540}, 1e-9);
  expect_near(pixel_of(derived, {7, 2 - 12, 3 + 6}), {960, 0}, 1e-9);

  view.erase("projection_gl");
  view["pixels_per_unit"] = 20;
  view["cx"] = 480;
  view["cy"] = 270;
  expect_near(pixel_of(read(document).at(""), {5, 2 - 3, 3 + 1}), {540, 250}, 1e-9);
}

TEST_F(CameraFile, ViewsByNameAndOneViewWithout) {
  json document = looking_along_x();
  document["views"].push_back(document["views"][0]);
  document["views"][0]["view"] = "left";
  document["views"][1]["view"] = "right";
  document["views"][1]["cx"] = 490;
  auto cameras = read(document);
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras.at("left").cx, 470);
  EXPECT_EQ(cameras.at("right").cx, 490);
  document["views"][1]["view"] = "left";
  expect_refused(document, {"views[1].view", "left"});
  document["views"].erase(1);
  EXPECT_TRUE(read(document).contains(""));

  json flat = looking_along_x();
  flat.update(flat["views"][0]);
  flat.erase("views");
  EXPECT_EQ(read(flat).at("").fx, 600);
}

TEST_F(CameraFile, ScaledAndMovedToTheDisplayWindow) {
  const Camera camera = read(looking_along_x(), {100, -50, 100 + 480, -50 + 270}).at("");
  EXPECT_DOUBLE_EQ(camera.fx, 300);
  EXPECT_DOUBLE_EQ(camera.fy, 250);
  EXPECT_DOUBLE_EQ(camera.cx, 100 + 235);
  EXPECT_DOUBLE_EQ(camera.cy, -50 + 140);
  ASSERT_EQ(assumed.size(), 1u);
  EXPECT_NE(assumed[0].find("960x540"), std::string::npos) << assumed[0];
  EXPECT_NO_THROW(read(looking_along_x(), {0, 0, 107, 60}));  // 106.67 x 60 in whole pixels
  expect_error([&] { read(looking_along_x(), {0, 0, 540, 540}); }, {"width", "960x540", "540x540"});
}

TEST_F(CameraFile, DistantPositionKeepsItsDigits) {
  json document = looking_along_x();
  document["views"][0]["camera_to_world"][0][3] = 10000000.065;
  EXPECT_EQ(read(document).at("").pose->position.x, 10000000.065);
}

TEST_F(CameraFile, FloatRotationsBecomeOrthonormal) {
  json document = looking_along_x();
  json& m = document["views"][0]["camera_to_world"];
  const double c = float(std::cos(0.7)), s = float(std::sin(0.7));
  m = {{c, -s, 3e-6, 1}, {s, c, 0, 2}, {0, 0, 1.00002, 3}, {0, 0, 0, 1}};
  const glm::dmat3 rotation = read(document).at("").pose->world_to_view;
  const glm::dmat3 product = rotation * glm::transpose(rotation);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(product[i][j], i == j, 1e-15);
  EXPECT_NEAR(rotation[0][0], c, 1e-5);
  EXPECT_NEAR(rotation[0][1], -s, 1e-5);  // the transpose of what was written: row 1, column 0
}

TEST_F(CameraFile, RefusedInOneLine) {
  const auto refused = [&](auto change, const std::vector<std::string>& parts) {
    json document = looking_along_x();
    change(document, document["views"][0]);
    expect_refused(document, parts);
  };
  refused([](json&, json& v) { v["fx"] = "wide"; }, {"views[0].fx", "string", "number"});
  refused([](json&, json& v) { v["fy"] = -1; }, {"views[0].fy", "-1", "> 0"});
  refused([](json&, json& v) { v.erase("fx"); }, {"views[0].fx", "missing", "projection_gl"});
  refused([](json&, json& v) { v.erase("cy"); }, {"views[0].cy", "missing"});
  refused([](json&, json& v) { v["fx"] = nullptr; }, {"views[0].fx", "missing"});
  refused([](json&, json& v) { v.erase("camera_to_world"); }, {"views[0].camera_to_world", "world_to_camera"});
  refused([](json&, json& v) { v["camera_to_world"].erase(3); }, {"camera_to_world", "4x4"});
  refused([](json&, json& v) { v["camera_to_world"][1].erase(3); }, {"camera_to_world", "4x4"});
  refused([](json&, json& v) { v["camera_to_world"][1][2] = "a"; }, {"camera_to_world[1][2]", "finite number"});
  refused([](json&, json& v) { v["camera_to_world"][1][2] = nullptr; }, {"camera_to_world[1][2]", "finite number"});
  refused([](json&, json& v) { v["camera_to_world"][0][0] = 0.01; }, {"camera_to_world", "scales or shears"});
  refused([](json&, json& v) { v["camera_to_world"][2][1] = -1; }, {"camera_to_world", "mirrors"});
  refused([](json&, json& v) { v["camera_to_world"][2][1] = 0; }, {"camera_to_world", "singular"});
  refused([](json&, json& v) { v["camera_to_world"][3][0] = 0.5; }, {"camera_to_world", "last row"});
  refused(
      [](json&, json& v) {
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) v["camera_to_world"][i][j] = 2 * v["camera_to_world"][i][j].get<double>();
      },
      {"camera_to_world", "scales by 2"});
  refused([](json& d, json&) { d["near"] = 0; }, {"near", "0", "> 0"});
  refused([](json& d, json&) { d["far"] = 0.05; }, {"far", "0.05", "near, 0.1"});
  refused([](json& d, json&) { d["width"] = {960}; }, {"width", "array", "number"});
  refused([](json& d, json&) { d["camera_type"] = "PANO"; }, {"camera_type", "PANO", "PERSP or ORTHO"});
  refused([](json& d, json&) { d["camera_type"] = 3; }, {"camera_type", "number", "text"});
  refused([](json& d, json&) { d["camera_type"] = "ORTHO"; }, {"pixels_per_unit", "missing"});
  refused([](json& d, json&) { d["views"] = 3; }, {"views", "list"});
  refused([](json& d, json&) { d["views"] = json::array(); }, {"views", "empty"});
  refused([](json& d, json&) { d["views"][0] = 3; }, {"views[0]", "object"});
  refused([](json&, json& v) { v["view"] = 3; }, {"views[0].view", "text"});
  refused(
      [](json&, json& v) {
        v["projection_gl"] = {{1, 0.1, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, -1}, {0, 0, -1, 0}};
      },
      {"projection_gl", "mixes"});
  // The message names the position of the field.
  refused([](json& d, json&) { d["near"] = "x"; }, {"camera.json: near is"});
}

TEST_F(CameraFile, UnreadableJson) {
  const auto refused = [&](const std::string& text, const std::vector<std::string>& parts) {
    expect_error([&] { read_camera_file(write("camera.json", text), hd, assumed); }, parts);
  };
  refused("{\"views\": [", {"camera.json", "JSON", "parse error"});
  refused("", {"camera.json", "JSON"});
  refused("{\"near\": Nan}", {"camera.json", "JSON"});
  refused("{", {"camera.json", "JSON"});
  refused("{\"view\": \"\xff\"}", {"camera.json", "JSON", "UTF-8"});
  refused("{\"near\":\n\n1e999}", {"camera.json", "JSON"});
  refused("[1]", {"camera.json", "array", "views"});
  expect_error([&] { read_camera_file(folder / "absent.json", hd, assumed); }, {"absent.json"});
}

/// Python writes NaN and Infinity, which JSON does not know.
TEST_F(CameraFile, LiteralsOfPythonAreNotFinite) {
  const auto refused = [&](const char* field, const std::string& literal) {
    json document = looking_along_x();
    document["note"] = "a \\\" quoted NaN";
    document[field] = "HERE";
    std::string text = document.dump();
    text.replace(text.find("\"HERE\""), 6, literal);
    expect_error([&] { read_camera_file(write("camera.json", text), hd, assumed); },
                 {"camera.json", std::string(field) + " is not finite"});
  };
  refused("near", "NaN");
  refused("far", "Infinity");
  refused("near", "-Infinity");
  json document = looking_along_x();
  document["note"] = "NaN, \\\" Infinity";
  EXPECT_EQ(read(document).size(), 1u);
}

TEST_F(CameraFile, ValuesThatNoCameraHas) {
  const auto refused = [&](const char* field, double value, const std::string& part) {
    json document = looking_along_x();
    (std::string(field) == "near" ? document : document["views"][0])[field] = value;
    expect_refused(document, {field, part});
  };
  refused("fx", 1.1e7, "1e7");
  refused("fx", 1e-50, "1e-6");
  refused("fy", 1.1e7, "1e7");
  refused("cx", -1.1e6, "1e6");
  refused("cy", 1.1e6, "1e6");
  refused("near", 50, "more than near");
}

TEST_F(CameraFile, JsonThatMayHaveMeantToBeACameraIsNoted) {
  const auto notes_for = [&](const std::string& name, const std::string& text) {
    for (const auto& entry : fs::directory_iterator(folder)) fs::remove(entry);
    write(name, text);
    std::vector<std::string> notes;
    EXPECT_FALSE(find_camera_file(folder / "frame.exr", &notes));
    std::string all;
    for (const std::string& note : notes) all += note + "\n";
    return all;
  };
  for (const char* text : {"", "{", "{\"fx\": \"\xff\"}", "{\"views\": {\"left\": 3}}", "{\"views\": [{\"name\": 3}]}"})
    EXPECT_NE(notes_for("frame.json", text).find("frame.json is there but is no camera ("), std::string::npos) << text;
  EXPECT_EQ(notes_for("frame.json", "{\"planes\": [], \"views\": [\"left\"]}"), "") << "gloam info writes this";
  EXPECT_EQ(notes_for("frame.json", "{\"fps\": 24}"), "");
  EXPECT_EQ(notes_for("other.json", "{"), "");
  // With NaN in it, it still is a camera, and reading it reports the fault.
  for (const char* name : {"frame.json", "frame.camera.json", "camera_b.json"}) {
    for (const auto& entry : fs::directory_iterator(folder)) fs::remove(entry);
    write(name, "{\"fx\": NaN}");
    EXPECT_EQ(found("frame.exr"), name);
  }
}

// --- Header matrices, written by hand

const double nan = std::numeric_limits<double>::quiet_NaN();

// Row vectors: (x, y, z, 1) * M. A camera at (1, 2, 3) of a right-handed world with y up, looking along -z:
// OpenEXR's camera space is x' = x - 1, y' = y - 2, z' = 3 - z.
const Imath::M44d at_123(1, 0, 0, 0,   //
                         0, 1, 0, 0,   //
                         0, 0, -1, 0,  //
                         -1, -2, 3, 1);

// 100x50 pixels, fx = fy = 100, centred: u = 0.5 + x'/z', v = 0.5 - 2 y'/z', w = z', near 0.1 and far infinite.
// u w = x' + z'/2 = x - 1 + 1.5 - z/2;  v w = -2y' + z'/2 = -2y + 4 + 1.5 - z/2
const Imath::M44d ndc_123(1, 0, 0, 0,          //
                          0, -2, 0, 0,         //
                          -0.5, -0.5, -1, -1,  //
                          0.5, 5.5, 2.9, 3);
const Window small{0, 0, 100, 50};

TEST(CameraFromMatrices, Perspective) {
  const Camera camera = camera_from_matrices(at_123, ndc_123, small, dvec3(0));
  EXPECT_FALSE(camera.orthographic);
  EXPECT_NEAR(camera.fx, 100, 1e-12);
  EXPECT_NEAR(camera.fy, 100, 1e-12);
  EXPECT_NEAR(camera.cx, 50, 1e-12);
  EXPECT_NEAR(camera.cy, 25, 1e-12);
  EXPECT_EQ(camera.source, "header");
  expect_near(camera.pose->position, {1, 2, 3}, 1e-12);
  EXPECT_EQ(camera.pose->world_to_view, glm::dmat3(1.0));
  expect_near(pixel_of(camera, {2, 3, -7}), {60, 15}, 1e-12);
}

TEST(CameraFromMatrices, OriginIsAddedInDouble) {
  const dvec3 origin(1e7, -2e7, 0.065);
  const Camera camera = camera_from_matrices(at_123, ndc_123, small, origin);
  EXPECT_EQ(camera.pose->position, origin + dvec3(1, 2, 3));
}

TEST(CameraFromMatrices, OffAxisAndDisplayWindowElsewhere) {
  // Principal point at 0.75 of the width and 0.3 of the height; a window whose corner is (-20, 300).
  // u w = x' + 0.75 z', v w = -2 y' + 0.3 z'
  const Imath::M44d ndc(1, 0, 0, 0,           //
                        0, -2, 0, 0,          //
                        -0.75, -0.3, -1, -1,  //
                        1.25, 4.9, 2.9, 3);   // -1 + 2.25, 4 + 0.9
  const Camera camera = camera_from_matrices(at_123, ndc, {-20, 300, 80, 350}, dvec3(0));
  EXPECT_NEAR(camera.cx, -20 + 75, 1e-12);
  EXPECT_NEAR(camera.cy, 300 + 15, 1e-12);
  EXPECT_NEAR(camera.fx, 100, 1e-12);
  EXPECT_NEAR(camera.fy, 100, 1e-12);
  expect_near(pixel_of(camera, {2, 3, -7}), {65, 305}, 1e-12);
}

TEST(CameraFromMatrices, TurnedCamera) {
  // At (1, 2, 3), looking along the world's +x, z up, right = -y: x' = -(y - 2), y' = z - 3, z' = x - 1.
  const Imath::M44d world_to_camera(0, 0, 1, 0,   //
                                    -1, 0, 0, 0,  //
                                    0, 1, 0, 0,   //
                                    2, -3, -1, 1);
  // u w = x' + z'/2 = -y + 2 + x/2 - 1/2;  v w = -2 z + 6 + x/2 - 1/2;  w = x - 1
  const Imath::M44d world_to_ndc(0.5, 0.5, 1, 1,  //
                                 -1, 0, 0, 0,     //
                                 0, -2, 0, 0,     //
                                 1.5, 5.5, -1.1, -1);
  const Camera camera = camera_from_matrices(world_to_camera, world_to_ndc, small, dvec3(0));
  EXPECT_NEAR(glm::determinant(camera.pose->world_to_view), 1, 1e-12);
  expect_near(camera.pose->position, {1, 2, 3}, 1e-12);
  expect_near(camera.pose->world_to_view * dvec3(1, 0, 0), {0, 0, -1}, 1e-12);
  expect_near(camera.pose->world_to_view * dvec3(0, 0, 1), {0, 1, 0}, 1e-12);
  expect_near(pixel_of(camera, {11, 1, 4}), {60, 15}, 1e-12);
}

TEST(CameraFromMatrices, Orthographic) {
  // 20 pixels per unit: u = 0.6 + x'/5, v = 0.2 - 2 y'/5, z' from 0 to 10.
  const Imath::M44d ndc(0.2, 0, 0, 0,   //
                        0, -0.4, 0, 0,  //
                        0, 0, -0.1, 0,  //
                        0.4, 1.0, 0.3, 1);
  const Camera camera = camera_from_matrices(at_123, ndc, {10, 0, 110, 50}, dvec3(0));
  EXPECT_TRUE(camera.orthographic);
  EXPECT_NEAR(camera.fx, 20, 1e-12);
  EXPECT_NEAR(camera.fy, 20, 1e-12);
  EXPECT_NEAR(camera.cx, 10 + 60, 1e-12);
  EXPECT_NEAR(camera.cy, 10, 1e-12);
  expect_near(pixel_of(camera, {2, 3, -7}), {90, -10}, 1e-12);
}

TEST(CameraFromMatrices, ProjectiveScaleMeansNothing) {
  const Camera camera = camera_from_matrices(at_123, ndc_123 * -3.0, small, dvec3(0));
  EXPECT_NEAR(camera.fx, 100, 1e-12);
  EXPECT_NEAR(camera.cy, 25, 1e-12);
}

TEST(CameraFromMatrices, LeftHandedWorldStillProjects) {
  // A world with z forwards: x' = x, y' = y, z' = z, determinant +1.
  const Imath::M44d ndc(1, 0, 0, 0,      //
                        0, -2, 0, 0,     //
                        0.5, 0.5, 1, 1,  //
                        0, 0, -0.1, 0);
  const Camera camera = camera_from_matrices(Imath::M44d(), ndc, small, dvec3(0));
  EXPECT_NEAR(glm::determinant(camera.pose->world_to_view), -1, 1e-12);
  expect_near(pixel_of(camera, {1, 1, 10}), {60, 15}, 1e-12);
  expect_near(camera.pose->world_to_view * dvec3(0, 0, -1), {0, 0, 1}, 1e-12);  // a wall that faces the camera
}

TEST(CameraFromMatrices, RefusedInOneLine) {
  const auto refused = [](auto change, const std::vector<std::string>& parts) {
    Imath::M44d world_to_camera = at_123, world_to_ndc = ndc_123;
    change(world_to_camera, world_to_ndc);
    expect_error([&] { camera_from_matrices(world_to_camera, world_to_ndc, small, dvec3(0)); }, parts);
  };
  // Changes of the camera are written as matrices between camera and NDC: ndc = camera * p.
  const auto with_projection = [](const Imath::M44d& p) {
    return [p](Imath::M44d&, Imath::M44d& n) { n = at_123 * p; };
  };
  refused([](Imath::M44d& c, Imath::M44d&) { c[1][2] = nan; }, {"worldToCamera", "not finite"});
  refused([](Imath::M44d&, Imath::M44d& n) { n[3][0] = 1 / 0.0; }, {"worldToNDC", "not finite"});
  refused([](Imath::M44d& c, Imath::M44d&) { c = Imath::M44d(0.0); }, {"worldToCamera"});
  refused([](Imath::M44d& c, Imath::M44d&) { c[0][0] = 0; }, {"worldToCamera", "singular"});
  refused([](Imath::M44d& c, Imath::M44d&) { c[2][3] = 1; }, {"worldToCamera", "last column"});
  refused([](Imath::M44d& c, Imath::M44d&) { c[0][1] = 0.3; }, {"worldToCamera", "shears"});
  refused(
      [](Imath::M44d& c, Imath::M44d&) {
        for (int i = 0; i < 3; ++i) c[i][i] *= 100;
      },
      {"worldToCamera", "scales by 100"});
  refused([](Imath::M44d&, Imath::M44d& n) { n = Imath::M44d(0.0); }, {"worldToNDC", "singular"});
  refused(with_projection({-1, 0, 0, 0, 0, -2, 0, 0, .5, .5, 1, 1, 0, 0, -.1, 0}), {"worldToNDC", "mirrors"});
  refused(with_projection({1, .2, 0, 0, -.1, -2, 0, 0, .5, .5, 1, 1, 0, 0, -.1, 0}), {"worldToNDC", "shears or turns"});
  refused(with_projection({1, 0, 0, .1, 0, -2, 0, 0, .5, .5, 1, 1, 0, 0, -.1, 0}), {"worldToNDC", "tilts"});
  refused(with_projection({1, 0, 0, 0, 0, -2, 0, 0, .2, 0, 1, 0, .5, .5, 0, 1}), {"worldToNDC", "oblique"});
  refused(with_projection({1, 0, 0, 0, 0, -2, 0, 0, .5, .5, 1, 1, 0, 0, -.1, .2}),
          {"worldToNDC", "centre of projection"});
  expect_error([&] { camera_from_matrices(at_123, ndc_123, small, dvec3(0, nan, 0)); }, {"gloamOrigin"});
}

/// For row vectors: a matrix multiplied from the right is applied later.
const Imath::M44d looks_back(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1);
const Imath::M44d y_up(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 1);
const Imath::M44d symmetric_y_up(2, 0, 0, 0, 0, -2, 0, 0, 0, 0, 1, 0, -1, 1, 0, 1);

/// OpenEXR's own form, Arnold's, and other possible ones: one camera.
TEST(CameraFromMatrices, EveryFormTellsTheSameCamera) {
  for (const bool orthographic : {false, true}) {
    Camera camera;
    camera.orthographic = orthographic;
    camera.fx = orthographic ? 20 : 150;
    camera.fy = orthographic ? 25 : 140;
    camera.cx = 60;  // off the middle, (50, 25)
    camera.cy = 20;
    camera.near = 0.1;
    camera.far = 100;
    camera.pose = Pose{glm::dmat3(glm::rotate(glm::dmat4(1), 0.7, dvec3(1, 2, 3))), dvec3(4, 5, 6)};
    const CameraMatrices own = matrices_of(camera, small);
    const std::map<std::string, Imath::M44d> ranges = {
        {"", Imath::M44d()}, {"worldToNDC as 0 to 1, y up", y_up}, {"worldToNDC as -1 to 1, y up", symmetric_y_up}};
    for (const auto& [words, range] : ranges) {
      for (const bool back : {false, true}) {
        // For an orthographic camera in OpenEXR's own range only y tells where it looks; and with a range of 0 to 1, y up and
        // along -z, a perspective one is the same as OpenEXR's own, mirrored.
        if (back && (orthographic ? words.empty() : words == "worldToNDC as 0 to 1, y up")) continue;
        std::vector<std::string> assumed;
        const Camera read = camera_from_matrices(back ? own.world_to_camera * looks_back : own.world_to_camera,
                                                 own.world_to_ndc * range, small, own.origin, &assumed);
        EXPECT_EQ(read.orthographic, orthographic);
        EXPECT_NEAR(read.fx, camera.fx, 1e-9) << words << back;
        EXPECT_NEAR(read.fy, camera.fy, 1e-9) << words << back;
        EXPECT_NEAR(read.cx, camera.cx, 1e-9) << words << back;
        EXPECT_NEAR(read.cy, camera.cy, 1e-9) << words << back;
        expect_near(read.pose->position, camera.pose->position, 1e-9);
        for (int i = 0; i < 3; ++i) expect_near(read.pose->world_to_view[i], camera.pose->world_to_view[i], 1e-9);
        if (words.empty() && !back) {
          EXPECT_TRUE(assumed.empty());
          continue;
        }
        ASSERT_EQ(assumed.size(), 1u) << words << back;
        EXPECT_NE(assumed[0].find(words), std::string::npos) << assumed[0];
        EXPECT_EQ(assumed[0].find("along -z") != std::string::npos, back) << assumed[0];
      }
    }
  }
}

// --- There and back

glm::dmat3 random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const auto vector = [&] { return dvec3(normal(random), normal(random), normal(random)); };
  const dvec3 x = glm::normalize(vector()), y = glm::normalize(glm::cross(vector(), x));
  return {x, y, glm::cross(x, y)};
}

Camera random_camera(std::mt19937& random, const Window& display, const dvec3& position) {
  std::uniform_real_distribution<double> unit(0, 1);
  Camera camera = camera_from_fov(1 + 178 * unit(random), display, 1, "random");
  camera.fy *= 0.5 + unit(random);
  camera.cx += (unit(random) - 0.5) * display.width();
  camera.cy += (unit(random) - 0.5) * display.height();
  camera.orthographic = unit(random) < 0.3;
  if (camera.orthographic) camera.fx /= 100, camera.fy /= 100;
  if (unit(random) < 0.5) camera.near = 0.05, camera.far = 60;
  camera.pose = Pose{random_rotation(random), position};
  return camera;
}

/// The largest distance in pixels between two cameras' projections of points that the first sees, at depths 0.1 to 1000.
double disagreement(const Camera& a, const Camera& b, const Window& display) {
  double worst = 0;
  for (double depth : {0.1, 1.0, 1000.0})
    for (double u : {0.0, 0.3, 1.0})
      for (double v : {0.0, 0.6, 1.0}) {
        const dvec2 pixel(display.x0 + u * display.width(), display.y0 + v * display.height());
        const dvec3 world = world_of(a, pixel, depth);
        worst = std::fmax(worst, glm::length(pixel_of(b, world) - pixel_of(a, world)));
      }
  return worst;
}

TEST(CameraMatrices, RoundTrip) {
  std::mt19937 random(1);
  const Window display{-30, 20, 1890, 1100};
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    const dvec3 position = i % 2 ? dvec3(1e7, -1e7 / 3, 5e6) : dvec3(3, -2, 1.7);
    const Camera camera = random_camera(random, display, position);
    const CameraMatrices m = matrices_of(camera, display);
    const Camera back = camera_from_matrices(m.world_to_camera, m.world_to_ndc, display, m.origin);
    EXPECT_EQ(back.orthographic, camera.orthographic);
    EXPECT_EQ(back.pose->position, position);
    worst = std::fmax(worst, disagreement(camera, back, display));
  }
  std::printf("worst round trip: %.2e px\n", worst);
  EXPECT_LT(worst, 1e-6);
}

TEST(CameraMatrices, RoundTripThroughFloatsWithTheOriginInDouble) {
  std::mt19937 random(2);
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    const Camera camera = random_camera(random, hd, {1e7 + 0.065, -1e7, 12.5});
    const CameraMatrices m = matrices_of(camera, hd);
    const Imath::M44f camera_f(m.world_to_camera), ndc_f(m.world_to_ndc);
    const Camera back = camera_from_matrices(Imath::M44d(camera_f), Imath::M44d(ndc_f), hd, m.origin);
    EXPECT_EQ(back.pose->position, camera.pose->position);
    worst = std::fmax(worst, std::fmax(std::abs(back.fx / camera.fx - 1), std::abs(back.fy / camera.fy - 1)));
    worst = std::fmax(worst, std::fmax(std::abs(back.cx - camera.cx), std::abs(back.cy - camera.cy)) / hd.width());
  }
  std::printf("worst relative change through M44f: %.2e\n", worst);
  EXPECT_LT(worst, 3e-6);
}

TEST(CameraMatrices, MatricesMapTheWorldAsOpenExrSaysItDoes) {
  const Camera camera = camera_from_matrices(at_123, ndc_123, small, dvec3(5e6, 0, 0));
  const CameraMatrices m = matrices_of(camera, small);
  EXPECT_EQ(m.origin, dvec3(5e6 + 1, 2, 3));
  // Relative to the camera's own place, (1, 1, -10) is 10 in front of it: camera space looks along +z.
  EXPECT_EQ(Imath::V3d(1, 1, -10) * m.world_to_camera, Imath::V3d(1, 1, 10));
  const Imath::V3d ndc = Imath::V3d(1, 1, -10) * m.world_to_ndc;  // Imath divides by w
  EXPECT_NEAR(ndc.x, 0.6, 1e-12);
  EXPECT_NEAR(ndc.y, 0.3, 1e-12);
}

TEST(CameraFromFov, SquarePixelsCentred) {
  const Camera camera = camera_from_fov(90, {10, 20, 210, 120}, 1, "--fov");
  EXPECT_NEAR(camera.fx, 100, 1e-12);
  EXPECT_EQ(camera.fx, camera.fy);
  EXPECT_EQ(camera.cx, 110);
  EXPECT_EQ(camera.cy, 70);
  EXPECT_FALSE(camera.pose);
  for (double degrees : {0.0, 0.5, 180.0, -90.0, nan})
    EXPECT_THROW(camera_from_fov(degrees, hd, 1, "--fov"), UsageError) << degrees;
}

// --- Real frames

class Captures : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(folder / "README.md")) GTEST_SKIP() << "no captures at " << folder;
  }
  std::map<std::string, Camera> cameras_of(const fs::path& frame, const Window& display) {
    const auto file = find_camera_file(folder / frame);
    if (!file) throw std::runtime_error("no camera for " + frame.string());
    return read_camera_file(*file, display, assumed);
  }
  /// World positions of a frame must land on their pixels' centres.
  void expect_positions_on_pixels(const fs::path& frame, const std::string& layer) {
    const std::string path = (folder / frame).string();
    const Plane position = read_vector(path, layer, "position");
    const Layout layout = position.channels[0].layout();
    const Camera camera = cameras_of(frame, {0, 0, layout.width, layout.height}).at("");
    double squares = 0, worst = 0;
    long count = 0;
    for (int y = 0; y < layout.height; ++y)
      for (int x = 0; x < layout.width; ++x) {
        const dvec3 world(position.channels[0].at(x, y), position.channels[1].at(x, y), position.channels[2].at(x, y));
        if (world == dvec3(0)) continue;  // background
        const double distance = glm::length(pixel_of(camera, world) - dvec2(x + 0.5, y + 0.5));
        squares += distance * distance;
        worst = std::fmax(worst, distance);
        ++count;
      }
    ASSERT_GT(count, long(layout.width) * layout.height / 3);
    const double rms = std::sqrt(squares / double(count));
    std::printf("%s: rms %.5f px, worst %.3f px, %ld pixels\n", frame.c_str(), rms, worst, count);
    EXPECT_LT(rms, 0.0012);
    EXPECT_LT(worst, 0.3);
  }

  const fs::path folder = GLOAM_CAPTURES;
  std::vector<std::string> assumed;
};

TEST_F(Captures, CameraFilesFoundAsTheFoldersLieThere) {
  const auto found = [&](const char* frame) {
    const auto file = find_camera_file(folder / frame);
    return file ? file->filename().string() : "none";
  };
  EXPECT_EQ(found("kitchen/kitchen_user.exr"), "camera.json");
  EXPECT_EQ(found("apartment_stereo/apartment_stereo_exact.exr"), "camera_stereo.json");
  EXPECT_EQ(found("variants/garden_ortho.exr"), "garden_ortho.camera.json");
  EXPECT_EQ(found("variants/garden_compositor_file_output.exr"), "garden.camera.json");
  EXPECT_EQ(found("variants/kitchen_all_passes_small.exr"), "kitchen_all_passes_small.camera.json");
  EXPECT_EQ(found("variants/apartment_individual_L.exr"), "none");
}

TEST_F(Captures, PositionsLandOnPixelsPerspective) {
  expect_positions_on_pixels("variants/garden_compositor_file_output.exr", "P");
  expect_positions_on_pixels("variants/kitchen_all_passes_small.exr", "ViewLayer.Position");
}
TEST_F(Captures, PositionsLandOnPixelsLensShift) {
  expect_positions_on_pixels("variants/garden_lens_shift.exr", "ViewLayer.Position");
}
TEST_F(Captures, PositionsLandOnPixelsOrthographic) {
  expect_positions_on_pixels("variants/garden_ortho.exr", "ViewLayer.Position");
}

TEST_F(Captures, StereoDepthsAgreeThroughTheOffAxisCameras) {
  const fs::path frame = "apartment_stereo/apartment_stereo_exact.exr";
  const std::string path = (folder / frame).string();
  const Channel left = read_channel(path, "ViewLayer.Depth.left.Z"),
                right = read_channel(path, "ViewLayer.Depth.right.Z");
  const auto cameras = cameras_of(frame, hd);
  const Camera &from = cameras.at("left"), &to = cameras.at("right");
  long agree = 0, seen = 0;
  for (int y = 0; y < hd.height(); ++y)
    for (int x = 0; x < hd.width(); ++x) {
      const double depth = left.at(x, y);
      if (depth >= 1e9) continue;
      const dvec3 world = world_of(from, {x + 0.5, y + 0.5}, depth);
      const dvec2 pixel = pixel_of(to, world);
      if (pixel.x < 0 || pixel.y < 0 || pixel.x >= hd.width() || pixel.y >= hd.height()) continue;
      const double expected = -(to.pose->world_to_view * (world - to.pose->position)).z;
      ++seen;
      agree += std::abs(right.at(int(pixel.x), int(pixel.y)) / expected - 1) < 0.01;
    }
  ASSERT_GT(seen, 400000);
  std::printf("left to right within 1 %%: %.2f %% of %ld\n", 100.0 * double(agree) / double(seen), seen);
  EXPECT_GT(double(agree) / double(seen), 0.98);
}

TEST_F(Captures, HalfSizeFrameUsesTheSameJson) {
  const Camera whole = cameras_of("kitchen/kitchen_user.exr", hd).at("");
  const Camera half = cameras_of("kitchen/kitchen_user.exr", {0, 0, 480, 270}).at("");
  EXPECT_DOUBLE_EQ(half.fx * 2, whole.fx);
  EXPECT_DOUBLE_EQ(half.cx * 2, whole.cx);
  EXPECT_EQ(assumed.size(), 1u);
}

}  // namespace

}  // namespace gloam::camera_test
