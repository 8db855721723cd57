// EXR in and out: windows, types, parts, views, conventions, refusals. The files are made here with OpenEXR itself, so that not
// only gloam's own files are read.
#include "gloam/exr.h"

#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>

#include "gloam/error.h"
#include "gloam/normalise.h"
#include "gloam/planes.h"

namespace gloam::exr_test {
namespace {

using namespace gloam;
namespace fs = std::filesystem;
constexpr float inf = std::numeric_limits<float>::infinity();

struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "gloam_exr_XXXXXX").string();
    path = ::mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path); }
  fs::path operator/(const char* name) const { return path / name; }
};

using Value = std::function<float(int x, int y)>;  // in EXR pixel coordinates

/// A channel to write: name, type, values.
struct Written {
  std::string name;
  Imf::PixelType type;
  Value value;
};

Imath::Box2i box(int x0, int y0, int x1, int y1) { return {Imath::V2i(x0, y0), Imath::V2i(x1, y1)}; }

/// Owns the pixels of the channels of one part, in their own types.
struct Pixels {
  std::vector<std::vector<uint32_t>> memory;
  Imf::FrameBuffer buffer;
  Pixels(Imf::Header& header, const std::vector<Written>& channels) {
    const Imath::Box2i data = header.dataWindow();
    const int width = data.max.x - data.min.x + 1, height = data.max.y - data.min.y + 1;
    for (const Written& channel : channels) {
      header.channels().insert(channel.name, Imf::Channel(channel.type));
      auto& bytes = memory.emplace_back(size_t(width) * size_t(height));
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const float v = channel.value(x + data.min.x, y + data.min.y);
          const size_t i = size_t(y) * size_t(width) + size_t(x);
          if (channel.type == Imf::FLOAT) reinterpret_cast<float*>(bytes.data())[i] = v;
          if (channel.type == Imf::HALF) reinterpret_cast<half*>(bytes.data())[i] = half(v);
          if (channel.type == Imf::UINT) bytes[i] = uint32_t(v);
        }
      buffer.insert(channel.name, Imf::Slice::Make(channel.type, bytes.data(), data.min, width, height));
    }
  }
};

void write_exr(const fs::path& path, Imf::Header header, const std::vector<Written>& channels, bool tiled = false) {
  Pixels pixels(header, channels);
  const Imath::Box2i data = header.dataWindow();
  if (tiled) {
    header.setTileDescription(Imf::TileDescription(16, 8, Imf::MIPMAP_LEVELS));
    Imf::TiledOutputFile file(path.c_str(), header);
    file.setFrameBuffer(pixels.buffer);
    file.writeTiles(0, file.numXTiles(0) - 1, 0, file.numYTiles(0) - 1, 0);
    return;
  }
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(pixels.buffer);
  file.writePixels(data.max.y - data.min.y + 1);
}

float ramp(int x, int y) { return 1 + 0.5f * float(x) + 32 * float(y); }

std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void expect_one_line(const std::string& message, const fs::path& path, const std::string& part) {
  EXPECT_NE(message.find(path.filename().string()), std::string::npos) << message;
  EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

std::string read_error(const fs::path& path, const std::vector<std::string>& planes = {"depth"},
                       const ReadOptions& options = {}) {
  return error_of([&] { FrameFile(path, options).read(planes); });
}

// --- Reading
// ----------------------------------------------------------------------------------------------------------

class Types : public testing::TestWithParam<std::tuple<Imf::PixelType, bool, Imf::Compression>> {};

TEST_P(Types, DecodeToTheSameFloats) {
  const auto [type, tiled, compression] = GetParam();
  Folder folder;
  Imf::Header header(37, 21);
  header.compression() = compression;
  write_exr(folder / "f.exr", header, {{"Z", type, [](int x, int y) { return float(1 + x + 37 * y); }}}, tiled);
  FrameFile file(folder / "f.exr", {});
  EXPECT_EQ(file.planes()[0].channels[0].type, type == Imf::HALF ? "half" : type == Imf::UINT ? "uint" : "float");
  const Frame frame = file.read({"depth"});
  const Channel& depth = frame.views[0].find("depth")->channels[0];
  ASSERT_EQ(depth.layout(), Layout(37, 21));
  for (int y = 0; y < 21; ++y)
    for (int x = 0; x < 37; ++x) ASSERT_EQ(depth.at(x, y), 1 + x + 37 * y) << x << " " << y;
  for (int x = 37; x < depth.layout().pitch; ++x) EXPECT_EQ(depth.row(20)[x], inf) << "padding";
}

INSTANTIATE_TEST_SUITE_P(All, Types,
                         testing::Combine(testing::Values(Imf::HALF, Imf::FLOAT, Imf::UINT), testing::Bool(),
                                          testing::Values(Imf::NO_COMPRESSION, Imf::ZIP_COMPRESSION,
                                                          Imf::PIZ_COMPRESSION)));

TEST(ReadExr, WindowIsTheUnionAndUncoveredPixelsGetTheirValue) {
  Folder folder;
  Imf::Header header(box(0, 0, 19, 9), box(-3, 4, 11, 12));  // display 20 x 10, data beyond it left and below
  write_exr(folder / "f.exr", header,
            {{"Z", Imf::FLOAT, [](int x, int y) { return float(100 + x + 50 * y); }},
             {"AO", Imf::FLOAT, [](int, int) { return 0.5f; }},
             {"A", Imf::FLOAT, [](int, int) { return 1.0f; }}});
  FrameFile file(folder / "f.exr", {});
  EXPECT_EQ(file.display(), (Window{0, 0, 20, 10}));
  EXPECT_EQ(file.window(), (Window{-3, 0, 20, 13}));
  const Frame frame = file.read({"depth", "ao", "alpha"});
  const View& view = frame.views[0];
  for (int y = 0; y < 13; ++y)
    for (int x = -3; x < 20; ++x) {
      const bool inside = x <= 11 && y >= 4;
      EXPECT_EQ(view.find("depth")->channels[0].at(x + 3, y), inside ? float(100 + x + 50 * y) : inf) << x << " " << y;
      EXPECT_EQ(view.find("ao")->channels[0].at(x + 3, y), inside ? 0.5f : 1.0f);
      EXPECT_EQ(view.find("alpha")->channels[0].at(x + 3, y), inside ? 1.0f : 0.0f);
    }
}

TEST(ReadExr, PartsOfDifferentWindowsAndViewsComeTogether) {
  Folder folder;
  std::vector<Imf::Header> headers;
  for (int part = 0; part < 3; ++part) {
    Imf::Header header(box(0, 0, 9, 9), part == 1 ? box(2, 2, 5, 5) : box(0, 0, 9, 9));
    header.setName(part == 0 ? "depth_left" : part == 1 ? "depth_right" : "mask");
    header.setType(Imf::SCANLINEIMAGE);
    if (part < 2) header.setView(part == 0 ? "left" : "right");
    headers.push_back(header);
  }
  Pixels left(headers[0], {{"Z", Imf::FLOAT, ramp}}),
      right(headers[1], {{"Z", Imf::HALF, [](int, int) { return 2.f; }}}),
      shared(headers[2], {{"mask", Imf::HALF, [](int x, int) { return x < 5 ? 1.f : 0.f; }}});
  {
    Imf::MultiPartOutputFile file((folder / "f.exr").c_str(), headers.data(), 3);
    int part = 0;
    for (Pixels* pixels : {&left, &right, &shared}) {
      Imf::OutputPart output(file, part++);
      output.setFrameBuffer(pixels->buffer);
      output.writePixels(pixels == &right ? 4 : 10);
    }
  }
  FrameFile file(folder / "f.exr", {});
  EXPECT_EQ(file.views(), (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(file.common_planes(), (std::vector<std::string>{"depth", "mask"}));
  const Frame frame = file.read({"depth", "mask"});
  EXPECT_EQ(frame.view("left").find("depth")->channels[0].at(3, 4), ramp(3, 4));
  EXPECT_EQ(frame.view("right").find("depth")->channels[0].at(3, 4), 2);
  EXPECT_EQ(frame.view("right").find("depth")->channels[0].at(6, 4), inf);
  for (const View& view : frame.views) EXPECT_EQ(view.find("mask")->channels[0].at(4, 9), 1);
  ReadOptions one;
  one.views = {"right"};
  EXPECT_EQ(FrameFile(folder / "f.exr", one).read({"depth"}).views.size(), 1u);
}

TEST(ReadExr, ReturnsOnlyWhatWasAskedFor) {
  Folder folder;
  write_exr(folder / "f.exr", Imf::Header(8, 8),
            {{"Z", Imf::FLOAT, [](int x, int) { return x < 4 ? 5.f : 1e10f; }},
             {"N.X", Imf::FLOAT, [](int, int) { return 0.f; }},
             {"N.Y", Imf::FLOAT, [](int, int) { return 0.f; }},
             {"N.Z", Imf::FLOAT, [](int, int) { return 2.f; }}});
  const Frame frame = FrameFile(folder / "f.exr", {}).read({"normal", "albedo"});
  ASSERT_EQ(frame.views[0].planes.size(), 1u);
  const Plane& normal = *frame.views[0].find("normal");
  EXPECT_EQ(normal.channels[2].at(0, 0), 1) << "made unit";
  EXPECT_EQ(normal.channels[2].at(7, 0), 0) << "depth, though not returned, tells the background";
}

TEST(ReadExr, AssumesACameraAndSaysSo) {
  Folder folder;
  write_exr(folder / "f.exr", Imf::Header(200, 100), {{"Z", Imf::FLOAT, ramp}});
  FrameFile file(folder / "f.exr", {});
  EXPECT_FALSE(file.camera("").has_value());
  const Frame frame = file.read({"depth"});
  EXPECT_NEAR(frame.views[0].camera->fx, 100 / std::tan(M_PI / 6), 1e-9);
  ASSERT_FALSE(frame.assumed.empty());
  EXPECT_NE(frame.assumed[0].find("60 degrees"), std::string::npos);
  ReadOptions options;
  options.fov_degrees = 90;
  options.far = 40;
  FrameFile flagged(folder / "f.exr", options);
  EXPECT_NEAR(flagged.camera("")->fx, 100, 1e-9);
  EXPECT_EQ(flagged.camera("")->far, 40);
}

/// All of the frame's sentences, one per line.
std::string assumed_in(const fs::path& path, const std::vector<std::string>& planes = {"depth"},
                       const ReadOptions& options = {}) {
  std::string all;
  for (const std::string& sentence : FrameFile(path, options).read(planes).assumed) all += sentence + "\n";
  return all;
}

void expect_in(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

void expect_not_in(const std::string& text, const std::string& part) {
  EXPECT_EQ(text.find(part), std::string::npos) << "'" << part << "' is in: " << text;
}

TEST(ReadExr, AsStoredMeasuresWhatTheFileHolds) {
  Folder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  write_exr(folder / "f.exr", Imf::Header(4, 1),
            {{"AO", Imf::FLOAT,
              [&](int x, int) {
                return std::vector<float>{1.5f, -0.5f, nan, inf}[size_t(x)];
              }},
             {"R", Imf::FLOAT, [&](int x, int) { return x == 2 ? nan : 7.f; }},
             {"G", Imf::FLOAT, ramp},
             {"B", Imf::FLOAT, ramp},
             {"N.X", Imf::FLOAT, [&](int x, int) { return x == 1 ? nan : 0.f; }},
             {"N.Y", Imf::FLOAT, [](int, int) { return 0.f; }},
             {"N.Z", Imf::FLOAT, [](int, int) { return 2.f; }},
             {"Z", Imf::FLOAT, [](int x, int) { return x == 3 ? 1e11f : 2.f; }}});
  ReadOptions options;
  options.normals.space = NormalSpace::view;
  const std::vector<std::string> planes = {"depth", "ao", "color", "normal"};
  const Frame repaired = FrameFile(folder / "f.exr", options).read(planes);
  options.as_stored = true;
  const Frame stored = FrameFile(folder / "f.exr", options).read(planes);
  const Channel &ao = stored.views[0].find("ao")->channels[0], &repaired_ao = repaired.views[0].find("ao")->channels[0];
  EXPECT_EQ(ao.at(0, 0), 1.5f);
  EXPECT_EQ(ao.at(1, 0), -0.5f);
  EXPECT_TRUE(std::isnan(ao.at(2, 0)));
  EXPECT_EQ(ao.at(3, 0), inf);
  EXPECT_EQ(repaired_ao.at(0, 0), 1);
  EXPECT_EQ(repaired_ao.at(2, 0), 1);
  for (const Frame* frame : {&repaired, &stored}) {
    EXPECT_EQ(frame->views[0].find("depth")->channels[0].at(3, 0), inf) << "depth is converted all the same";
    EXPECT_EQ(frame->views[0].find("ao")->channels[0].row(0)[4], 1) << "padding";
  }
  EXPECT_TRUE(std::isnan(stored.views[0].find("color")->channels[0].at(2, 0)));
  EXPECT_TRUE(std::isnan(stored.views[0].find("normal")->channels[0].at(1, 0)));
  EXPECT_EQ(stored.views[0].find("normal")->channels[2].at(0, 0), 2);
}

TEST(ReadExr, NonfiniteIsCountedInsideTheDataWindow) {
  Folder folder;
  write_exr(folder / "f.exr", Imf::Header(box(0, 0, 9, 9), box(2, 3, 6, 5)),
            {{"Z", Imf::FLOAT, [](int x, int y) { return x == 4 && y == 4 ? inf : 1.f; }}});
  ReadOptions options;
  options.count_nonfinite = true;
  FrameFile file(folder / "f.exr", options);
  for (int pass = 0; pass < 2; ++pass) {
    file.read({"depth"});
    EXPECT_EQ(file.nonfinite("depth", ""), 1);
  }
}

TEST(ReadExr, NotesOnDepthAndNormals) {
  Folder folder;
  const auto write = [&](const char* name, const Value& depth) {
    write_exr(folder / name, Imf::Header(8, 8), {{"Z", Imf::FLOAT, depth}});
    return folder / name;
  };
  ReadOptions options;
  options.background = 65504.0f;
  const fs::path ordinary = write("a.exr", [](int x, int y) { return x + y == 0 ? 65504.f : 2.f; });
  expect_not_in(assumed_in(ordinary, {"depth"}, options), "--background");
  expect_not_in(assumed_in(ordinary), "background");
  options.background = 1000.0f;
  expect_in(assumed_in(ordinary, {"depth"}, options), "no pixel is 1000 (--background)");
  expect_in(assumed_in(write("b.exr", [](int, int) { return 1e10f; })), "no pixel has a usable depth");
  expect_in(assumed_in(write("c.exr", [](int x, int) { return x == 3 ? -2.f : 2.f; })), "8 negative values");
  write_exr(folder / "n.exr", Imf::Header(8, 8),
            {{"Z", Imf::FLOAT, [](int, int y) { return y == 7 ? inf : 2.f; }},
             {"N.X", Imf::FLOAT, [](int, int) { return 0.f; }},
             {"N.Y", Imf::FLOAT, [](int, int) { return 0.f; }},
             {"N.Z", Imf::FLOAT, [](int x, int) { return x == 3 ? 0.f : 1.f; }}});
  expect_in(assumed_in(folder / "n.exr", {"normal"}), "normals: 7 pixels of the foreground have none");
}

TEST(ReadExr, PlanesThatOneViewLacksAreNamed) {
  Folder folder;
  Imf::Header header(8, 8);
  Imf::addMultiView(header, {"left", "right"});
  const auto one = [](int, int) { return 1.f; };
  write_exr(folder / "f.exr", header,
            {{"Z", Imf::FLOAT, one},
             {"right.Z", Imf::FLOAT, one},
             {"N.X", Imf::FLOAT, one},
             {"N.Y", Imf::FLOAT, one},
             {"N.Z", Imf::FLOAT, one}});
  FrameFile file(folder / "f.exr", {});
  EXPECT_EQ(file.common_planes(), std::vector<std::string>{"depth"});
  EXPECT_EQ(file.why_missing("normal"), "view 'right' has no normal");
  EXPECT_EQ(file.why_missing("depth"), "");
  EXPECT_EQ(file.why_missing("albedo"), "") << "no view has it";
  EXPECT_FALSE(file.view_is_assumed());
  expect_in(assumed_in(folder / "f.exr"), "view 'right' has no normal");
  ReadOptions options;
  options.views = {"left"};
  expect_not_in(assumed_in(folder / "f.exr", {"depth"}, options), "no normal");
}

TEST(ReadExr, AViewThatNoChannelNamesIsAssumed) {
  Folder folder;
  Imf::Header header(8, 8);
  Imf::addMultiView(header, {"left", "right"});
  write_exr(folder / "f.exr", header, {{"Z", Imf::FLOAT, ramp}});
  EXPECT_TRUE(FrameFile(folder / "f.exr", {}).view_is_assumed());
  expect_in(assumed_in(folder / "f.exr"), "taken for 'left'");
  ReadOptions options;
  options.views = {"right"};
  EXPECT_FALSE(FrameFile(folder / "f.exr", options).view_is_assumed());
}

// --- Cameras of a file
// ------------------------------------------------------------------------------------------------

constexpr const char* two_cameras =
    R"({"views": [{"view": "left", "fx": 9, "fy": 9, "cx": 4, "cy": 4,
                   "camera_to_world": [[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]},
                  {"view": "right", "fx": 9, "fy": 9, "cx": 4, "cy": 4,
                   "camera_to_world": [[1,0,0,2],[0,1,0,2],[0,0,1,3],[0,0,0,1]]}]})";
constexpr const char* one_camera =
    R"({"near": 0.5, "far": 20, "fx": 9, "fy": 9, "cx": 4, "cy": 4,
        "camera_to_world": [[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]})";

TEST(CameraOfFile, JsonWhoseViewsDoNotFit) {
  Folder folder;
  fs::create_directory(folder / "other");
  std::ofstream(folder / "other/stereo.json") << two_cameras;
  std::ofstream(folder / "other/mono.json") << one_camera;
  write_exr(folder / "f.exr", Imf::Header(8, 8), {{"Z", Imf::FLOAT, ramp}});
  Imf::Header header(8, 8);
  Imf::addMultiView(header, {"left", "right"});
  write_exr(folder / "pair.exr", header, {{"Z", Imf::FLOAT, ramp}, {"right.Z", Imf::FLOAT, ramp}});
  ReadOptions options;
  options.camera_file = folder / "other/stereo.json";
  EXPECT_TRUE(FrameFile(folder / "pair.exr", options).camera("right").has_value());
  expect_in(read_error(folder / "f.exr", {"depth"}, options),
            "stereo.json has the views left and right, and f.exr names none; ");
  options.camera_file = folder / "other/mono.json";
  EXPECT_TRUE(FrameFile(folder / "f.exr", options).camera("").has_value());
  expect_in(read_error(folder / "pair.exr", {"depth"}, options),
            "mono.json has one camera that names no view, and pair.exr has the views left and right; ");
  // Found, but not asked for: a note, without a statement that there is no camera.
  std::ofstream(folder / "camera_stereo.json") << two_cameras;
  const std::string assumed = assumed_in(folder / "f.exr");
  expect_in(assumed, "camera_stereo.json has the views left and right, and f.exr names none: it is not used");
  expect_in(assumed, "60 degrees");
  expect_not_in(assumed, "none by flag");
}

TEST(CameraOfFile, JsonBesideItThatCannotBeRead) {
  Folder folder;
  write_exr(folder / "f.exr", Imf::Header(8, 8), {{"Z", Imf::FLOAT, ramp}});
  std::ofstream(folder / "f.json") << "{";
  expect_in(assumed_in(folder / "f.exr"), "f.json is there but is no camera (not readable as JSON");
  for (const char* name : {"f.camera.json", "camera.json"})
    for (const char* text : {"", "{", "\"\xff\"", "{\"near\": NaN, "}) {
      std::ofstream(folder / name) << text;
      expect_one_line(read_error(folder / "f.exr"), name, "JSON");
      fs::remove(folder / name);
    }
}

TEST(CameraOfFile, NearAndFar) {
  Folder folder;
  const fs::path path = folder / "f.exr";
  Imf::Header header(8, 8);
  write_exr(path, header, {{"Z", Imf::FLOAT, ramp}});
  ReadOptions options;
  options.near = options.far = 5;
  EXPECT_EQ(read_error(path, {"depth"}, options), "--near 5 --far 5: near must be less than far");
  EXPECT_THROW(FrameFile(path, options), UsageError);
  std::ofstream(folder / "camera.json") << one_camera;
  options.near = 50;
  options.far.reset();
  expect_in(read_error(path, {"depth"}, options), "--near 50: must be less than far, 20 (camera.json)");
  options.far = 0.25;
  options.near.reset();
  expect_in(read_error(path, {"depth"}, options), "--far 0.25: must be more than near, 0.5 (camera.json)");
}

/// A camera at (1, 2, 3), as OpenEXR writes it.
Imath::M44f world_to_camera() { return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, -1, -2, 3, 1}; }
/// 90 degrees wide.
Imath::M44f world_to_ndc() { return {0.5f, 0, 0, 0, 0, -0.5f, 0, 0, -0.5f, -0.5f, -1, -1, 1, 2.5f, 2, 3}; }

TEST(CameraOfFile, PoseOfAHeaderWithoutProjection) {
  Folder folder;
  const fs::path path = folder / "f.exr";
  Imf::Header header(8, 8);
  header.insert("worldToCamera", Imf::M44fAttribute(world_to_camera()));
  write_exr(path, header, {{"Z", Imf::FLOAT, ramp}});
  const auto is_posed = [](const std::optional<Camera>& camera) {
    return camera && camera->pose && glm::length(camera->pose->position - glm::dvec3(1, 2, 3)) < 1e-6;
  };
  const Frame frame = FrameFile(path, {}).read({"depth"});
  EXPECT_TRUE(is_posed(frame.views[0].camera));
  const std::string assumed = assumed_in(path);
  expect_in(assumed, "worldToCamera and no worldToNDC");
  expect_in(assumed, "60 degrees");
  expect_not_in(assumed, "none by flag");
  ReadOptions options;
  options.fov_degrees = 90;
  EXPECT_TRUE(is_posed(FrameFile(path, options).camera("")));
  EXPECT_NEAR(FrameFile(path, options).camera("")->fx, 4, 1e-9);
  std::string moved = one_camera;
  moved.replace(moved.find("[1,0,0,1]"), 9, "[1,0,0,7]");
  std::ofstream(folder / "camera.json") << moved;
  EXPECT_TRUE(is_posed(FrameFile(path, {}).camera(""))) << "the header wins over the JSON";
  EXPECT_EQ(FrameFile(path, {}).camera("")->fx, 9);
}

TEST(CameraOfFile, HeaderOfWhichNothingCanBeUsed) {
  Folder folder;
  Imf::Header half(8, 8);
  half.insert("worldToNDC", Imf::M44fAttribute(world_to_ndc()));
  write_exr(folder / "f.exr", half, {{"Z", Imf::FLOAT, ramp}});
  EXPECT_FALSE(FrameFile(folder / "f.exr", {}).camera("").has_value());
  expect_in(assumed_in(folder / "f.exr"), "worldToNDC and no worldToCamera");
  for (const auto& [near, far] : {std::pair(0.f, 10.f), std::pair(1.f, -1.f), std::pair(5.f, 5.f)}) {
    Imf::Header header(8, 8);
    header.insert("worldToCamera", Imf::M44fAttribute(world_to_camera()));
    header.insert("worldToNDC", Imf::M44fAttribute(world_to_ndc()));
    header.insert("near", Imf::FloatAttribute(near));
    header.insert("far", Imf::FloatAttribute(far));
    write_exr(folder / "g.exr", header, {{"Z", Imf::FLOAT, ramp}});
    const std::optional<Camera> camera = FrameFile(folder / "g.exr", {}).camera("");
    ASSERT_TRUE(camera.has_value());
    EXPECT_NEAR(camera->fx, 4, 1e-5);
    EXPECT_FALSE(camera->near && camera->far);
    expect_in(assumed_in(folder / "g.exr"), "in the header is impossible and is not used");
  }
}

TEST(RefuseExr, StrangeNamesAreShownInASafeWay) {
  Folder folder;
  const fs::path path = folder / "f\x1b[2J\n.exr";
  write_exr(path, Imf::Header(8, 8), {{"a\x1b[31m.Z", Imf::FLOAT, ramp}, {"b\n.Z", Imf::FLOAT, ramp}});
  ReadOptions options;
  options.channels = {{"depth", "nothing_like_it"}};
  const std::string message = read_error(path, {"depth"}, options);
  expect_in(message, "f\\x1b[2J\\x0a.exr");
  expect_in(message, "a\\x1b[31m.Z");
  expect_not_in(message, "\n");
  expect_not_in(message, "\x1b");
}

TEST(ReadExr, DistanceByNameIsBroughtToPlanarDepth) {
  Folder folder;
  write_exr(folder / "f.exr", Imf::Header(101, 101), {{"distance.Y", Imf::FLOAT, [](int, int) { return 10.f; }}});
  ReadOptions options;
  options.fov_degrees = 90;
  FrameFile file(folder / "f.exr", options);
  EXPECT_EQ(file.depth_convention(), "ray");
  const Frame frame = file.read({"depth"});
  const Channel& depth = frame.views[0].find("depth")->channels[0];
  EXPECT_NEAR(depth.at(50, 50), 10, 1e-4);
  const double edge = 50.0 / 50.5;  // pixel centre, over the distance at which a pixel is a unit
  EXPECT_NEAR(depth.at(100, 50), 10 / std::sqrt(1 + edge * edge), 1e-4);
  options.depth = DepthConvention::z;
  EXPECT_EQ(FrameFile(folder / "f.exr", options).read({"depth"}).views[0].find("depth")->channels[0].at(100, 50), 10);
}

TEST(ReadExr, AReflectanceThatSaysNothingIsSaid) {
  Folder folder;
  const auto write = [&](float share) {  // of the row that is 1
    const auto gloss = [share](int x, int) { return float(x) < 10 * share ? 1 : 0.5f; };
    write_exr(folder / "f.exr", Imf::Header(11, 2),
              {{"L.Depth.Z", Imf::FLOAT, [](int x, int) { return x < 10 ? 3 : 1e10f; }},
               {"L.GlossCol.R", Imf::HALF, gloss},
               {"L.GlossCol.G", Imf::HALF, gloss},
               {"L.GlossCol.B", Imf::HALF, gloss}});
  };
  const auto notes = [&](const ReadOptions& options) {
    return fmt::format("{}",
                       fmt::join(FrameFile(folder / "f.exr", options).read({"depth", "reflectance"}).assumed, "; "));
  };
  write(0.8f);
  EXPECT_NE(notes({}).find("GlossCol is 1 on 80 % of the surfaces"), std::string::npos) << notes({});
  EXPECT_EQ(notes({.channels = {{"reflectance", "L.GlossCol"}}}).find("GlossCol is 1"), std::string::npos);
  write(0.2f);
  EXPECT_EQ(notes({}).find("GlossCol is 1"), std::string::npos) << notes({});
}

TEST(ReadExr, MotionOfBlenderIsTurnedYDown) {
  Folder folder;
  write_exr(folder / "f.exr", Imf::Header(4, 4),
            {{"L.Vector.X", Imf::FLOAT, [](int, int) { return 3.f; }},
             {"L.Vector.Y", Imf::FLOAT, [](int, int) { return 2.f; }}});
  const Frame frame = FrameFile(folder / "f.exr", {}).read({"motion"});
  EXPECT_EQ(frame.views[0].find("motion")->channels[0].at(1, 1), 3);
  EXPECT_EQ(frame.views[0].find("motion")->channels[1].at(1, 1), -2);
}

TEST(ReadExr, OneChannelMayServeTwoPlanes) {
  Folder folder;
  write_exr(folder / "f.exr", Imf::Header(4, 4), {{"AO", Imf::FLOAT, [](int x, int) { return float(x) / 4; }}});
  ReadOptions options;
  options.channels = {{"mask", "AO"}};
  const Frame frame = FrameFile(folder / "f.exr", options).read({"ao", "mask"});
  EXPECT_EQ(frame.views[0].find("ao")->channels[0].at(3, 2), 0.75f);
  EXPECT_EQ(frame.views[0].find("mask")->channels[0].at(3, 2), 0.75f);
}

// --- Refusals
// ---------------------------------------------------------------------------------------------------------

TEST(RefuseExr, WhatIsNoFileOrNoExr) {
  Folder folder;
  expect_one_line(read_error(folder / "none.exr"), "none.exr", "No such file");
  expect_one_line(read_error(folder.path), folder.path, "is a folder");
  std::ofstream(folder / "text.exr") << "hello, this is text";
  expect_one_line(read_error(folder / "text.exr"), "text.exr", "not an EXR");
  std::ofstream(folder / "empty.exr").close();
  expect_one_line(read_error(folder / "empty.exr"), "empty.exr", "not an EXR");
  ::mkfifo((folder / "pipe.exr").c_str(), 0600);
  expect_one_line(read_error(folder / "pipe.exr"), "pipe.exr", "pipe");
}

TEST(RefuseExr, EveryTruncation) {
  Folder folder;
  for (const bool tiled : {false, true}) {
    const fs::path path = folder / "f.exr";
    write_exr(path, Imf::Header(64, 64), {{"Z", Imf::FLOAT, [](int x, int y) { return 1 + std::sin(float(x * y)); }}},
              tiled);
    const auto size = fs::file_size(path);
    for (int keep = 0; keep < 20; ++keep) {
      fs::copy_file(path, folder / "cut.exr", fs::copy_options::overwrite_existing);
      fs::resize_file(folder / "cut.exr", size * uintmax_t(keep) / 20);
      const std::string message = read_error(folder / "cut.exr");
      ASSERT_FALSE(message.empty()) << "read with " << keep << "/20 of its bytes, tiled " << tiled;
      expect_one_line(message, "cut.exr", "");
    }
  }
}

TEST(RefuseExr, ClaimsOfTooManyPixels) {
  Folder folder;
  const fs::path path = folder / "f.exr";
  write_exr(path, Imf::Header(64, 64), {{"Z", Imf::FLOAT, ramp}});
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const size_t at = bytes.find("dataWindow") + 11 + 6 + 4;  // name, type "box2i", size
  for (const int32_t extent : {100000, 1000000000, 2147483647}) {
    const int32_t window[4] = {0, 0, extent, extent};
    file.clear();
    file.seekp(std::streamoff(at));
    file.write(reinterpret_cast<const char*>(window), sizeof window);
    file.flush();
    expect_one_line(read_error(path), path, "2^28");
  }
  const int32_t backwards[4] = {5, 5, -2147483647, 3};
  file.seekp(std::streamoff(at));
  file.write(reinterpret_cast<const char*>(backwards), sizeof backwards);
  file.flush();
  expect_one_line(read_error(path), path, "corrupted");
}

/// Replaces the size of the attribute with this name and type.
void claim_size(const fs::path& path, const std::string& name, const std::string& type, uint32_t size) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}}, start = name + '\0' + type + '\0';
  ASSERT_NE(bytes.find(start), std::string::npos);
  file.seekp(std::streamoff(bytes.find(start) + start.size()));
  file.write(reinterpret_cast<const char*>(&size), sizeof size);
}

/// OpenEXR allocates the stated size, and reads on behind the size of the type.
TEST(RefuseExr, AttributesOfAnotherSizeThanTheyHave) {
  Folder folder;
  const fs::path path = folder / "f.exr";
  const auto refused_for = [&](const std::string& name, const std::string& type, uint32_t size) {
    Imf::Header header(8, 8);
    Imf::addComments(header, "none");
    Imf::addMultiView(header, {"left", "right"});
    header.insert("near", Imf::FloatAttribute(1));
    write_exr(path, header, {{"Z", Imf::FLOAT, ramp}});
    claim_size(path, name, type, size);
    expect_one_line(read_error(path), path, "attribute " + name);
  };
  for (const uint32_t size : {2000000000u, 0xffffffffu}) {
    refused_for("comments", "string", size);
    refused_for("near", "float", size);
    refused_for("channels", "chlist", size);
    refused_for("multiView", "stringvector", size);
  }
  for (const uint32_t size : {0u, 3u, 5u}) refused_for("near", "float", size);
  refused_for("channels", "chlist", 10);
  refused_for("multiView", "stringvector", 9);
}

void claim_tiles(const fs::path& path, uint32_t width, uint32_t height) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const uint32_t size[2] = {width, height};
  file.seekp(std::streamoff(bytes.find("tiledesc") + 9 + 4));
  file.write(reinterpret_cast<const char*>(size), sizeof size);
}

/// OpenEXR allocates a buffer of a tile's size; gloam's is no larger than the image.
TEST(RefuseExr, TilesFarLargerThanTheImage) {
  Folder folder;
  const fs::path path = folder / "f.exr";
  write_exr(path, Imf::Header(8, 8), {{"other", Imf::HALF, ramp}}, true);
  claim_tiles(path, 1, 1 << 28);
  error_of([&] { FrameFile(path, {}).verify(); });
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  EXPECT_LT(used.ru_maxrss, 4 << 20) << "KiB";
  for (const uint32_t size : {1u << 16, 0x7fffffffu, 0xb504f334u, 0xfffffff0u}) {
    claim_tiles(path, size, size);
    const std::string message = error_of([&] { FrameFile(path, {}).verify(); });
    expect_one_line(message, path, "corrupted");
  }
}

TEST(RefuseExr, MorePixelsThanAskedFor) {
  Folder folder;
  write_exr(folder / "f.exr", Imf::Header(32, 32), {{"Z", Imf::FLOAT, ramp}});
  ReadOptions options;
  options.most_pixels = 1 << 10;
  EXPECT_EQ(read_error(folder / "f.exr", {"depth"}, options), "");
  options.most_pixels = 1 << 9;
  expect_one_line(read_error(folder / "f.exr", {"depth"}, options), "f.exr", "2^9");
}

TEST(RefuseExr, WindowsThatAreFarApart) {
  Folder folder;
  write_exr(folder / "f.exr", Imf::Header(box(0, 0, 9, 9), box(100000000, 100000000, 100000009, 100000009)),
            {{"Z", Imf::FLOAT, [](int, int) { return 1.f; }}});
  expect_one_line(read_error(folder / "f.exr"), "f.exr", "2^28");
}

TEST(RefuseExr, SubsampledChannelsOnlyWhereTheyAreAskedFor) {
  Folder folder;
  const fs::path path = folder / "f.exr";
  Imf::Header header(8, 8);
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  header.channels().insert("mask", Imf::Channel(Imf::FLOAT, 2, 2));
  std::vector<float> values(64, 3);
  Imf::FrameBuffer buffer;
  buffer.insert("Z", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 32));
  buffer.insert("mask", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 16, 2, 2));
  {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(8);
  }
  EXPECT_EQ(FrameFile(path, {}).read({"depth"}).views[0].find("depth")->channels[0].at(3, 3), 3);
  expect_one_line(read_error(path, {"mask"}), path, "subsampled 2 x 2");
}

TEST(RefuseExr, WrongPlaneChannelAndView) {
  Folder folder;
  write_exr(folder / "f.exr", Imf::Header(4, 4), {{"My.Z", Imf::FLOAT, ramp}});
  ReadOptions options;
  options.channels = {{"depth", "My.Y"}};
  expect_one_line(read_error(folder / "f.exr", {"depth"}, options), "f.exr", "did you mean 'My.Z'");
  options.channels = {{"dept", "My.Z"}};
  expect_one_line(read_error(folder / "f.exr", {"depth"}, options), "f.exr", "did you mean 'depth'");
  options.channels = {};
  options.views = {"left"};
  expect_one_line(read_error(folder / "f.exr", {"depth"}, options), "f.exr", "left");
}

// --- Writing
// ----------------------------------------------------------------------------------------------------------

Plane plane_of(const std::string& name, const Layout& layout, const Value& value) {
  Plane plane{name, {}};
  for (size_t c = 0; c < plane_kind(name).channels.size(); ++c) {
    Channel& channel = plane.channels.emplace_back(layout, 0);
    for (int y = 0; y < layout.height; ++y)
      for (int x = 0; x < layout.width; ++x) channel.at(x, y) = value(x + int(c), y);
  }
  return plane;
}

Frame stereo_frame() {
  Frame frame;
  frame.display = {0, 0, 40, 20};
  frame.window = {-2, 0, 40, 23};
  const Layout layout(42, 23);
  for (const char* name : {"left", "right"}) {
    View& view = frame.views.emplace_back();
    view.name = name;
    const float shift = view.name == "left" ? 0 : 1000;
    Camera& camera = view.camera.emplace();
    camera.fx = camera.fy = 35;
    camera.cx = 20;
    camera.cy = 10;
    camera.near = 0.5;
    camera.far = 1e9;
    camera.pose = Pose{glm::dmat3(1.0), {1e7 + shift, 2, 3}};
    camera.source = "test";
    for (const char* plane : {"depth", "ao", "peel.00", "instance"})
      view.planes[plane] = plane_of(plane, layout, [&](int x, int y) {
        return view.find("depth") && std::string(plane) == "ao" ? float(x % 2) / 2 : 1 + shift + float(x + 100 * y);
      });
    view.planes["normal"] = plane_of("normal", layout, [](int, int) { return 0.577350269f; });
  }
  normalise(frame);
  return frame;
}

TEST(WriteExr, RoundTripIsExact) {
  Folder folder;
  const Frame frame = stereo_frame();
  write_frame(folder / "f.exr", frame);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 1) << "no temporary is left";
  FrameFile file(folder / "f.exr", {});
  EXPECT_EQ(file.views(), (std::vector<std::string>{"left", "right"}));
  const Frame back = file.read({"depth", "ao", "peel.00", "instance", "normal"});
  EXPECT_EQ(back.window, frame.window);
  EXPECT_EQ(back.display, frame.display);
  EXPECT_EQ(file.normal_space(), "view");
  for (const View& view : frame.views)
    for (const auto& [name, plane] : view.planes)
      for (size_t c = 0; c < plane.channels.size(); ++c)
        for (int y = 0; y < frame.height(); ++y)
          for (int x = 0; x < frame.width(); ++x)
            ASSERT_NEAR(back.view(view.name).find(name)->channels[c].at(x, y), plane.channels[c].at(x, y),
                        name == "normal" ? 1e-6 : 0)
                << name << " " << x << " " << y;
  for (const View& view : frame.views) {
    const Camera camera = *back.view(view.name).camera;
    EXPECT_NEAR(camera.fx, 35, 1e-4);
    EXPECT_NEAR(camera.pose->position.x, view.camera->pose->position.x, 1e-6) << "the origin is kept in double";
    EXPECT_EQ(camera.near, 0.5);
    EXPECT_EQ(camera.far, 1e9f);
  }
}

TEST(WriteExr, NamesAndTypesAreThoseOfTheContract) {
  Folder folder;
  WriteOptions options;
  options.half = true;
  write_frame(folder / "f.exr", stereo_frame(), options);
  Imf::InputFile file((folder / "f.exr").c_str());
  const Imf::ChannelList& channels = file.header().channels();
  for (const char* name : {"Z", "AO", "N.X", "instance", "peel.00.Z", "right.Z", "right.AO", "N.right.X"})
    EXPECT_TRUE(channels.findChannel(name)) << name;
  EXPECT_EQ(channels["Z"].type, Imf::FLOAT);
  EXPECT_EQ(channels["AO"].type, Imf::HALF);
  EXPECT_EQ(channels["instance"].type, Imf::UINT);
  EXPECT_EQ(Imf::multiView(file.header()), (Imf::StringVector{"left", "right"}));
  for (const char* name : {"worldToCamera", "worldToNDC", "gloamOrigin", "right.worldToCamera", "near", "right.far"})
    EXPECT_TRUE(file.header().find(name) != file.header().end()) << name;
  EXPECT_EQ(file.header().dataWindow(), box(-2, 0, 39, 22));
  EXPECT_EQ(file.header().displayWindow(), box(0, 0, 39, 19));
}

/// Every plane that gloam has a name for, and layers of every stack.
std::vector<std::string> planes_of_all_kinds() {
  std::vector<std::string> names;
  for (const PlaneKind& kind : plane_kinds()) names.push_back(kind.name);
  for (const StackKind& stack : stack_kinds()) {
    for (const int number : {0, 1, 15}) names.push_back(layer_name(stack.name, number));
  }
  return names;
}

/// Views with all these planes, each channel of another value.
Frame frame_of(const std::vector<std::string>& planes, const std::vector<std::string>& views) {
  Frame frame;
  frame.display = frame.window = {0, 0, 3, 2};
  int number = 0;
  for (const std::string& name : views) {
    View& view = frame.views.emplace_back();
    view.name = name;
    for (const std::string& plane : planes) {
      Plane& made = view.planes[plane];
      made.name = plane;
      for (size_t i = 0; i < plane_kind(plane).components.size(); ++i)
        made.channels.emplace_back(Layout(3, 2), float(++number) / 256);
    }
  }
  return frame;
}

TEST(WriteExr, EveryPlaneIsReadBackByItsName) {
  Folder folder;
  ReadOptions options;
  options.as_stored = true;
  options.normals.space = NormalSpace::view;
  for (const std::vector<std::string>& views : {std::vector<std::string>{""}, {"left", "right"}, {"main", "view2"}}) {
    const Frame frame = frame_of(planes_of_all_kinds(), views);
    write_frame(folder / "f.exr", frame);
    FrameFile file(folder / "f.exr", options);
    EXPECT_EQ(file.views(), views);
    EXPECT_EQ(file.planes().size(), views.size() * planes_of_all_kinds().size()) << "each once, and nothing else";
    const Frame back = file.read(planes_of_all_kinds());
    for (const View& view : frame.views) {
      for (const auto& [name, plane] : view.planes) {
        const Plane* read = back.view(view.name).find(name);
        ASSERT_TRUE(read) << name << " of view '" << view.name << "'";
        ASSERT_EQ(read->channels.size(), plane.channels.size()) << name;
        const bool is_identity = name == "instance";  // a whole number in the file
        for (size_t i = 0; i < plane.channels.size(); ++i)
          EXPECT_EQ(read->channels[i].at(1, 1), is_identity ? 0 : plane.channels[i].at(1, 1)) << name << " " << i;
      }
    }
  }
}

// A plane alone in a file has no neighbours that could identify it.
TEST(WriteExr, EveryPlaneAloneIsReadBackByItsName) {
  Folder folder;
  for (const std::string& name : planes_of_all_kinds()) {
    write_frame(folder / "f.exr", frame_of({name}, {""}));
    const FrameFile file(folder / "f.exr", {});
    const bool leads_to_depth = name == "position";
    ASSERT_EQ(file.planes().size(), leads_to_depth ? 2u : 1u) << name;
    EXPECT_EQ(file.planes().back().plane, name);
    EXPECT_EQ(file.planes().front().plane, leads_to_depth ? "depth" : name);
  }
}

TEST(WriteExr, AssumedCameraDoesNotBecomeKnowledge) {
  Folder folder;
  write_exr(folder / "in.exr", Imf::Header(8, 8), {{"Z", Imf::FLOAT, ramp}});
  write_frame(folder / "out.exr", FrameFile(folder / "in.exr", {}).read({"depth"}));
  const auto camera = FrameFile(folder / "out.exr", {}).camera("");
  ASSERT_TRUE(camera.has_value());
  EXPECT_FALSE(camera->pose.has_value());
  EXPECT_NE(camera->source.find("assumed"), std::string::npos);
}

TEST(WriteExr, PositionsMoveWithTheirOrigin) {
  Folder folder;
  Frame frame = stereo_frame();
  frame.views.resize(1);
  frame.views[0].name = "";
  View& view = frame.views[0];
  view.origin = {1e7, 0, 0};  // the camera stands at (1e7, 2, 3)
  view.planes["position"] = plane_of("position", Layout(42, 23), [](int, int) { return 7.f; });
  write_frame(folder / "f.exr", frame);
  const Frame back = FrameFile(folder / "f.exr", {}).read({"position"});
  const View& read = back.views[0];
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(read.find("position")->channels[size_t(c)].at(5, 5) + read.origin[c], 7 + view.origin[c], 1e-5);
}

TEST(WriteExr, WhatCannotBeWrittenIsNamed) {
  Folder folder;
  std::ofstream(folder / "file") << "x";
  const Frame frame = stereo_frame();
  expect_one_line(error_of([&] { write_frame(folder / "file/out.exr", frame); }), "out.exr", "cannot write");
  expect_one_line(error_of([&] { write_frame(folder.path, frame); }), folder.path, "it is a folder");
  WriteOptions options;
  options.compression = "zpi";
  EXPECT_NE(error_of([&] { write_frame(folder / "f.exr", frame, options); }).find("zip"), std::string::npos);
}

/// A limit on the file size fails writes like a full disk, at any point: in the pixels, or in the table that is written last.
TEST(WriteExr, DiskThatFillsUpLeavesTheOldFile) {
  Folder folder;
  const fs::path path = folder / "f.exr";
  const Frame frame = stereo_frame();
  write_frame(path, frame);
  const auto size = fs::file_size(path);
  ::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  for (const rlim_t limit : {rlim_t(0), rlim_t(100), rlim_t(size / 2), rlim_t(size - 1)}) {
    const rlimit small{limit, before.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
    const std::string message = error_of([&] { write_frame(path, frame); });
    ::setrlimit(RLIMIT_FSIZE, &before);
    expect_one_line(message, path, "cannot write");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 1) << "the temporary is removed";
    EXPECT_EQ(fs::file_size(path), size);
  }
  ::signal(SIGXFSZ, SIG_DFL);
}

// --- Real files
// -------------------------------------------------------------------------------------------------------

class ExrCaptures : public testing::Test {
 protected:
  fs::path root = GLOAM_CAPTURES;
  void SetUp() override {
    if (!fs::is_directory(root)) GTEST_SKIP() << root << " is not here: the checks on real files did not run";
  }
};

TEST_F(ExrCaptures, BlenderStereo) {
  FrameFile file(root / "apartment_stereo" / "apartment_stereo_exact.exr", {});
  EXPECT_EQ(file.views(), (std::vector<std::string>{"left", "right"}));
  const Frame frame = file.read({"depth", "normal"});
  EXPECT_EQ(file.normal_space(), "world");
  for (const View& view : frame.views) {
    EXPECT_EQ(view.camera->source, "camera_stereo.json");
    const Channel& z = view.find("normal")->channels[2];
    long facing = 0, all = 0;
    for (int y = 0; y < frame.height(); ++y)
      for (int x = 0; x < frame.width(); ++x) {
        if (is_background(view.find("depth")->channels[0].at(x, y))) continue;
        ++all;
        facing += z.at(x, y) > -0.6f;
      }
    EXPECT_GT(double(facing) / double(all), 0.99) << "view-space normals face the camera";
  }
}

TEST_F(ExrCaptures, BeachballOnePartAndManyAgree) {
  const fs::path folder = root / "openexr-images";
  const Frame one = FrameFile(folder / "Beachball_singlepart.0001.exr", {}).read({"depth", "color", "alpha"});
  const Frame many = FrameFile(folder / "Beachball_multipart.0001.exr", {}).read({"depth", "color", "alpha"});
  ASSERT_EQ(one.window, many.window);
  ASSERT_EQ(one.views.size(), 2u);
  EXPECT_EQ(one.views[0].name, "right") << "the hero view comes first";
  for (const View& view : one.views)
    for (const auto& [name, plane] : view.planes) {
      const Plane* other = many.view(view.name).find(name);
      ASSERT_TRUE(other) << view.name << " " << name;
      for (size_t c = 0; c < plane.channels.size(); ++c)
        for (int y = 0; y < one.height(); ++y)
          ASSERT_EQ(std::memcmp(plane.channels[c].row(y), other->channels[c].row(y), size_t(one.width()) * 4), 0)
              << view.name << " " << name << " row " << y;
    }
}

TEST_F(ExrCaptures, DisplayWindowsAndWideRange) {
  const fs::path folder = root / "openexr-images";
  EXPECT_EQ(FrameFile(folder / "DisplayWindow_t01.exr", {}).window(), (Window{0, 0, 400, 300}));
  EXPECT_EQ(FrameFile(folder / "DisplayWindow_t04.exr", {}).window(), (Window{0, 0, 400, 300}));
  FrameFile inner(folder / "DisplayWindow_t08.exr", {});
  EXPECT_EQ(inner.window(), (Window{0, 0, 501, 401}));
  const Frame frame = inner.read({"color"}), full = FrameFile(folder / "DisplayWindow_t01.exr", {}).read({"color"});
  const Channel &red = frame.views[0].find("color")->channels[0], &other = full.views[0].find("color")->channels[0];
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 400; ++x) ASSERT_EQ(red.at(x + 30, y + 40), other.at(x, y));
  EXPECT_EQ(red.at(29, 40), 0);

  FrameFile wide(folder / "WideFloatRange.exr", {});
  EXPECT_TRUE(wide.planes().empty());
  ReadOptions options;
  options.channels = {{"hit", "G"}};
  const Frame range = FrameFile(folder / "WideFloatRange.exr", options).read({"hit"});
  float most = 0;
  for (int y = 0; y < range.height(); ++y)
    for (int x = 0; x < range.width(); ++x) most = std::max(most, range.views[0].find("hit")->channels[0].at(x, y));
  EXPECT_GT(most, 1e30f);
}

/// Opens a file and reads all its known planes, then each channel alone; exits with 0 if every step succeeded or ended in one
/// line, under a memory limit and a watchdog.
[[noreturn]] void try_damaged(const fs::path& path) {
  // The address sanitizer maps terabytes for itself, keeps freed memory and takes its time.
#ifdef __SANITIZE_ADDRESS__
  constexpr bool limited = false;
#else
  constexpr bool limited = true;
#endif
  ::alarm(limited ? 10 : 300);
  const rlimit memory{4000000000, 4000000000};
  if (limited) ::setrlimit(RLIMIT_AS, &memory);
  int status = 0;
  auto attempt = [&](const ReadOptions& options, std::vector<std::string> planes) {
    std::vector<std::string> channels;
    const std::string message = error_of([&] {
      FrameFile file(path, options);
      channels = file.all_channels();
      for (const PlaneSource& plane : file.planes()) planes.push_back(plane.plane);
      file.read(planes);
    });
    if (message.find('\n') != std::string::npos) status = 3;
    if (!message.empty() && message.find(path.filename().string()) == std::string::npos) status = 4;
    return channels;
  };
  for (const std::string& channel : attempt({}, {})) {
    ReadOptions options;
    options.channels = {{"mask", channel}};
    attempt(options, {"mask"});
  }
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  if (limited && used.ru_maxrss > 1024 * 1024) status = 5;
  ::_exit(status);
}

TEST_F(ExrCaptures, EveryDamagedFileIsReadOrRefused) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // OpenEXR's threads do not survive a plain fork
  int files = 0;
  for (const auto& entry : fs::directory_iterator(root / "openexr-images" / "Damaged")) {
    ++files;
    EXPECT_EXIT(try_damaged(entry.path()), testing::ExitedWithCode(0), "") << entry.path().filename();
  }
  EXPECT_GE(files, 50);
}

}  // namespace

}  // namespace gloam::exr_test
