// Colour and albedo that are no light, and lights inside surfaces: what is told, and what is not.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "cli/gloam_process.h"
#include "support/stress.h"

namespace gloam::test::light_values_test {
namespace {

double encoded(double light) { return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055; }

double decoded(double value) { return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4); }

class CliLight : public Cli {
 protected:
  /// A courtyard whose colour goes through a function.
  std::string frame_of(const std::function<float(float)>& change, bool is_half = false) {
    Frame frame = FrameFile(captured(), {}).read({"depth", "normal", "color"});
    for (Channel& channel : frame.views[0].planes.at("color").channels) {
      for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) channel.at(x, y) = change(channel.at(x, y));
      }
    }
    const std::string name = path("changed.exr");
    WriteOptions options;
    if (is_half) options.half_planes = {"color"};
    write_frame(name, frame, options);
    return name;
  }

  std::string captured() const {
    const std::string name = path("courtyard.exr");
    if (fs::exists(name)) return name;
    EXPECT_EQ(gloam({"capture", "courtyard", "-o", name, "--size", "96x54", "--planes", "normal,color,albedo"}).status,
              0);
    return name;
  }

  /// Writes these planes of a frame, one of them through a function.
  static void changed_copy(const std::string& from, const std::vector<std::string>& planes, const std::string& plane,
                           const std::function<float(float)>& change, const std::string& to) {
    Frame frame = FrameFile(from, {}).read(planes);
    for (Channel& channel : frame.views[0].planes.at(plane).channels) {
      for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) channel.at(x, y) = change(channel.at(x, y));
      }
    }
    write_frame(to, frame);
  }

  /// Lines of `info` and of `run` that speak of a plane.
  std::string notes_of_info(const std::string& frame) const { return lines(gloam({"info", frame}).out, "assumed: "); }
  std::string notes_of_run(const std::string& frame) const {
    const Result result = gloam(
        {"run", "indirect", frame, "-o", path("out.exr"), "--radius", "0.5", "--outputs", "indirect,indirect_raw"});
    EXPECT_EQ(result.status, 0) << result.err;
    return lines(result.err, "note: ");
  }

 private:
  static std::string lines(const std::string& text, const std::string& start) {
    std::istringstream stream(text);
    std::string found;
    for (std::string line; std::getline(stream, line);)
      if (line.starts_with(start + "color") || line.starts_with(start + "albedo"))
        found += line.substr(start.size()) + "\n";
    return found;
  }
};

TEST_F(CliLight, SceneLinearColourIsNotDoubted) {
  for (const auto& change : std::vector<std::function<float(float)>>{
           [](float v) { return v; }, [](float v) { return std::min(v, 1.0f); },  // clipped, and linear
           [](float) { return 0.5f; },                                            // of one value
           [](float v) { return v > 0.2f ? 200 / 255.0f : 0.0f; },                // of two, both steps of 8 bits
       }) {
    const std::string frame = frame_of(change);
    EXPECT_EQ(notes_of_run(frame), "");
    EXPECT_EQ(notes_of_info(frame), "");
  }
}

TEST_F(CliLight, PicturesOfADisplayAreTold) {
  const auto picture = [](float v) { return float(std::round(255 * encoded(std::min(v, 1.0f))) / 255); };
  const auto made_linear = [&](float v) { return float(decoded(double(picture(v)))); };
  for (const bool is_half : {false, true}) {
    std::string frame = frame_of(picture, is_half);
    EXPECT_NE(notes_of_run(frame).find("color is unfit: it holds the steps of an 8-bit picture"), std::string::npos)
        << is_half;
    EXPECT_EQ(notes_of_info(frame), notes_of_run(frame));
    frame = frame_of(made_linear, is_half);
    EXPECT_NE(notes_of_run(frame).find("an 8-bit sRGB picture made linear"), std::string::npos) << is_half;
    EXPECT_EQ(notes_of_info(frame), notes_of_run(frame));
  }
  // Light above 1: no picture of a display.
  int lamps = 3;
  EXPECT_EQ(notes_of_run(frame_of([&](float v) { return lamps-- > 0 ? 4.0f : picture(v); })), "");
}

TEST_F(CliLight, ValuesThatAreNoLightAreCountedAndCountAsBlack) {
  int at = 0;
  const std::string odd = frame_of([&](float v) {
    const int i = at++;
    return i < 2 ? INFINITY : i == 2 ? NAN : i < 8 ? -3.0f : v;
  });
  const std::string notes = notes_of_run(odd);
  EXPECT_NE(notes.find("color: 3 pixels of 5184 are infinite or NaN and taken for black"), std::string::npos) << notes;
  EXPECT_NE(notes.find("color: 5 pixels of 5184 are negative"), std::string::npos) << notes;
  EXPECT_EQ(notes_of_info(odd), notes);
  const auto computed = [&] { return FrameFile(path("out.exr"), {}).read({"indirect_raw"}); };
  const Frame first = computed();
  at = 0;
  notes_of_run(frame_of([&](float v) { return at++ < 8 ? 0.0f : v; }));
  const Frame black = computed();
  for (size_t c = 0; c < 3; ++c) {
    for (int y = 0; y < black.height(); ++y)
      for (int x = 0; x < black.width(); ++x)
        ASSERT_EQ(first.views[0].find("indirect_raw")->channels[c].at(x, y),
                  black.views[0].find("indirect_raw")->channels[c].at(x, y));
  }
}

TEST_F(CliLight, AlbedoAboveOneIsTold) {
  Frame frame = FrameFile(captured(), {}).read({"depth", "normal", "albedo"});
  EXPECT_EQ(notes_of_info(captured()), "");
  frame.views[0].planes.at("albedo").channels[1].at(3, 4) = 1.5f;
  frame.views[0].planes.at("albedo").channels[0].at(7, 4) = -0.5f;
  write_frame(path("bright.exr"), frame);
  const Result result = gloam({"run", "multi-bounce", path("bright.exr"), "-o", path("out.exr"), "--radius", "0.5"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("albedo: 1 pixel of 4946 is above 1"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("albedo: 1 pixel of 4946 is negative or NaN"), std::string::npos) << result.err;
  EXPECT_NE(notes_of_info(path("bright.exr")).find("albedo: 1 pixel of 4946 is above 1"), std::string::npos);
}

/// Renderers write the sky into all their planes.
TEST_F(CliLight, WhatTheSkyHoldsSaysNothingOfAPlane) {
  Frame frame = FrameFile(captured(), {}).read({"depth", "normal", "color", "albedo"});
  View& view = frame.views[0];
  int sky = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      if (y < 40) view.planes.at("depth").channels[0].at(x, y) = INFINITY;
      if (view.planes.at("depth").channels[0].at(x, y) < INFINITY) continue;
      ++sky;
      for (Channel& channel : view.planes.at("albedo").channels) channel.at(x, y) = 2;
      for (Channel& channel : view.planes.at("color").channels) channel.at(x, y) = INFINITY;
    }
  }
  ASSERT_GT(2 * sky, frame.width() * frame.height());
  write_frame(path("sky.exr"), frame);
  const std::string notes = notes_of_info(path("sky.exr"));
  EXPECT_EQ(notes.find("unfit"), std::string::npos) << notes;
  EXPECT_EQ(notes.find("albedo"), std::string::npos) << notes;
  EXPECT_NE(notes.find("are infinite or NaN"), std::string::npos) << notes;
}

/// A file of two parts: Z, and three channels that are 1.
void write_parts(const std::string& path, const std::string& part, const std::vector<std::string>& channels) {
  constexpr int width = 32, height = 18;
  const std::vector<float> ones(width * height, 1.0f);
  std::vector<Imf::Header> headers(2, Imf::Header(width, height));
  headers[0].channels().insert("Z", Imf::Channel(Imf::FLOAT));
  for (const std::string& name : channels) headers[1].channels().insert(name, Imf::Channel(Imf::FLOAT));
  const std::string names[] = {"depth", part};
  for (size_t i : {0, 1}) {
    headers[i].setName(names[i]);
    headers[i].setType(Imf::SCANLINEIMAGE);
  }
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), 2);
  for (int i : {0, 1}) {
    Imf::FrameBuffer buffer;
    const Imf::ChannelList& list = headers[size_t(i)].channels();
    for (auto c = list.begin(); c != list.end(); ++c)
      buffer.insert(c.name(), Imf::Slice::Make(Imf::FLOAT, ones.data(), headers[0].dataWindow(), 4, 4 * width));
    Imf::OutputPart output(file, i);
    output.setFrameBuffer(buffer);
    output.writePixels(height);
  }
}

/// A layer's name may be the channel's or its part's, in any letters.
TEST_F(CliLight, AReflectanceOfOneIsToldHoweverItIsCalled) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> spellings = {
      {"light", {"ViewLayer.GlossCol.R", "ViewLayer.GlossCol.G", "ViewLayer.GlossCol.B"}},
      {"light", {"Gloss_Col.R", "Gloss_Col.G", "Gloss_Col.B"}},
      {"GlossCol", {"R", "G", "B"}}};
  for (const auto& [part, channels] : spellings) {
    write_parts(path("gloss.exr"), part, channels);
    const Result result = gloam({"info", path("gloss.exr"), "--fov", "60"});
    EXPECT_NE(result.out.find("reflectance is unfit: GlossCol is 1 on 100 % of the surfaces"), std::string::npos)
        << part << " " << channels.front() << "\n"
        << result.out;
  }
}

TEST_F(CliLight, AutoDoesWithoutWhatANoteCallsUnfit) {
  const std::string whole = path("whole.exr"), spoilt = path("spoilt.exr"), out = path("out.exr");
  const std::vector<std::string> planes = {"depth",  "normal",   "color",     "ambient",
                                           "albedo", "metallic", "roughness", "reflectance"};
  ASSERT_EQ(gloam({"capture", "lounge", "-o", whole, "--size", "96x54", "--planes",
                   "normal,color,ambient,albedo,metallic,roughness,reflectance"})
                .status,
            0);
  const auto spoil = [&](const std::string& plane, const std::function<float(float)>& change) {
    changed_copy(whole, planes, plane, change, spoilt);
  };
  /// Why each effect is wanted or not, by its name.
  const auto reasons = [&](const Arguments& more) {
    Arguments arguments = {"auto", spoilt, "-o", out, "--radius", "0.5", "--preset", "low", "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    std::map<std::string, std::string> found;
    const nlohmann::json document = result.json();
    for (const nlohmann::json& effect : document["effects"])
      found[effect["name"]] = (effect["wanted"].get<bool>() ? "wanted: " : "") + effect["why"].get<std::string>();
    return found;
  };
  const std::string light = "light of near surfaces", mirrors = "reflections";
  struct Spoilt {
    std::string plane;
    std::function<float(float)> change;
    std::vector<std::string> lost;
  };
  const std::vector<Spoilt> cases = {
      {"color", [](float v) { return float(std::round(255 * encoded(std::min(v, 1.0f))) / 255); }, {light, mirrors}},
      {"roughness", [](float) { return 0.0f; }, {mirrors}},
      {"albedo", [](float v) { return 10 * v; }, {light}}};
  for (const Spoilt& each : cases) {
    spoil(each.plane, each.change);
    std::map<std::string, std::string> found = reasons({});
    EXPECT_NE(found["ambient occlusion"].find("wanted: "), std::string::npos) << found["ambient occlusion"];
    for (const std::string& effect : {light, mirrors}) {
      const bool is_lost = std::count(each.lost.begin(), each.lost.end(), effect) > 0;
      EXPECT_EQ(found[effect] == "needs '" + each.plane + "', which is unfit", is_lost)
          << each.plane << ", " << effect << ": " << found[effect];
    }
    const std::vector<std::string> written = FrameFile(out, {}).common_planes();
    for (const std::string& effect : each.lost)
      EXPECT_EQ(std::count(written.begin(), written.end(), effect == light ? "indirect" : "reflection"), 0) << effect;
  }
  // A user who names the channels means them.
  const std::string chosen = reasons({"--plane", "albedo=albedo.R,albedo.G,albedo.B"})[light];
  EXPECT_EQ(chosen.find("unfit"), std::string::npos) << chosen;
  // A picture begins with colour, and a budget is weighed by it.
  spoil("color", cases[0].change);
  for (const Arguments& flags : {Arguments{"--composite", path("picture.exr")}, Arguments{"--budget", "100ms"}}) {
    Arguments arguments = {"auto", spoilt, "-o", path("other.exr")};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const Result refused = gloam(arguments);
    EXPECT_EQ(refused.status, 1) << refused.out;
    EXPECT_NE(refused.err.find("color is unfit: it holds the steps of an 8-bit picture"), std::string::npos);
    EXPECT_NE(refused.err.find("--plane color=CHANNELS has it taken"), std::string::npos) << refused.err;
    EXPECT_FALSE(fs::exists(path("other.exr")));
  }
}

/// Colour that holds all light calls for nothing: frames with depth are written all the same, and others told.
TEST_F(CliLight, AutoOnColourThatHoldsAllLight) {
  const std::string all = "ambient,shadows,ao,indirect,reflection", whole = captured();
  write_frame(path("bare.exr"), FrameFile(whole, {}).read({"color"}));
  for (const char* number : {"1", "2"}) {
    fs::copy_file(whole, path(std::string("shot.") + number + ".exr"));
    fs::copy_file(path("bare.exr"), path(std::string("bare.") + number + ".exr"));
  }
  const auto run = [&](const std::string& frame, const Arguments& outputs) {
    Arguments arguments = {"auto", path(frame), "--color-holds", all, "--radius", "0.5"};
    arguments.insert(arguments.end(), outputs.begin(), outputs.end());
    return gloam(arguments);
  };
  EXPECT_EQ(run("courtyard.exr", {"-o", path("out.exr")}).status, 0);
  const Result shot = run("shot.#.exr", {"-o", path("out.#.exr")});
  EXPECT_EQ(shot.status, 0) << shot.err;
  EXPECT_TRUE(fs::exists(path("out.2.exr")));
  for (const auto& [frame, out] : {std::pair("bare.exr", "none.exr"), std::pair("bare.#.exr", "none.#.exr")}) {
    const Result refused = run(frame, {"-o", path(out), "--composite", path(std::string("picture-") + out)});
    EXPECT_EQ(refused.status, 1);
    EXPECT_EQ(refused.lines_of_error(), 1) << refused.err;
    EXPECT_NE(refused.err.find("has no depth, so that no effect can be computed"), std::string::npos) << refused.err;
  }
  for (const auto& entry : fs::directory_iterator(path(".")))
    EXPECT_EQ(entry.path().filename().string().find("none"), std::string::npos) << entry.path();
  fs::copy_file(path("bare.exr"), path("mixed.2.exr"));
  fs::copy_file(whole, path("mixed.1.exr"));
  const Result mixed = run("mixed.#.exr", {"-o", path("mixed-out.#.exr")});
  EXPECT_EQ(mixed.status, 1);
  EXPECT_NE(mixed.err.find("mixed.2.exr: has no depth"), std::string::npos) << mixed.err;
  const Result picture = run("bare.exr", {"--composite", path("picture.exr")});
  EXPECT_EQ(picture.status, 0) << picture.err;
}

/// What is unfit in the first frame of a shot is left out of all, and what is sound there is taken in all: nothing comes and goes.
TEST_F(CliLight, AutoDoesWithoutItInAllFramesOfAShot) {
  const std::string whole = path("whole.exr"), out = path("out.#.exr");
  ASSERT_EQ(gloam({"capture", "lounge", "-o", whole, "--size", "96x54", "--planes", "normal,color,albedo"}).status, 0);
  const Arguments command = {"auto", path("shot.#.exr"), "-o", out, "--radius", "0.5", "--preset", "low"};
  std::string told;
  const auto lit_frames = [&] {
    const Result result = gloam(command);
    EXPECT_EQ(result.status, 0) << result.err;
    told = result.err;
    int lit = 0;
    for (const char* frame : {"out.1.exr", "out.2.exr"}) {
      const std::vector<std::string> written = FrameFile(path(frame), {}).common_planes();
      EXPECT_EQ(std::count(written.begin(), written.end(), "ao"), 1) << frame;
      lit += int(std::count(written.begin(), written.end(), "indirect"));
    }
    return lit;
  };
  const auto write_shot = [&](float first, float second) {
    const std::vector<std::string> planes = {"depth", "normal", "color", "albedo"};
    for (const auto& [name, factor] : {std::pair("shot.1.exr", first), std::pair("shot.2.exr", second)})
      changed_copy(
          whole, planes, "albedo", [factor = factor](float v) { return factor * v; }, path(name));
  };
  const auto is_told = [&](const std::string& part) { return told.find(part) != std::string::npos; };
  write_shot(1, 1);
  EXPECT_EQ(lit_frames(), 2);
  EXPECT_FALSE(is_told("is unfit")) << told;
  write_shot(10, 1);
  EXPECT_EQ(lit_frames(), 0);
  EXPECT_TRUE(is_told("note: albedo is unfit: ")) << told;
  EXPECT_TRUE(
      is_told("; gloam auto does without in all frames, as frame 1 decides (--plane albedo=CHANNELS has it taken)\n"))
      << told;
  EXPECT_TRUE(is_told("note: light of near surfaces: in no frame; needs 'albedo', which is unfit\n")) << told;
  write_shot(1, 10);
  EXPECT_EQ(lit_frames(), 2);
  EXPECT_TRUE(is_told("note: albedo is unfit: ")) << told;
  EXPECT_TRUE(
      is_told("; it is taken all the same, as frame 1 decides for all frames (--plane albedo=none leaves it out)\n"))
      << told;
  EXPECT_FALSE(is_told("auto does without")) << told;
  EXPECT_FALSE(is_told("which is unfit")) << told;
}

TEST_F(CliLight, LightsInsideSurfacesAreTold) {
  Frame frame = shoot(perspective(97, 65), room());
  write_frame(path("room.exr"), frame);
  const int x = 48, y = 32;
  const double depth = double(frame.views[0].find("depth")->channels[0].at(x, y));
  const Camera camera = *frame.views[0].camera;
  const auto notes_for = [&](double light_depth) {
    const double right = (x + 0.5 - camera.cx) / camera.fx * light_depth,
                 down = (y + 0.5 - camera.cy) / camera.fy * light_depth;
    return gloam({"run", "contact-shadow", path("room.exr"), "-o", path("contact.exr"), "--length", "0.5", "--light",
                  "point", "--light_in", "view", fmt::format("--light_x={}", right), fmt::format("--light_y={}", -down),
                  fmt::format("--light_z={}", -light_depth)})
        .err;
  };
  EXPECT_NE(notes_for(depth + 0.1).find("0.1 scene units behind the surface that the frame shows there"),
            std::string::npos)
      << notes_for(depth + 0.1);
  EXPECT_EQ(notes_for(depth - 0.1).find("behind the surface"), std::string::npos);
  // Behind the back of a surface .4 lengths thick: hidden, but not inside.
  EXPECT_EQ(notes_for(depth + 0.3).find("behind the surface"), std::string::npos);
}

/// Those that a composite keeps are told by its note, where the technique reads no colour.
TEST_F(CliLight, ACompositeTellsOfColourThatIsNoLight) {
  int pixel = 0;
  const std::string frame = frame_of([&](float v) {
    const int i = pixel++ % 900;
    return i == 7 ? std::numeric_limits<float>::infinity() : i == 9 ? std::nanf("") : v;
  });
  const Result run =
      gloam({"run", "gtao", frame, "-o", path("ao.exr"), "--composite", path("lit.exr"), "--radius", "0.5"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("infinite or NaN, and the composite keeps them"), std::string::npos) << run.err;
  const Result automatic = gloam({"auto", frame, "-o", path("all.exr"), "--composite", path("whole.exr")});
  ASSERT_EQ(automatic.status, 0) << automatic.err;
  EXPECT_NE(automatic.err.find("infinite or NaN, and the composite keeps them"), std::string::npos) << automatic.err;
}

}  // namespace
}  // namespace gloam::test::light_values_test
