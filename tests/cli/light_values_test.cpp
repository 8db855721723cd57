// Colour and albedo that are no light, and lights inside surfaces: what is told, and what is not.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "cli/gloam_process.h"
#include "support/stress.h"

namespace gloam::test {
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
    const Result result = gloam({"run", "indirect", frame, "-o", path("out.exr"), "--radius", "0.5"});
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
  EXPECT_NE(result.err.find("albedo: 1 pixel of 5184 is above 1"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("albedo: 1 pixel of 5184 is negative or NaN"), std::string::npos) << result.err;
  EXPECT_NE(notes_of_info(path("bright.exr")).find("albedo: 1 pixel of 5184 is above 1"), std::string::npos);
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

/// What is unfit in the first frame of a shot is left out of all: nothing comes and goes.
TEST_F(CliLight, AutoDoesWithoutItInAllFramesOfAShot) {
  const std::string whole = path("shot.2.exr"), out = path("out.#.exr");
  ASSERT_EQ(gloam({"capture", "lounge", "-o", whole, "--size", "96x54", "--planes", "normal,color,albedo"}).status, 0);
  const Arguments command = {"auto", path("shot.#.exr"), "-o", out, "--radius", "0.5", "--preset", "low"};
  const auto lit_frames = [&] {
    const Result result = gloam(command);
    EXPECT_EQ(result.status, 0) << result.err;
    int lit = 0;
    for (const char* frame : {"out.1.exr", "out.2.exr"}) {
      const std::vector<std::string> written = FrameFile(path(frame), {}).common_planes();
      EXPECT_EQ(std::count(written.begin(), written.end(), "ao"), 1) << frame;
      lit += int(std::count(written.begin(), written.end(), "indirect"));
    }
    return lit;
  };
  const std::vector<std::string> planes = {"depth", "normal", "color", "albedo"};
  changed_copy(
      whole, planes, "albedo", [](float v) { return v; }, path("shot.1.exr"));
  EXPECT_EQ(lit_frames(), 2);
  changed_copy(
      whole, planes, "albedo", [](float v) { return 10 * v; }, path("shot.1.exr"));
  EXPECT_EQ(lit_frames(), 0);
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
}  // namespace gloam::test
