// Cameras, views and pixels of foreign files: what is reported, what flags override, and limits on names.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include <cmath>
#include <functional>

#include "cli/gloam_process.h"

namespace gloam::test::cameras_test {
namespace {

using Json = nlohmann::json;

class ForeignCameras : public Cli {
 protected:
  std::string file(const std::string& name) const { return path(name).string(); }

  /// The same pixels under another header.
  void write_with(const std::string& from, const std::string& to,
                  const std::function<void(Imf::Header&)>& change) const {
    Imf::InputFile in(from.c_str());
    Imf::Header header = in.header();
    const Imath::Box2i window = header.dataWindow();
    const size_t width = size_t(window.max.x + 1), height = size_t(window.max.y + 1);
    ASSERT_EQ(window.min, Imath::V2i(0, 0));
    std::map<std::string, std::vector<float>> channels;
    Imf::FrameBuffer buffer;
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
      std::vector<float>& values = channels[it.name()];
      values.resize(width * height);
      buffer.insert(it.name(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 4 * width));
    }
    in.setFrameBuffer(buffer);
    in.readPixels(0, window.max.y);
    change(header);
    Imf::OutputFile out(to.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(int(height));
  }

  static Imath::M44f& matrix(Imf::Header& header, const char* name) {
    return header.typedAttribute<Imf::M44fAttribute>(name).value();
  }

  /// One part per name, with the given channels, all of one value that differs between parts.
  void write_parts(const std::string& name, const std::vector<std::string>& parts,
                   const std::vector<std::string>& channels) const {
    const int width = 32, height = 18;
    std::vector<Imf::Header> headers;
    for (const std::string& part : parts) {
      Imf::Header& header = headers.emplace_back(width, height);
      header.setName(part);
      header.setType(Imf::SCANLINEIMAGE);
      for (const std::string& channel : channels) header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
    }
    Imf::MultiPartOutputFile out(file(name).c_str(), headers.data(), int(headers.size()));
    for (size_t i = 0; i < parts.size(); ++i) {
      const std::vector<float> pixels(size_t(width * height), 1 + float(i));
      Imf::FrameBuffer buffer;
      for (const std::string& channel : channels)
        buffer.insert(channel,
                      Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(const_cast<float*>(pixels.data())), 4, 4 * width));
      Imf::OutputPart part(out, int(i));
      part.setFrameBuffer(buffer);
      part.writePixels(height);
    }
  }

  void expect_same_ao(const std::string& frame, const std::string& as) const {
    for (const auto& [in, out] : {std::pair(frame, "a.exr"), {as, "b.exr"}})
      ASSERT_EQ(gloam({"run", "gtao", in, "-o", path(out), "--radius", "0.5", "--plane", "normal=none"}).status, 0);
    const Json figures = gloam({"compare", path("a.exr"), path("b.exr"), "--json", "-"}).json();
    EXPECT_LT(figures.at("max"), 1e-3);
    EXPECT_GT(figures.at("pixels"), 0);
  }
};

TEST_F(ForeignCameras, MatricesAsArnoldWritesThemGiveTheSameImage) {
  write_with(loggia, file("arnold.exr"), [](Imf::Header& header) {
    const Imath::M44f symmetric(2, 0, 0, 0, 0, -2, 0, 0, 0, 0, 1, 0, -1, 1, 0, 1),
        back(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1);
    matrix(header, "worldToNDC") = matrix(header, "worldToNDC") * symmetric;
    matrix(header, "worldToCamera") = matrix(header, "worldToCamera") * back;
    header.erase("gloamCamera");
  });
  const Result info = gloam({"info", file("arnold.exr")});
  EXPECT_NE(info.out.find("worldToNDC as -1 to 1, y up, and worldToCamera as looking along -z"), std::string::npos)
      << info.out;
  expect_same_ao(loggia, file("arnold.exr"));
}

TEST_F(ForeignCameras, ACameraThatCannotBeUsedIsANoteForThoseWhoLookAndAFlagOverrulesIt) {
  write_with(loggia, file("mirrored.exr"), [](Imf::Header& header) {
    matrix(header, "worldToNDC") =
        matrix(header, "worldToNDC") * Imath::M44f(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1);
  });
  for (const Arguments& command : {Arguments{"info", file("mirrored.exr")}, {"plan", "gtao", file("mirrored.exr")}}) {
    const Result result = gloam(command);
    EXPECT_EQ(result.status, 0) << result.err;
    const std::string said = result.out + result.err;
    EXPECT_NE(said.find("worldToNDC: mirrors the image"), std::string::npos) << said;
    EXPECT_NE(said.find("--fov or --camera gives another"), std::string::npos) << said;
  }
  const Result refused = gloam({"run", "gtao", file("mirrored.exr"), "-o", file("ao.exr")});
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.lines_of_error(), 1) << refused.err;
  EXPECT_NE(refused.err.find("--fov"), std::string::npos) << refused.err;
  std::ofstream(path("good.json")) << R"({"width": 480, "height": 270, "fx": 376.72, "fy": 376.72, "cx": 240, "cy": 135,
    "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]})";
  for (const Arguments& flags : {Arguments{"--fov", "65"}, {"--camera", file("good.json")}}) {
    for (Arguments command : {Arguments{"run", "gtao", file("mirrored.exr"), "-o", file("ao.exr")},
                              {"auto", file("mirrored.exr"), "-o", file("ao.exr")},
                              {"info", file("mirrored.exr")},
                              {"plan", "gtao", file("mirrored.exr")}}) {
      command.insert(command.end(), flags.begin(), flags.end());
      const Result result = gloam(command);
      EXPECT_EQ(result.status, 0) << command[0] << flags[0] << result.err;
    }
  }
}

TEST_F(ForeignCameras, AJsonThatDoesNotFitIsANoteForThoseWhoLook) {
  write_frame(path("frame.exr"), small_frame());
  write_with(file("frame.exr"), file("bare.exr"), [](Imf::Header& header) {
    for (const char* name : {"worldToNDC", "worldToCamera"}) header.erase(name);
  });
  std::ofstream(path("bare.camera.json")) << R"({"width": 7, "height": 99, "fx": 5, "fy": 5, "cx": 3, "cy": 4,
    "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]})";
  for (const Arguments& command : {Arguments{"info", file("bare.exr")}, {"plan", "normals", file("bare.exr")}}) {
    for (const bool by_flag : {false, true}) {
      Arguments arguments = command;
      if (by_flag) arguments.insert(arguments.end(), {"--camera", file("bare.camera.json")});
      const Result result = gloam(arguments);
      EXPECT_EQ(result.status, 0) << result.err;
      EXPECT_NE((result.out + result.err).find("bare.camera.json"), std::string::npos) << result.out << result.err;
    }
  }
  EXPECT_EQ(gloam({"run", "normals", file("bare.exr"), "-o", file("n.exr")}).status, 1);
  EXPECT_EQ(gloam({"run", "normals", file("bare.exr"), "-o", file("n.exr"), "--fov", "50"}).status, 0);
}

TEST_F(ForeignCameras, PixelsThatAreNotSquareAreHonouredAndKept) {
  write_frame(path("frame.exr"), small_frame());
  write_with(file("frame.exr"), file("wide.exr"), [](Imf::Header& header) {
    for (const char* name : {"worldToNDC", "worldToCamera"}) header.erase(name);
    header.pixelAspectRatio() = 2;
  });
  for (const Arguments& flags : {Arguments{}, {"--fov", "40"}}) {
    Arguments arguments = {"info", file("wide.exr"), "--json", "-"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const Json camera = gloam(arguments).json().at("camera");
    if (flags.empty() && camera.is_null()) continue;  // assumed: info reports it only if it is used
    EXPECT_NEAR(double(camera.at("fy")), 2 * double(camera.at("fx")), 1e-6);
  }
  for (const Arguments& command :
       {Arguments{"run", "positions", file("wide.exr"), "-o", file("out.exr"), "--fov", "40"},
        {"run", "normals", file("wide.exr"), "-o", file("out.exr")},
        {"auto", file("wide.exr"), "-o", file("out.exr")}}) {
    ASSERT_EQ(gloam(command).status, 0);
    EXPECT_EQ(Imf::InputFile(file("out.exr").c_str()).header().pixelAspectRatio(), 2) << command[0];
    const Camera camera = *FrameFile(path("out.exr"), {}).camera("");
    EXPECT_NEAR(camera.fy, 2 * camera.fx, 1e-4 * camera.fy) << command[0] << " " << command[1];
  }
}

TEST_F(ForeignCameras, EyesAreToldByTheNamesOfPartsThatSayNoView) {
  for (const auto& [left, right] :
       {std::pair("left", "right"), {"beauty.left", "beauty.right"}, {"rgba_L", "rgba_R"}}) {
    write_parts("parts.exr", {left, right}, {"Z", "R", "G", "B"});
    const Json info = gloam({"info", file("parts.exr"), "--json", "-"}).json();
    EXPECT_EQ(info.at("views"), Json({"left", "right"})) << left;
    const Frame frame = FrameFile(path("parts.exr"), {}).read({"depth"});
    EXPECT_EQ(frame.view("left").find("depth")->channels[0].at(3, 3), 1) << left;
    EXPECT_EQ(frame.view("right").find("depth")->channels[0].at(3, 3), 2) << left;
    EXPECT_EQ(gloam({"run", "normals", file("parts.exr"), "--view", "right", "-o", file("n.exr")}).status, 0);
  }
}

/// Every "--plane PLANE=CHANNELS chooses" that info prints can be typed.
TEST_F(ForeignCameras, TheAdviceOfInfoWorksAsItIsPrinted) {
  for (const std::vector<std::string>& channels :
       {std::vector<std::string>{"Z", "R", "G", "B"},
        {"ViewLayer.Depth.Z", "ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B"}}) {
    write_parts("parts.exr", {"first pass", "other pass"}, channels);
    const std::string said = gloam({"info", file("parts.exr")}).out;
    int advised = 0;
    for (size_t at = 0; (at = said.find("(--plane ", at)) != std::string::npos; ++at) {
      const size_t from = at + 9, to = said.find(" chooses)", at);
      ASSERT_NE(to, std::string::npos) << said;
      const std::string choice = said.substr(from, to - from), plane = choice.substr(0, choice.find('='));
      FrameFile chosen(path("parts.exr"), ReadOptions{.channels = {{plane, choice.substr(choice.find('=') + 1)}}});
      EXPECT_EQ(chosen.read({plane}).views[0].find(plane)->channels[0].at(3, 3), 2) << choice;
      EXPECT_EQ(gloam({"info", file("parts.exr"), "--plane", choice}).status, 0) << choice;
      ++advised;
    }
    EXPECT_GE(advised, 2) << said;
  }
}

TEST_F(ForeignCameras, NamesOfViewsReachNeitherOtherFoldersNorTheTerminal) {
  const std::string evil = "p./../../../x", escape = "\x1b[31mred";
  Frame frame = small_frame();
  View second;
  second.name = escape;
  second.camera = frame.views[0].camera;
  for (const auto& [name, plane] : frame.views[0].planes) {
    Plane& copy = second.planes[name];
    copy.name = name;
    for (const Channel& channel : plane.channels) {
      copy.channels.emplace_back(channel.layout(), 0.5f);
    }
  }
  frame.views[0].name = evil;
  frame.views.push_back(std::move(second));
  write_frame(path("views.exr"), frame);
  for (const Arguments& command :
       {Arguments{"info", file("views.exr")},
        {"info", file("views.exr"), "--what", "depth", "--sheet", file("v.png")},
        {"run", "gtao", file("views.exr"), "-o", file("ao.exr"), "--picture", file("ao.png")},
        {"auto", file("views.exr"), "-o", file("auto.exr"), "--explain", file("e.png")},
        {"compare", file("ao.exr"), file("ao.exr"), "-o", file("d.png")}}) {
    const Result result = gloam(command);
    EXPECT_EQ((result.out + result.err).find('\x1b'), std::string::npos) << command[0];
  }
  for (const std::string& name : files()) EXPECT_EQ(name.find('\x1b'), std::string::npos);
  EXPECT_TRUE(fs::exists(path("ao.p.%2F..%2F..%2F..%2Fx.png")));
  EXPECT_TRUE(fs::exists(path("ao.%1B%5B31mred.png")));
}

TEST_F(ForeignCameras, AViewNamedWithADotIsReadBack) {
  Frame frame = small_frame();
  frame.views[0].name = "left.main";
  View second;
  second.name = "main";
  second.camera = frame.views[0].camera;
  second.planes["depth"].name = "depth";
  second.planes["depth"].channels.emplace_back(frame.views[0].find("depth")->channels[0].layout(), 2.0f);
  frame.views[0].planes.erase("color");
  frame.views.push_back(std::move(second));
  write_frame(path("views.exr"), frame);
  ASSERT_EQ(gloam({"run", "normals", file("views.exr"), "-o", file("n.exr")}).status, 0);
  for (const char* name : {"views.exr", "n.exr"}) {
    const FrameFile read(path(name), {});
    EXPECT_EQ(read.views(), (std::vector<std::string>{"left.main", "main"})) << name;
    EXPECT_EQ(read.common_planes().empty(), false) << name;
  }
  const Frame again = FrameFile(path("views.exr"), {}).read({"depth"});
  EXPECT_EQ(again.view("left.main").find("depth")->channels[0].at(1, 1), 4.0f);
  EXPECT_EQ(again.view("main").find("depth")->channels[0].at(1, 1), 2.0f);
}

TEST_F(ForeignCameras, ExtremeCamerasAndBackgroundsGiveFiniteValues) {
  ASSERT_EQ(gloam({"capture", "gallery", "--size", "160x90", "--planes", "depth", "-o", path("frame.exr")}).status, 0);
  std::ofstream(path("wide.json")) << R"({"width": 160, "height": 90, "fx": 1e-6, "fy": 1e-6, "cx": 80, "cy": 45,
    "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]})";
  ASSERT_EQ(gloam({"run", "normals", file("frame.exr"), "--camera", file("wide.json"), "-o", file("n.exr")}).status, 0);
  Frame normals = FrameFile(path("n.exr"), {}).read({"normal"});
  for (const Channel& channel : normals.views[0].find("normal")->channels)
    for (int y = 0; y < 90; ++y)
      for (int x = 0; x < 160; ++x) ASSERT_TRUE(std::isfinite(channel.at(x, y))) << x << " " << y;

  Frame far = small_frame(32, 24, {"depth"});
  far.views[0].planes["depth"].channels[0].at(5, 5) = 3.4e38f;
  write_frame(path("far.exr"), far);
  ASSERT_EQ(gloam({"run", "positions", file("far.exr"), "--background", "3e38", "-o", file("p.exr")}).status, 0);
  const Frame positions = FrameFile(path("p.exr"), ReadOptions{.as_stored = true}).read({"position"});
  for (const Channel& channel : positions.views[0].find("position")->channels)
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 32; ++x) ASSERT_TRUE(std::isfinite(channel.at(x, y))) << x << " " << y;
}

TEST_F(ForeignCameras, TheFieldOfViewTellsItsRange) {
  EXPECT_NE(gloam({"run", "--help"}).out.find("horizontal field of view, 1 to 179 degrees"), std::string::npos);
}

}  // namespace
}  // namespace gloam::test::cameras_test
