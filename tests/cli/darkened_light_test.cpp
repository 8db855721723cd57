// What ambient occlusion darkens of a colour, and what it leaves: emission, volumes, transmission, what lies behind; Cryptomattes.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <bit>
#include <cmath>
#include <functional>

#include "cli/shot_fixture.h"

namespace gloam::test::darkened_light_test {
namespace {

constexpr int light_width = 64, light_height = 48;

using Pixels = std::function<float(int x, int y)>;
using Layers = std::map<std::string, std::array<Pixels, 3>>;  // with R, G and B

Pixels even(float value) {
  return [value](int, int) { return value; };
}

std::array<Pixels, 3> even(float r, float g, float b) { return {even(r), even(g), even(b)}; }

bool is_lamp(int x, int y) { return x >= 20 && x < 30 && y >= 16 && y < 30; }

/// The value where the lamp is, and elsewhere another.
std::array<Pixels, 3> lamp(float there, float elsewhere) {
  std::array<Pixels, 3> all;
  for (size_t i = 0; i < 3; ++i)
    all[i] = [=](int x, int y) { return is_lamp(x, y) ? there + 0.5f * float(i) : elsewhere; };
  return all;
}

class DarkenedLightFile : public ShotTest {
 protected:
  /// A file with the depths of a step, and these layers; "" is R, G, B.
  void write_layers(const std::string& name, const Layers& layers, const std::map<std::string, Pixels>& more = {},
                    const std::map<std::string, std::string>& texts = {}, int number = 0) const {
    std::map<std::string, Pixels> channels = more;
    for (const auto& [layer, components] : layers)
      for (size_t i = 0; i < 3; ++i)
        channels[(layer.empty() ? "" : layer + ".") + std::string(1, "RGB"[i])] = components[i];
    const Frame step = frame_of(number);
    const Channel& depth = step.views[0].planes.at("depth").channels[0];
    channels["ViewLayer.Depth.Z"] = [&](int x, int y) { return depth.at(x, y); };
    Imf::Header header(light_width, light_height);
    for (const auto& [attribute, text] : texts) header.insert(attribute, Imf::StringAttribute(text));
    std::map<std::string, std::vector<float>> memory;
    Imf::FrameBuffer buffer;
    for (const auto& [channel, value] : channels) {
      std::vector<float>& values = memory[channel];
      for (int y = 0; y < light_height; ++y)
        for (int x = 0; x < light_width; ++x) values.push_back(value(x, y));
      header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
      buffer.insert(channel, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float),
                                        sizeof(float) * light_width));
    }
    Imf::OutputFile output(file(name).c_str(), header);
    output.setFrameBuffer(buffer);
    output.writePixels(light_height);
  }

  Result composite(const std::string& frame, const Arguments& more = {}) const {
    Arguments all = {"run", "hbao+", file(frame),    "--radius", "0.5",         "--fov",
                     "60",  "-o",    file("ao.exr"), "--float",  "--composite", file("c.exr")};
    all.insert(all.end(), more.begin(), more.end());
    return gloam(all);
  }
  Frame stored(const std::string& name, const std::vector<std::string>& planes) const {
    return FrameFile(path(name), {.as_stored = true}).read(planes);
  }

  /// Compares the composite with expected(component, x, y, colour, ao), and counts where the plain product would differ.
  void expect_pixels(const std::string& frame, const std::function<double(size_t, int, int, double, double)>& expected,
                     const std::string& made = "c.exr", const std::string& occlusion = "ao.exr") const {
    const Frame before = stored(frame, {"color"}), after = stored(made, {"color"}), ao = stored(occlusion, {"ao"});
    long long occluded = 0;
    for (size_t i = 0; i < 3; ++i)
      for (int y = 0; y < light_height; ++y)
        for (int x = 0; x < light_width; ++x) {
          const double colour = before.views[0].find("color")->channels[i].at(x, y);
          const double open = ao.views[0].find("ao")->channels[0].at(x, y);
          const double wanted = expected(i, x, y, colour, open);
          ASSERT_NEAR(after.views[0].find("color")->channels[i].at(x, y), wanted, 2e-6 * std::max(1.0, colour))
              << x << " " << y << " " << i;
          occluded += std::abs(wanted - colour * open) > 1e-3;
        }
    EXPECT_GT(occluded, 100) << "the plain product would do";
  }
};

/// Blender's passes: Combined = lit + Emit + Env + VolumeDir + VolumeInd + TransCol (TransDir + TransInd).
struct Passes {
  float lit = 0.6f, emit = 5, env = 0, volume_direct = 0.125f, volume_indirect = 0.25f, colour = 0.5f, direct = 0.25f,
        indirect = 0.5f;
  float untouched(bool in_lamp, size_t i) const {
    return (in_lamp ? emit + 0.5f * float(i) : 0) + env + volume_direct + volume_indirect +
           colour * (direct + indirect);
  }
  Layers layers() const {
    Layers all = {{"ViewLayer.Emit", lamp(emit, 0)},
                  {"ViewLayer.VolumeDir", even(volume_direct, volume_direct, volume_direct)},
                  {"ViewLayer.VolumeInd", even(volume_indirect, volume_indirect, volume_indirect)},
                  {"ViewLayer.TransDir", even(direct, direct, direct)},
                  {"ViewLayer.TransInd", even(indirect, indirect, indirect)},
                  {"ViewLayer.TransCol", even(colour, colour, colour)}};
    for (size_t i = 0; i < 3; ++i)
      all["ViewLayer.Combined"][i] = [*this, i](int x, int y) {
        return untouched(is_lamp(x, y), i) + (is_lamp(x, y) ? 0 : lit);
      };
    return all;
  }
};

TEST_F(DarkenedLightFile, LampsFogAndGlassOfBlenderStay) {
  const Passes passes;
  write_layers("f.exr", passes.layers());
  const Result result = composite("f.exr");
  ASSERT_EQ(result.status, 0) << result.err;
  expect_pixels("f.exr", [&](size_t i, int x, int y, double colour, double open) {
    const double untouched = passes.untouched(is_lamp(x, y), i);
    return (colour - untouched) * open + untouched;
  });
  const Frame before = stored("f.exr", {"color"}), after = stored("c.exr", {"color"}), ao = stored("ao.exr", {"ao"});
  double least = 1;
  for (int y = 0; y < light_height; ++y)
    for (int x = 0; x < light_width; ++x) {
      if (!is_lamp(x, y)) continue;
      least = std::min(least, double(ao.views[0].find("ao")->channels[0].at(x, y)));
      for (size_t i = 0; i < 3; ++i)
        EXPECT_EQ(std::bit_cast<uint32_t>(before.views[0].find("color")->channels[i].at(x, y)),
                  std::bit_cast<uint32_t>(after.views[0].find("color")->channels[i].at(x, y)));
    }
  EXPECT_LT(least, 0.95) << "the lamp is occluded";
  for (const char* words :
       {"emission (ViewLayer.Emit), volume (ViewLayer.VolumeDir + ViewLayer.VolumeInd) and transmission "
        "((ViewLayer.TransDir + ViewLayer.TransInd) x ViewLayer.TransCol) are not darkened",
        "--plane emission=none"})
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  EXPECT_EQ(FrameFile(path("c.exr"), {}).all_channels(), (std::vector<std::string>{"B", "G", "R"}));
}

TEST_F(DarkenedLightFile, AFlagDarkensThemToo) {
  const Passes passes;
  write_layers("f.exr", passes.layers());
  ASSERT_EQ(composite("f.exr", {"--plane", "emission=none", "--plane", "volume=none"}).status, 0);
  const double glass = passes.colour * (passes.direct + passes.indirect);
  expect_pixels("f.exr", [&](size_t, int, int, double colour, double open) { return (colour - glass) * open + glass; });
  ASSERT_EQ(composite("f.exr",
                      {"--plane", "volume=ViewLayer.Emit", "--plane", "emission=none", "--plane", "transmission=none"})
                .status,
            0);
  expect_pixels("f.exr", [&](size_t i, int x, int y, double colour, double open) {
    const double emission = is_lamp(x, y) ? passes.emit + 0.5 * double(i) : 0;
    return (colour - emission) * open + emission;
  });
}

TEST_F(DarkenedLightFile, StrengthAndTintAreOfTheDarkenedPart) {
  const Passes passes;
  write_layers("f.exr", passes.layers());
  ASSERT_EQ(composite("f.exr", {"--composite-strength", "0.5", "--tint", "0.2,0.2,0.2"}).status, 0);
  expect_pixels("f.exr", [&](size_t i, int x, int y, double colour, double open) {
    const double untouched = passes.untouched(is_lamp(x, y), i), share = 1 - 0.5 * (1 - open) * 0.8;
    return (colour - untouched) * share + untouched;
  });
}

// Fog of transmittance T before a surface: C = T S + what the fog scatters. AO darkens T S, so what it takes fades with T.
TEST_F(DarkenedLightFile, FogDimsTheOcclusionBehindIt) {
  const auto transmittance = [](int x) { return std::exp(-0.05f * float(x)); };
  Layers layers;
  for (size_t i = 0; i < 3; ++i) {
    layers["volume"][i] = [=](int x, int) { return 0.8f * (1 - transmittance(x)); };
    layers["beauty"][i] = [=](int x, int) { return 0.5f * transmittance(x) + 0.8f * (1 - transmittance(x)); };
  }
  write_layers("f.exr", layers);
  ASSERT_EQ(composite("f.exr").status, 0);
  expect_pixels("f.exr", [&](size_t, int x, int, double, double open) {
    return 0.5 * double(transmittance(x)) * open + 0.8 * (1 - double(transmittance(x)));
  });
}

// Of a half transparent surface F before B: C = F / 2, premultiplied, or C = F / 2 + B / 2 with `background` B / 2. Laid over B, both
// are F AO / 2 + B / 2.
TEST_F(DarkenedLightFile, WhatLiesBehindIsNotDarkened) {
  const double front = 0.75, behind = 0.5;
  write_layers("f.exr", {{"", even(0.375f, 0.375f, 0.375f)}}, {{"A", even(0.5f)}});
  ASSERT_EQ(composite("f.exr").status, 0);
  const Frame premultiplied = stored("c.exr", {"color", "alpha"});
  EXPECT_EQ(premultiplied.views[0].find("alpha")->channels[0].at(7, 9), 0.5f);
  write_layers("g.exr", {{"", even(0.625f, 0.625f, 0.625f)}, {"backdrop", even(0.25f, 0.25f, 0.25f)}},
               {{"A", even(0.5f)}});
  ASSERT_EQ(composite("g.exr").status, 0);
  const Frame ao = stored("ao.exr", {"ao"});
  expect_pixels("g.exr", [&](size_t i, int x, int y, double, double open) {
    const double wanted = front * open / 2 + behind / 2;
    EXPECT_NEAR(premultiplied.views[0].find("color")->channels[i].at(x, y) + behind / 2, wanted, 1e-6);
    return wanted;
  });
}

TEST_F(DarkenedLightFile, IlluminationTimesAlbedoIsWhatDarkens) {
  const Passes passes;
  Layers layers = passes.layers();
  layers["ViewLayer.DiffDir"] = even(0.5f, 0.5f, 0.5f);
  layers["ViewLayer.DiffInd"] = even(0.25f, 0.25f, 0.25f);
  layers["ViewLayer.DiffCol"] = even(0.5f, 0.25f, 0.75f);
  write_layers("f.exr", layers);
  const Result result = composite("f.exr");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto wanted = [&](size_t i, int x, int y, double colour, double open) {
    const double albedo[] = {0.5, 0.25, 0.75};
    const double diffuse = is_lamp(x, y) ? 0 : std::min(albedo[i] * 0.75, double(passes.lit));
    return colour - diffuse + diffuse * open;
  };
  expect_pixels("f.exr", wanted);
  EXPECT_NE(
      result.err.find("darkens illumination (ViewLayer.DiffDir + ViewLayer.DiffInd) times albedo (ViewLayer.DiffCol)"),
      std::string::npos)
      << result.err;
  const Result automatic = gloam({"auto", file("f.exr"), "-o", file("out.exr"), "--composite", file("auto.exr"),
                                  "--mask", "never", "--float", "--radius", "0.5", "--fov", "60", "--color-holds",
                                  "ambient,shadows,indirect,reflection", "--json", "-"});
  ASSERT_EQ(automatic.status, 0) << automatic.err;
  expect_pixels("f.exr", wanted, "auto.exr", "out.exr");
  EXPECT_EQ(automatic.json()["not_darkened"], nlohmann::json({"emission", "volume", "transmission"}));
  EXPECT_EQ(FrameFile(path("auto.exr"), {}).text_attribute("gloamComposite").find("ambient: illumination") ==
                std::string::npos,
            false);
  EXPECT_NE(automatic.err.find("emission (ViewLayer.Emit), volume"), std::string::npos) << automatic.err;
}

TEST_F(DarkenedLightFile, PassesOfArnoldStay) {
  const float emission = 0.25f, background = 0.125f, volume[] = {0.0625f, 0.03125f}, glass[] = {0.125f, 0.25f};
  const double untouched =
      double(emission) + double(background) + double(volume[0] + volume[1]) + double(glass[0] + glass[1]);
  const auto grey = [](float value) { return even(value, value, value); };
  write_layers("f.exr", {{"", grey(float(untouched) + 0.5f)},
                         {"emission", grey(emission)},
                         {"backdrop", grey(background)},
                         {"volume_direct", grey(volume[0])},
                         {"volume_indirect", grey(volume[1])},
                         {"transmission_direct", grey(glass[0])},
                         {"transmission_indirect", grey(glass[1])}});
  ASSERT_EQ(composite("f.exr").status, 0);
  expect_pixels("f.exr",
                [&](size_t, int, int, double colour, double open) { return (colour - untouched) * open + untouched; });
}

TEST_F(DarkenedLightFile, FramesOfAShotAlike) {
  const Passes passes;
  for (const int number : {1, 2}) write_layers(numbered("shot", number), passes.layers(), {}, {}, number);
  const Result run = gloam({"run", "hbao+", file("shot.####.exr"), "--radius", "0.5", "--fov", "60", "-o",
                            file("ao.####.exr"), "--float", "--composite", file("c.####.exr")});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("emission (ViewLayer.Emit), volume"), std::string::npos) << run.err;
  const Result automatic =
      gloam({"auto", file("shot.####.exr"), "--radius", "0.5", "--fov", "60", "-o", file("out.####.exr"), "--float",
             "--composite", file("auto.####.exr"), "--color-holds", "ambient,shadows,indirect,reflection"});
  ASSERT_EQ(automatic.status, 0) << automatic.err;
  for (const int number : {1, 2}) {
    const auto wanted = [&](size_t i, int x, int y, double colour, double open) {
      const double untouched = passes.untouched(is_lamp(x, y), i);
      return (colour - untouched) * open + untouched;
    };
    expect_pixels(numbered("shot", number), wanted, numbered("c", number), numbered("ao", number));
    expect_pixels(numbered("shot", number), wanted, numbered("auto", number), numbered("out", number));
  }
}

// Passes beside another pass: Emit is no part of DiffCol.
TEST_F(DarkenedLightFile, LightThatIsNoPartOfTheColourIsLeftOut) {
  write_layers("f.exr", {{"ViewLayer.Combined", lamp(5, 0.5f)},
                         {"ViewLayer.Emit", lamp(5, 0)},
                         {"ViewLayer.VolumeDir", even(0.1f, 0.1f, 0.1f)},
                         {"ViewLayer.Env", even(0, 0, 0)},
                         {"ViewLayer.DiffCol", even(0.5f, 0.5f, 0.5f)}});
  const Result result = composite("f.exr", {"--plane", "color=ViewLayer.DiffCol"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("color: emission is more than it in 100 % of the pixels that it lights"), std::string::npos)
      << result.err;
  EXPECT_EQ(result.err.find("not darkened"), std::string::npos) << result.err;
  const Frame after = stored("c.exr", {"color"}), ao = stored("ao.exr", {"ao"});
  for (int x = 0; x < light_width; ++x) {
    const float open = ao.views[0].find("ao")->channels[0].at(x, 20);
    ASSERT_EQ(after.views[0].find("color")->channels[0].at(x, 20), float(0.5 * double(open)));
  }
}

TEST_F(DarkenedLightFile, ACapturedLampIsKept) {
  ASSERT_EQ(
      gloam({"capture", "lounge", "-o", file("f.exr"), "--size", "96x54", "--planes", "normal,color,emission"}).status,
      0);
  ASSERT_EQ(gloam({"run", "ao", file("f.exr"), "-o", file("ao.exr"), "--float", "--radius", "0.5", "--composite",
                   file("c.exr")})
                .status,
            0);
  const Frame before = stored("f.exr", {"color", "emission"}), after = stored("c.exr", {"color"}),
              ao = stored("ao.exr", {"ao"});
  long long shining = 0;
  for (int y = 0; y < 54; ++y)
    for (int x = 0; x < 96; ++x) {
      const float open = ao.views[0].find("ao")->channels[0].at(x, y);
      for (size_t i = 0; i < 3; ++i) {
        const float colour = before.views[0].find("color")->channels[i].at(x, y),
                    emission = before.views[0].find("emission")->channels[i].at(x, y),
                    is = after.views[0].find("color")->channels[i].at(x, y);
        ASSERT_LE(emission, colour * 1.000001f);
        ASSERT_NEAR(is, double(emission) + (double(colour) - double(emission)) * open, 1e-5);
        shining += emission > 0.1f && open < 0.95f;
      }
    }
  EXPECT_GT(shining, 20);
}

TEST_F(DarkenedLightFile, InfoNamesThemAndWhatTheyAreFor) {
  Layers layers = Passes().layers();
  layers["ViewLayer.DiffDir"] = layers["ViewLayer.DiffInd"] = layers["ViewLayer.DiffCol"] = even(0.5f, 0.5f, 0.5f);
  write_layers("f.exr", layers);
  const Result told = gloam({"info", file("f.exr"), "--fov", "60"});
  ASSERT_EQ(told.status, 0) << told.err;
  for (const char* words :
       {"emission (ViewLayer.Emit), volume (ViewLayer.VolumeDir + ViewLayer.VolumeInd)", "does not darken",
        "illumination (ViewLayer.DiffDir + ViewLayer.DiffInd) times albedo (ViewLayer.DiffCol)"})
    EXPECT_NE(told.out.find(words), std::string::npos) << told.out;
  const nlohmann::json planes = gloam({"info", file("f.exr"), "--fov", "60", "--json", "-"}).json()["planes"];
  const auto volume =
      std::find_if(planes.begin(), planes.end(), [](const auto& plane) { return plane["name"] == "volume"; });
  ASSERT_NE(volume, planes.end()) << planes;
  EXPECT_EQ((*volume)["channels"].size(), 6u);
  EXPECT_FLOAT_EQ((*volume)["mean"], 0.375);
  EXPECT_NE((*volume)["help"].get<std::string>().find("fog"), std::string::npos);
}

/// IDs of a Cryptomatte are bits of hashes: any float, with coverage beside it.
float id_at(int x, int y) {
  return std::bit_cast<float>(uint32_t(0x3f000000u + uint32_t(x * 7919 + y * 104729) % 0xffffff));
}

const std::map<std::string, std::string> of_cryptomatte = {
    {"cryptomatte/0b1c2d3/name", "ViewLayer.CryptoObject"},
    {"cryptomatte/0b1c2d3/hash", "MurmurHash3_32"},
    {"cryptomatte/0b1c2d3/conversion", "uint32_to_float32"},
    {"cryptomatte/0b1c2d3/manifest", R"({"floor":"3f001234","lamp":"3f00abcd"})"}};

TEST_F(DarkenedLightFile, CryptomattesAreKeptBitForBit) {
  std::map<std::string, Pixels> ids;
  for (const char* layer : {"ViewLayer.CryptoObject00", "ViewLayer.CryptoObject01"})
    for (const char* component : {".r", ".g", ".b", ".a"}) ids[std::string(layer) + component] = id_at;
  write_layers("f.exr", Passes().layers(), ids, of_cryptomatte);
  const Result result = composite("f.exr", {"--into", file("copy.exr")});
  ASSERT_EQ(result.status, 0) << result.err;
  Imf::MultiPartInputFile copy(file("copy.exr").c_str());
  for (const auto& [attribute, text] : of_cryptomatte)
    EXPECT_EQ(copy.header(0).typedAttribute<Imf::StringAttribute>(attribute).value(), text);
  for (const auto& [channel, unused] : ids) {
    ASSERT_TRUE(copy.header(0).channels().findChannel(channel)) << channel;
    EXPECT_EQ(copy.header(0).channels().findChannel(channel)->type, Imf::FLOAT);
    std::vector<float> values(size_t(light_width) * light_height);
    Imf::FrameBuffer buffer;
    buffer.insert(channel, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float),
                                      sizeof(float) * light_width));
    Imf::InputPart part(copy, 0);
    part.setFrameBuffer(buffer);
    part.readPixels(0, light_height - 1);
    for (int y = 0; y < light_height; ++y)
      for (int x = 0; x < light_width; ++x)
        ASSERT_EQ(std::bit_cast<uint32_t>(values[size_t(y * light_width + x)]), std::bit_cast<uint32_t>(id_at(x, y)));
  }
  // A picture without the channels must not name them.
  const Imf::MultiPartInputFile alone(file("c.exr").c_str());
  for (const auto& [attribute, text] : of_cryptomatte)
    EXPECT_EQ(alone.header(0).find(attribute), alone.header(0).end()) << attribute;
  const Result told = composite("f.exr");
  EXPECT_NE(
      told.err.find("ViewLayer.CryptoObject: this Cryptomatte is not in the composite; gloam run --into COPY.exr"),
      std::string::npos)
      << told.err;
  const Result info = gloam({"info", file("f.exr"), "--fov", "60"});
  EXPECT_NE(info.out.find("Cryptomatte ViewLayer.CryptoObject: 8 channels, which --into copies"), std::string::npos)
      << info.out;
  EXPECT_EQ(info.out.find("not read: ViewLayer.Crypto"), std::string::npos) << info.out;
  EXPECT_EQ(gloam({"info", file("f.exr"), "--fov", "60", "--json", "-"}).json()["cryptomattes"],
            nlohmann::json({"ViewLayer.CryptoObject"}));
}

}  // namespace
}  // namespace gloam::test::darkened_light_test
