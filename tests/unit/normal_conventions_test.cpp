// Normals and depth agree, by whichever door they come in: every convention that nothing states is found, and what is stated and does not
// fit is told. Files are written with OpenEXR itself, under the names of others.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "gloam/arrays.h"
#include "gloam/conventions.h"
#include "gloam/error.h"
#include "gloam/exr.h"
#include "gloam/scene/capture.h"
#include "gloam/scene/scene.h"
#include "gloam/scene/tracer.h"
#include "sequence/sequence_files.h"
#include "unit/message_of.h"

namespace gloam::test::normal_conventions_test {
using gloam::Scene;
namespace {

namespace fs = std::filesystem;
using glm::dvec3;

/// How a renderer may store normals.
struct Convention {
  const char* name;
  NormalSpace space;
  bool is_encoded;
  NormalAxes axes;
  NormalConvention stated() const {
    return {space, is_encoded ? NormalRange::unsigned_values : NormalRange::signed_values, axes};
  }
};

constexpr auto view = NormalSpace::view, world = NormalSpace::world;
const std::vector<Convention> conventions = {
    {"view", view, false, {1, 2, 3}},
    {"y down", view, false, {1, -2, 3}},
    {"z away", view, false, {1, 2, -3}},
    {"y down, z away", view, false, {1, -2, -3}},
    {"x flipped", view, false, {-1, 2, 3}},
    {"x flipped, y down", view, false, {-1, -2, 3}},
    {"x flipped, z away", view, false, {-1, 2, -3}},
    {"into the surface", view, false, {-1, -2, -3}},
    {"y and z exchanged", view, false, {1, 3, 2}},
    {"0 to 1", view, true, {1, 2, 3}},
    {"0 to 1, y down", view, true, {1, -2, 3}},
    {"0 to 1, z away", view, true, {1, 2, -3}},
    {"0 to 1, y down, z away", view, true, {1, -2, -3}},
    {"0 to 1, x flipped", view, true, {-1, 2, 3}},
    {"world", world, false, {1, 2, 3}},
    {"world, z up", world, false, {1, -3, 2}},
    {"world, z up, left-handed", world, false, {1, 3, 2}},
    {"world, y down", world, false, {1, -2, 3}},
    {"world, into the surface", world, false, {-1, -2, -3}},
    {"world, 0 to 1", world, true, {1, 2, 3}},
    {"world, 0 to 1, z up", world, true, {1, -3, 2}},
};

/// Of the front of a ball of hair, that faces the camera, nothing tells left from right.
const std::map<std::string, std::string> cameras = {{"hairball", "close"}};

const SceneCamera& camera_of(const Scene& scene, const std::string& name) {
  const auto named = cameras.find(name);
  for (const SceneCamera& camera : scene.cameras)
    if (named != cameras.end() && camera.name == named->second) return camera;
  return scene.cameras.front();
}

Frame captured(const Scene& scene, const SceneCamera& camera) {
  CaptureOptions options{.width = 320, .height = 180, .planes = {"normal"}};
  options.views = {{.camera = camera_for(camera, options.width, options.height)}};
  return capture(Tracer(scene), options).frame;
}

const Plane& normals_of(const Frame& frame) { return frame.views.front().planes.at("normal"); }
const Channel& depth_of(const Frame& frame) { return frame.views.front().planes.at("depth").channels.front(); }

dvec3 normal_at(const Plane& plane, int x, int y) {
  return {plane.channels[0].at(x, y), plane.channels[1].at(x, y), plane.channels[2].at(x, y)};
}

/// A normal of view space as the convention stores it; one that is none stays none.
dvec3 stored(const dvec3& normal, const Convention& as, const Camera& camera) {
  if (normal == dvec3(0)) return dvec3(as.is_encoded ? 0.5 : 0);
  const dvec3 in_space = as.space == world ? glm::transpose(camera.pose->world_to_view) * normal : normal;
  dvec3 components;
  for (size_t i = 0; i < 3; ++i) components[int(i)] = (as.axes[i] < 0 ? -1 : 1) * in_space[std::abs(as.axes[i]) - 1];
  return as.is_encoded ? 0.5 + 0.5 * components : components;
}

/// Depth and normals as arrays; three values of a normal side by side.
struct Values {
  std::vector<float> depth, normal;
};

Values values_of(const Frame& frame, const Convention& as) {
  Values values;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      values.depth.push_back(depth_of(frame).at(x, y));
      const dvec3 normal = stored(normal_at(normals_of(frame), x, y), as, *frame.views.front().camera);
      for (int c : {0, 1, 2}) values.normal.push_back(float(normal[c]));
    }
  }
  return values;
}

Arrays arrays_of(const Frame& frame, const Values& values) {
  return {.width = frame.width(),
          .height = frame.height(),
          .camera = *frame.views.front().camera,
          .planes = {{"depth", values.depth}, {"normal", values.normal}}};
}

/// Whether two conventions store the same of a frame: of walls that face the camera, nothing tells that y is down.
bool are_alike(const Frame& frame, const Convention& one, const Convention& other) {
  const std::vector<float> a = values_of(frame, one).normal, b = values_of(frame, other).normal;
  return std::equal(a.begin(), a.end(), b.begin(), [](float x, float y) { return std::abs(x - y) < 1e-6f; });
}

/// The mean angle between a frame's normals and what is stored of them, degrees.
double mean_turn(const Frame& frame, const Convention& as) {
  double sum = 0, count = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const dvec3 normal = normal_at(normals_of(frame), x, y);
      if (normal == dvec3(0)) continue;
      const double cosine = glm::dot(normal, stored(normal, as, *frame.views.front().camera));
      sum += glm::degrees(std::acos(std::min(1.0, std::max(-1.0, cosine))));
      ++count;
    }
  }
  return count > 0 ? sum / count : 0;
}

double largest_difference(const Frame& a, const Frame& b) {
  double largest = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x)
      largest = std::max(largest, glm::length(normal_at(normals_of(a), x, y) - normal_at(normals_of(b), x, y)));
  }
  return largest;
}

std::vector<std::string> notes_on_normals(const std::vector<std::string>& notes) {
  std::vector<std::string> found;
  for (const std::string& note : notes)
    if (note.starts_with("normals:")) found.push_back(note);
  return found;
}

bool is_of_missing_ones(const std::string& note) { return note.find("of the foreground") != std::string::npos; }

/// The notes on conventions, as one text.
std::string notes_of(const Frame& frame) {
  std::vector<std::string> notes = notes_on_normals(frame.assumed);
  std::erase_if(notes, is_of_missing_ones);
  EXPECT_LE(notes.size(), 1u) << fmt::format("{}", fmt::join(notes, "\n"));
  return fmt::format("{}", fmt::join(notes, "\n"));
}

class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "gloam_normals_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path_); }
  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

/// Writes Z and normals of these names, and nothing else: no camera, no attribute.
void write_file(const fs::path& path, const Values& values, int width, int height,
                const std::vector<std::string>& names, const std::string& depth = "Z") {
  Imf::Header header(width, height);
  header.compression() = Imf::NO_COMPRESSION;
  Imf::FrameBuffer buffer;
  const auto add = [&](const std::string& name, const float* first, size_t stride) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    buffer.insert(name, Imf::Slice(Imf::FLOAT, const_cast<char*>(reinterpret_cast<const char*>(first)),
                                   stride * sizeof(float), stride * sizeof(float) * size_t(width)));
  };
  add(depth, values.depth.data(), 1);
  for (size_t c = 0; c < names.size(); ++c) add(names[c], values.normal.data() + c, 3);
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(buffer);
  file.writePixels(height);
}

std::string json_of(const Camera& camera) {
  nlohmann::json rows = nlohmann::json::array();
  for (int row = 0; row < 3; ++row) {
    const dvec3 axis = camera.pose->world_to_view[row];
    rows.push_back({axis.x, axis.y, axis.z, camera.pose->position[row]});
  }
  rows.push_back({0, 0, 0, 1});
  return nlohmann::json(
             {{"fx", camera.fx}, {"fy", camera.fy}, {"cx", camera.cx}, {"cy", camera.cy}, {"camera_to_world", rows}})
      .dump();
}

ReadOptions options_for(const Frame& frame) {
  ReadOptions options;
  options.camera_file = "camera";
  options.camera_text = json_of(*frame.views.front().camera);
  return options;
}

const std::vector<std::string> generic = {"N.X", "N.Y", "N.Z"},
                               of_world = {"WorldNormal.R", "WorldNormal.G", "WorldNormal.B"},
                               of_camera = {"Ncam.X", "Ncam.Y", "Ncam.Z"};

class NormalsOf : public testing::TestWithParam<std::string> {
 protected:
  Frame read(const Frame& frame, const Convention& as, const std::vector<std::string>& names, ReadOptions options) {
    write_file(folder_ / "f.exr", values_of(frame, as), frame.width(), frame.height(), names);
    return FrameFile(folder_ / "f.exr", options).read({"depth", "normal"});
  }
  Frame read(const Frame& frame, const Convention& as, const std::vector<std::string>& names) {
    return read(frame, as, names, options_for(frame));
  }
  const Scene scene_ = load_scene(GetParam(), {});
  Folder folder_;
};

std::vector<std::string> names_of_scenes() {
  std::vector<std::string> names;
  for (const SceneRecipe& recipe : builtin_scenes()) names.push_back(recipe.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, NormalsOf, testing::ValuesIn(names_of_scenes()),
                         [](const auto& info) { return info.param; });

TEST_P(NormalsOf, FilesAreReadInTheConventionThatAgreesWithDepth) {
  const Frame frame = captured(scene_, camera_of(scene_, GetParam()));
  for (const Convention& as : conventions) {
    const Frame back = read(frame, as, generic);
    EXPECT_LT(largest_difference(back, frame), 2e-6) << as.name << "\n" << notes_of(back);
    EXPECT_NE(notes_of(back).find("says otherwise"), std::string::npos) << as.name;
    EXPECT_EQ(notes_of(back).find("decoded from 0..1") != std::string::npos, as.is_encoded) << as.name;
  }
}

/// A name states the space alone: range and axes are found all the same.
TEST_P(NormalsOf, ANameThatStatesTheSpaceLeavesTheRestToBeFound) {
  const Frame frame = captured(scene_, camera_of(scene_, GetParam()));
  for (const Convention& as : conventions) {
    const Frame back = read(frame, as, as.space == world ? of_world : of_camera);
    EXPECT_LT(largest_difference(back, frame), 2e-6) << as.name << "\n" << notes_of(back);
    EXPECT_EQ(notes_of(back).empty(), are_alike(frame, as, {"", as.space, false, plain_axes})) << as.name << "\n"
                                                                                               << notes_of(back);
  }
}

TEST_P(NormalsOf, ArraysAreTakenInTheConventionThatAgreesWithDepth) {
  const Frame frame = captured(scene_, camera_of(scene_, GetParam()));
  for (const Convention& as : conventions) {
    const Values values = values_of(frame, as);
    Arrays arrays = arrays_of(frame, values);
    const Frame found = frame_from(arrays);
    const bool is_view = are_alike(frame, as, conventions.front());
    // A world whose axes are nearly those of the camera fits no better than view space does.
    const bool is_plain_world = as.space == world && !as.is_encoded && as.axes == plain_axes;
    const bool may_be_view = is_plain_world && mean_turn(frame, as) <= 25;
    if (!may_be_view || !notes_of(found).empty()) {
      EXPECT_LT(largest_difference(found, frame), 2e-6) << as.name << "\n" << notes_of(found);
      EXPECT_EQ(notes_of(found).empty(), is_view) << as.name << "\n" << notes_of(found);
    }
    arrays.normals = as.stated();
    const Frame told = frame_from(arrays);
    EXPECT_LT(largest_difference(told, frame), 2e-6) << as.name;
    EXPECT_EQ(notes_of(told), "") << as.name << ": what is stated and fits needs no note";
  }
}

TEST_P(NormalsOf, NoCameraOfASceneRaisesAFalseAlarm) {
  for (const SceneCamera& camera : scene_.cameras) {
    const Frame frame = captured(scene_, camera);
    const Values values = values_of(frame, conventions.front());
    EXPECT_EQ(notes_of(frame_from(arrays_of(frame, values))), "") << camera.name;
    const Convention as_world{"world", world, false, plain_axes};
    EXPECT_EQ(notes_of(read(frame, as_world, of_world)), "") << camera.name;
    EXPECT_EQ(notes_of(read(frame, conventions.front(), of_camera)), "") << camera.name;
    const std::string generic_name = notes_of(read(frame, as_world, generic));
    EXPECT_EQ(generic_name.find("axes"), std::string::npos) << camera.name << "\n" << generic_name;
    EXPECT_EQ(generic_name.find("decoded"), std::string::npos) << camera.name << "\n" << generic_name;
    Arrays without_pose = arrays_of(frame, values);
    without_pose.camera.pose.reset();
    EXPECT_EQ(notes_of(frame_from(without_pose)), "") << camera.name;
  }
}

/// One scene stands for what does not depend on it.
class OneFrame : public testing::Test {
 protected:
  std::string note_on(const Convention& as, const std::vector<std::string>& names, const NormalConvention& flags) {
    write_file(folder_ / "f.exr", values_of(frame_, as), frame_.width(), frame_.height(), names);
    ReadOptions options = options_for(frame_);
    options.normals = flags;
    return notes_of(FrameFile(folder_ / "f.exr", options).read({"depth", "normal"}));
  }
  /// A wall that faces the camera, of as many rows of pixels before a sky: it tells of itself neither that y is down nor anything else.
  Values wall(const Convention& as, int rows) const {
    Values values;
    const double tilt = 0.03;
    for (int i = 0; i < frame_.width() * frame_.height(); ++i) {
      const bool is_wall = i < rows * frame_.width();
      values.depth.push_back(is_wall ? 4 : std::numeric_limits<float>::infinity());
      const dvec3 normal = is_wall ? dvec3(0, -std::sin(tilt), std::cos(tilt)) : dvec3(0);
      const dvec3 as_stored = stored(normal, as, *frame_.views.front().camera);
      for (int c : {0, 1, 2}) values.normal.push_back(float(as_stored[c]));
    }
    return values;
  }
  /// Writes the frames of a shot, from number 1 on, and their camera.
  void write_shot(const std::string& name, const std::vector<Values>& frames) const {
    for (size_t i = 0; i < frames.size(); ++i)
      write_file(folder_ / fmt::format("{}.{}.exr", name, i + 1), frames[i], frame_.width(), frame_.height(), generic);
    std::ofstream(folder_ / (name + ".camera.json")) << json_of(*frame_.views.front().camera);
  }
  SequenceFiles shot_of(const std::vector<std::string>& names, const FrameChoice& choice = {}) const {
    std::vector<FramePattern> patterns;
    for (const std::string& name : names) patterns.emplace_back((folder_ / (name + ".#.exr")).string(), "");
    std::vector<std::string> notes;
    return SequenceFiles(std::move(patterns), {}, choice, notes);
  }

  const Frame frame_ = [] {
    const Scene scene = load_scene("courtyard", {});
    return captured(scene, scene.cameras.front());
  }();
  Folder folder_;
};

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " is not in: " << text;
}

TEST_F(OneFrame, WhatIsStatedStandsAndTheBetterConventionIsNamed) {
  const Convention y_down = conventions[1], encoded{"", view, true, plain_axes}, in_world{"", world, false, plain_axes};
  expect_parts(note_on(y_down, generic, {view, NormalRange::signed_values, plain_axes}),
               {"--normal-axes says", "agree with depth only to", "--normal-axes x,-y,z states that"});
  expect_parts(note_on(encoded, generic, {NormalSpace::automatic, NormalRange::signed_values, {}}),
               {"--normal-range says", "--normal-range unsigned states that"});
  expect_parts(
      note_on({"", view, false, plain_axes}, generic, {NormalSpace::automatic, NormalRange::unsigned_values, {}}),
      {"--normal-range says", "--normal-range signed states that"});
  expect_parts(note_on(in_world, of_camera, {}), {"the name 'Ncam.X' says", "--normal-space world states that"});
  expect_parts(note_on(in_world, generic, {view, NormalRange::automatic, {}}),
               {"--normal-space says", "--normal-space world states that"});
  const Values values = values_of(frame_, y_down);
  Arrays arrays = arrays_of(frame_, values);
  arrays.normals.axes = plain_axes;
  expect_parts(notes_of(frame_from(arrays)), {"agree with depth only to", "--normal-axes x,-y,z states that"});
}

/// As normals of another frame would be.
TEST_F(OneFrame, ThoseOfNoSurfaceHereAreTold) {
  Values values = values_of(frame_, {"", view, false, plain_axes});
  uint32_t state = 1;
  const auto random = [&] { return float((state = state * 1664525u + 1013904223u) / 2147483648.0 - 1); };
  for (size_t i = 0; i < values.normal.size(); i += 3) {
    dvec3 normal(random(), random(), random());
    normal = glm::length(normal) > 0 ? glm::normalize(normal) : dvec3(0, 0, 1);
    for (size_t c = 0; c < 3; ++c) values.normal[i + c] = float(normal[int(c)]);
  }
  const std::vector<std::string> parts = {"in any convention", "--plane normal=none"};
  expect_parts(notes_of(frame_from(arrays_of(frame_, values))), parts);
  write_file(folder_ / "f.exr", values, frame_.width(), frame_.height(), of_world);
  expect_parts(notes_of(FrameFile(folder_ / "f.exr", options_for(frame_)).read({"depth", "normal"})), parts);
}

TEST_F(OneFrame, ArraysInWorldSpaceWithoutAPoseAreTold) {
  for (const bool is_encoded : {false, true}) {
    Arrays arrays = arrays_of(frame_, values_of(frame_, {"", world, is_encoded, plain_axes}));
    arrays.camera.pose.reset();
    const std::string notes = notes_of(frame_from(arrays));
    EXPECT_NE(notes, "") << is_encoded;
    EXPECT_NE(notes.find("world space"), std::string::npos) << notes;
  }
}

TEST_F(OneFrame, ACameraInTheWrongPlaceIsToldFromWrongNormals) {
  const double angle = glm::radians(35.0), c = std::cos(angle), s = std::sin(angle);
  Camera camera = *frame_.views.front().camera;
  camera.pose->world_to_view = glm::dmat3(c, 0, -s, 0, 1, 0, s, 0, c) * camera.pose->world_to_view;
  write_file(folder_ / "f.exr", values_of(frame_, {"", world, false, plain_axes}), frame_.width(), frame_.height(),
             of_world);
  ReadOptions options;
  options.camera_file = "camera";
  options.camera_text = json_of(camera);
  expect_parts(notes_of(FrameFile(folder_ / "f.exr", options).read({"depth", "normal"})),
               {"turned by 35 degrees", "the camera's pose is likely wrong, and not the normals"});
}

/// A filter with negative lobes takes averaged normals a little out of 0 to 1.
TEST_F(OneFrame, EncodedOnesMayLeaveTheIntervalALittle) {
  Values values = values_of(frame_, {"", view, true, plain_axes});
  for (size_t i = 0; i < values.normal.size(); i += 3 * 211) {
    for (size_t c = 0; c < 3; ++c) values.normal[i + c] = 0.5f + 1.1f * (values.normal[i + c] - 0.5f);
  }
  write_file(folder_ / "f.exr", values, frame_.width(), frame_.height(), generic);
  const Frame back = FrameFile(folder_ / "f.exr", options_for(frame_)).read({"depth", "normal"});
  expect_parts(notes_of(back), {"decoded from 0..1"});
  EXPECT_LT(largest_difference(back, frame_), 2e-6);
}

/// Two components from 0 to 1, and a third of another kind: of no convention, and no unit vectors.
TEST_F(OneFrame, ThoseOfNoConventionAreNotUsedUnlessChosen) {
  Values values = values_of(frame_, {"", view, true, plain_axes});
  for (size_t i = 2; i < values.normal.size(); i += 3) values.normal[i] = 1.7f * (2 * values.normal[i] - 1);
  write_file(folder_ / "f.exr", values, frame_.width(), frame_.height(), generic);
  const Frame without = FrameFile(folder_ / "f.exr", options_for(frame_)).read({"depth", "normal"});
  EXPECT_EQ(without.views.front().find("normal"), nullptr);
  expect_parts(notes_of(without), {"normals: they fit no convention", "neither 1 nor alike", "not used",
                                   "--plane normal=CHANNELS has them taken"});
  ReadOptions chosen = options_for(frame_);
  chosen.normals.range = NormalRange::unsigned_values;
  EXPECT_NE(FrameFile(folder_ / "f.exr", chosen).read({"depth", "normal"}).views.front().find("normal"), nullptr);
}

/// Normals of other lengths are directions all the same.
TEST_F(OneFrame, ThoseOfAnyLengthAreUsed) {
  Values values = values_of(frame_, {"", view, false, plain_axes});
  for (float& component : values.normal) component *= 3;
  write_file(folder_ / "f.exr", values, frame_.width(), frame_.height(), generic);
  const Frame frame = FrameFile(folder_ / "f.exr", options_for(frame_)).read({"depth", "normal"});
  EXPECT_NE(frame.views.front().find("normal"), nullptr);
  EXPECT_EQ(notes_of(frame).find("fit no convention"), std::string::npos);
}

TEST_F(OneFrame, AnEncodedZeroIsNoDirection) {
  Values values = values_of(frame_, {"", view, true, plain_axes});
  std::fill_n(values.normal.begin(), 3, 0.0f);
  std::fill_n(values.normal.begin() + 3, 3, 128 / 255.0f);
  Arrays arrays = arrays_of(frame_, values);
  values.depth[0] = values.depth[1] = 1;
  const Frame frame = frame_from(arrays);
  for (int x : {0, 1}) EXPECT_EQ(normal_at(normals_of(frame), x, 0), dvec3(0)) << x;
}

/// A wall that faces the camera tells of itself neither that y is down nor anything else: the first frame of its shot does.
TEST_F(OneFrame, TheFirstFrameOfAShotDecidesForAll) {
  const Convention& y_down = conventions[1];
  write_shot("shot", {values_of(frame_, y_down), wall(y_down, frame_.height())});
  const Frame alone = FrameFile(folder_ / "shot.2.exr", {}).read({"depth", "normal"});
  EXPECT_GT(normal_at(normals_of(alone), 9, 9).y, 0.02);
  for (const std::vector<int>& numbers : std::vector<std::vector<int>>{{1, 2}, {2}}) {
    FrameChoice choice;
    choice.frames = numbers;
    const SequenceFiles shot = shot_of({"shot"}, choice);
    const Frame second = shot.open(shot.frames().back()).read({"depth", "normal"});
    EXPECT_LT(normal_at(normals_of(second), 9, 9).y, -0.02) << "whichever frames are asked for";
    expect_parts(notes_of(second), {"with the axes x,-y,z", "decided on frame 1 for the whole sequence"});
  }
}

/// The first frames of a shot may show next to nothing, which tells nothing of the others.
TEST_F(OneFrame, AFrameOfAShotDecidesOnlyIfItShowsEnough) {
  const Convention& y_down = conventions[1];
  write_shot("shot", {wall(y_down, 4), values_of(frame_, y_down), wall(y_down, frame_.height())});
  const Frame alone = FrameFile(folder_ / "shot.1.exr", {}).read({"depth", "normal"});
  EXPECT_GT(normal_at(normals_of(alone), 9, 1).y, 0.02);
  const SequenceFiles shot = shot_of({"shot"});
  for (const SequenceFrame& at : shot.frames()) {
    const Frame frame = shot.open(at).read({"depth", "normal"});
    expect_parts(notes_of(frame), {"with the axes x,-y,z", "decided on frame 2 for the whole sequence"});
    if (at.number == 2)
      EXPECT_LT(largest_difference(frame, frame_), 2e-6);
    else
      EXPECT_LT(normal_at(normals_of(frame), 9, 1).y, -0.02) << at.number;
  }
}

TEST_F(OneFrame, OfAShotThatShowsLittleTheFrameDecidesThatShowsMost) {
  const Convention& plain = conventions.front();
  write_shot("shot", {wall(plain, 0), wall(plain, 4), wall(plain, 5), wall(plain, 4)});
  const SequenceFiles shot = shot_of({"shot"});
  for (const SequenceFrame& at : shot.frames())
    expect_parts(notes_of(shot.open(at).read({"depth", "normal"})), {"decided on frame 3 for the whole sequence"});
}

/// The two files of a shot of two eyes may come from different programs.
TEST_F(OneFrame, EachFileOfAShotOfTwoEyesHasItsOwnConvention) {
  const std::vector<std::string> eyes = {"L", "R"};
  const std::vector<Convention> as = {conventions[1], {"0 to 1", view, true, plain_axes}};
  for (size_t eye : {0, 1}) write_shot(eyes[eye], {values_of(frame_, as[eye]), wall(as[eye], frame_.height())});
  const SequenceFiles shot = shot_of(eyes);
  for (const SequenceFrame& at : shot.frames()) {
    const Frame frame = shot.open(at).read({"depth", "normal"});
    ASSERT_EQ(frame.views.size(), 2u);
    const std::string notes = fmt::format("{}", fmt::join(frame.assumed, "\n"));
    expect_parts(notes, {fmt::format("L.{}.exr: normals: taken as view space with the axes x,-y,z: ", at.number),
                         fmt::format("R.{}.exr: normals: decoded from 0..1 and taken as view space: ", at.number),
                         "decided on frame 1 for the whole sequence"});
    EXPECT_EQ(notes.find("not all frames of the shot"), std::string::npos) << notes;
    for (const View& eye : frame.views) {
      const dvec3 found = normal_at(eye.planes.at("normal"), 160, 90);
      const dvec3 expected = at.number == 1 ? normal_at(normals_of(frame_), 160, 90) : dvec3(0, -0.03, 1);
      EXPECT_LT(glm::length(found - expected), 1e-3) << eye.name << " of frame " << at.number;
    }
  }
}

TEST_F(OneFrame, InWorldSpaceNeedAPose) {
  const Values values = values_of(frame_, conventions.front());
  Arrays arrays = arrays_of(frame_, values);
  arrays.normals.space = world;
  arrays.camera.pose.reset();
  EXPECT_NE(message_of([&] { frame_from(arrays); }).find("a camera with a pose"), std::string::npos);
}

// --- Depth

constexpr float inf = std::numeric_limits<float>::infinity();

std::string depth_notes_of(const Frame& frame) {
  std::string notes;
  for (const std::string& note : frame.assumed)
    if (note.starts_with("depth:")) notes += note + "\n";
  return notes;
}

class Depths : public OneFrame {
 protected:
  Frame from(const std::vector<float>& depth) {
    return frame_from({.width = frame_.width(),
                       .height = frame_.height(),
                       .camera = *frame_.views.front().camera,
                       .planes = {{"depth", depth}}});
  }
  std::vector<float> changed(const std::function<float(float)>& change) {
    std::vector<float> depth = values_of(frame_, conventions.front()).depth;
    for (float& z : depth) z = change(z);
    return depth;
  }
  /// The depth of another frame where this one shows the sky.
  float in_sky(const Frame& frame) {
    for (int y = 0; y < frame_.height(); ++y) {
      for (int x = 0; x < frame_.width(); ++x)
        if (depth_of(frame_).at(x, y) == inf) return depth_of(frame).at(x, y);
    }
    ADD_FAILURE() << "there is no sky";
    return 0;
  }
  void expect_same(const Frame& frame) {
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x)
        ASSERT_EQ(depth_of(frame).at(x, y), depth_of(frame_).at(x, y)) << x << ", " << y;
    }
  }
};

TEST_F(Depths, OfArraysThatAreNegativeAreTurned) {
  const Frame frame = from(changed([](float z) { return -z; }));
  expect_parts(depth_notes_of(frame), {"all of it is negative"});
  expect_same(frame);
  EXPECT_EQ(depth_notes_of(from(changed([](float z) { return z; }))), "");
}

TEST_F(Depths, OfArraysThatAreOfNoUseAreTold) {
  expect_parts(depth_notes_of(from(changed([](float) { return 0.0f; }))), {"no pixel has a usable depth"});
  std::vector<float> some = changed([](float z) { return z; });
  some[7] = some[70] = -1;
  expect_parts(depth_notes_of(from(some)), {"2 negative values among positive ones"});
}

TEST_F(Depths, TheLargestHalfIsBackground) {
  const auto as_half_sky = [](float z) { return z < inf ? z : 65504.0f; };
  const Frame frame = from(changed(as_half_sky));
  expect_parts(depth_notes_of(frame), {"65504, the largest half, and taken as background"});
  EXPECT_NE(depth_notes_of(frame).find("--background"), std::string::npos) << "Arrays::depth and background= state it";
  expect_same(frame);
  const Values y_down = values_of(frame_, conventions[1]);
  const std::vector<float> sky = changed(as_half_sky);
  Arrays arrays = arrays_of(frame_, y_down);
  arrays.camera.far = 65504;
  arrays.planes["depth"] = sky;
  const Frame of_far = frame_from(arrays);
  EXPECT_EQ(depth_notes_of(of_far).find("no pixel has a usable depth"), std::string::npos);
  expect_parts(notes_of(of_far), {"x,-y,z"});
  Values values = values_of(frame_, conventions.front());
  values.depth = changed(as_half_sky);
  write_file(folder_ / "f.exr", values, frame_.width(), frame_.height(), generic);
  ReadOptions options = options_for(frame_);
  const Frame read = FrameFile(folder_ / "f.exr", options).read({"depth"});
  expect_parts(depth_notes_of(read), {"65504, the largest half"});
  expect_same(read);
  options.background = 1e10f;
  const Frame stated = FrameFile(folder_ / "f.exr", options).read({"depth"});
  EXPECT_EQ(depth_notes_of(stated).find("65504, the largest"), std::string::npos);
  EXPECT_EQ(in_sky(stated), 65504);
}

/// A sky that a renderer leaves at the value of the near plane would darken everything beside it.
TEST_F(Depths, AShareOfPixelsExactlyOnTheNearPlaneIsBackground) {
  const double near = 0.1, far = 100;
  for (const bool is_reversed : {false, true}) {
    Values values = values_of(frame_, conventions.front());
    values.depth = changed([&](float z) {
      const double d = z < inf ? (far - near * far / double(z)) / (far - near) : 0;
      return float(is_reversed ? 1 - d : d);
    });
    write_file(folder_ / "f.exr", values, frame_.width(), frame_.height(), generic);
    ReadOptions options = options_for(frame_);
    options.near = near, options.far = far;
    options.depth = is_reversed ? DepthConvention::reversed : DepthConvention::ndc;
    const Frame frame = FrameFile(folder_ / "f.exr", options).read({"depth"});
    expect_parts(depth_notes_of(frame), {"exactly on the near plane, and taken as background", "--background"});
    EXPECT_EQ(in_sky(frame), inf);
    options.background = is_reversed ? 0.0f : 1.0f;
    EXPECT_LT(in_sky(FrameFile(folder_ / "f.exr", options).read({"depth"})), 0.11f);
  }
}

TEST_F(Depths, StairsOfAnOrthographicCameraAreTold) {
  const auto note = [&](float distance) {
    std::vector<float> depth(160 * 90);
    for (size_t i = 0; i < depth.size(); ++i) depth[i] = distance + 0.01f * float(i / 160);
    Camera camera{.orthographic = true, .fx = 20, .fy = 20, .cx = 80, .cy = 45};
    return depth_notes_of(frame_from({.width = 160, .height = 90, .camera = camera, .planes = {{"depth", depth}}}));
  };
  expect_parts(note(1e6f), {"the steps of float are 0.0625 units or 1.2 pixels long", "place the camera nearer"});
  EXPECT_EQ(note(1e3f), "");
}

}  // namespace
}  // namespace gloam::test::normal_conventions_test
