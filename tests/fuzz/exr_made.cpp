#include "fuzz/exr_made.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledOutputPart.h>
#include <OpenEXR/ImfVecAttribute.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/gtc/quaternion.hpp>
#include <iterator>
#include <list>
#include <vector>

#include "camera/matrices.h"
#include "fuzz/words.h"

namespace gloam::fuzz {
namespace {

/// A file in memory.
class Memory : public Imf::OStream {
 public:
  Memory() : Imf::OStream("memory") {}
  void write(const char* bytes, int count) override {
    if (text.size() < at_ + size_t(count)) text.resize(at_ + size_t(count));
    std::memcpy(&text[at_], bytes, size_t(count));
    at_ += size_t(count);
  }
  uint64_t tellp() override { return at_; }
  void seekp(uint64_t position) override { at_ = size_t(position); }
  std::string text;

 private:
  size_t at_ = 0;
};

// --- Headers

Imath::Box2i window_near(const Imath::V2i& corner, Random& random) {
  const Imath::V2i from = corner + Imath::V2i{random.between(-3, 3), random.between(-3, 3)};
  int size[2] = {random.between(1, 16), random.between(1, 16)};
  if (random.one_in(8)) size[random.below(2)] = random.between(1, 300);  // further chunks, further bands
  return {from, from + Imath::V2i(size[0] - 1, size[1] - 1)};
}

void set_windows(Imf::Header& header, const Imath::Box2i& display, Random& random) {
  header.displayWindow() = display;
  header.dataWindow() = random.one_in(2) ? display : window_near(display.min, random);
}

void set_storage(Imf::Header& header, Random& random) {
  // Seldom PIZ and DWA: they need a megabyte of tables for each chunk, however small.
  header.compression() = random.one_in(16)
                             ? Imf::Compression(random.below(Imf::NUM_COMPRESSION_METHODS))
                             : random.pick({Imf::NO_COMPRESSION, Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION,
                                            Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PXR24_COMPRESSION});
  header.lineOrder() = random.pick({Imf::INCREASING_Y, Imf::INCREASING_Y, Imf::DECREASING_Y});
  header.setType(random.one_in(3) ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
  if (header.type() == Imf::SCANLINEIMAGE) return;
  header.setTileDescription(
      Imf::TileDescription{unsigned(random.between(4, 20)), unsigned(random.between(4, 20)),
                           random.pick({Imf::ONE_LEVEL, Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS}),
                           random.pick({Imf::ROUND_DOWN, Imf::ROUND_UP})});
  if (random.one_in(4)) header.lineOrder() = Imf::RANDOM_Y;
}

/// The channels of one layer: one, or several that belong together.
std::vector<std::string> layer_channels(Random& random) {
  const std::vector<std::vector<std::string>> together = {{"X", "Y", "Z"}, {"R", "G", "B"}, {"R", "G", "B", "A"},
                                                          {"Z"},           {"V"},           {"X", "Y"},
                                                          {"Z", "A"},      {"x", "y", "z"}, {"X", "Y", "Z", "W"}};
  return random.one_in(4) ? std::vector<std::string>{random.pick(channel_words())} : random.pick(together);
}

void add_layer(Imf::Header& header, const std::string& layer, const std::string& view,
               const std::vector<std::string>& channels, Random& random) {
  const Imf::PixelType type = random.pick({Imf::HALF, Imf::FLOAT, Imf::FLOAT, Imf::UINT});
  const bool view_first = random.one_in(2);
  for (const std::string& channel : channels) {
    std::string name;
    for (const std::string& piece : {view_first ? view : layer, view_first ? layer : view, channel})
      if (!piece.empty()) name += (name.empty() ? "" : ".") + piece;
    const int sampling = random.one_in(64) ? 2 : 1;
    header.channels().insert(name, Imf::Channel(type, sampling, sampling));
  }
}

void add_channels(Imf::Header& header, const std::vector<std::string>& views, Random& random) {
  // The channels that most readers look for, so that most files have usable contents.
  if (random.one_in(2)) add_layer(header, "", "", {"Z"}, random);
  if (random.one_in(2)) add_layer(header, "N", "", {"X", "Y", "Z"}, random);
  for (int layers = random.between(0, 3); layers > 0; --layers) {
    const std::string layer = random.pick(layer_words());
    const std::vector<std::string> channels = layer_channels(random);
    add_layer(header, layer, "", channels, random);
    for (const std::string& view : views)
      if (random.one_in(2)) add_layer(header, layer, view, channels, random);
  }
  if (header.channels().begin() == header.channels().end()) add_layer(header, "", "", {"Z"}, random);
}

Camera made_camera(const Imath::Box2i& display, Random& random) {
  Camera camera;
  camera.orthographic = random.one_in(3);
  camera.fx = random.between(1, 400) / 4.0;
  camera.fy = random.one_in(2) ? camera.fx : random.between(1, 400) / 4.0;
  camera.cx = (display.min.x + display.max.x + 1) / 2.0 + random.between(-4, 4);
  camera.cy = (display.min.y + display.max.y + 1) / 2.0;
  Pose pose;
  const double turn[] = {double(random.between(1, 5)), double(random.between(-5, 5)), double(random.between(-5, 5)),
                         double(random.between(-5, 5))};
  pose.world_to_view = glm::mat3_cast(glm::normalize(glm::dquat(turn[0], turn[1], turn[2], turn[3])));
  pose.position = {random.between(-9, 9), random.between(-9, 9), random.one_in(4) ? 1e7 : 2};
  camera.pose = pose;
  return camera;
}

void add_camera(Imf::Header& header, const std::string& prefix, Random& random) {
  const Imath::Box2i display = header.displayWindow();
  const Window window{display.min.x, display.min.y, display.max.x + 1, display.max.y + 1};
  CameraMatrices matrices = matrices_of(made_camera(display, random), window);
  if (random.one_in(8)) matrices.world_to_ndc[random.below(4)][random.below(4)] = odd_number(random);
  if (random.one_in(8)) matrices.world_to_camera[random.below(4)][random.below(4)] = odd_number(random);
  if (random.one_in(16)) matrices.origin[int(random.below(3))] = odd_number(random);
  const auto add_matrix = [&](const char* name, const Imath::M44d& m) {
    if (random.one_in(2))
      header.insert(prefix + name, Imf::M44dAttribute(m));
    else
      header.insert(prefix + name, Imf::M44fAttribute(Imath::M44f(m)));
  };
  if (!random.one_in(16)) add_matrix("worldToCamera", matrices.world_to_camera);
  if (!random.one_in(16)) add_matrix("worldToNDC", matrices.world_to_ndc);
  if (random.one_in(2))
    header.insert(prefix + "gloamOrigin", Imf::V3dAttribute({matrices.origin.x, matrices.origin.y, matrices.origin.z}));
}

const std::vector<std::string>& display_texts() {
  static const std::vector<std::string> texts = [] {
    std::vector<std::string> read = {"", "{", "{\"modules\": 3}"};
    for (const char* name : {"small", "convex"}) {
      std::ifstream file(std::string(GLOAM_SOURCE_DIR "/data/displays/") + name + ".json");
      read.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
    return read;
  }();
  return texts;
}

void add_attributes(Imf::Header& header, const std::string& prefix, Random& random) {
  const auto add_number = [&](const char* name) {
    const double value = random.one_in(2) ? random.between(1, 50) / 10.0 : odd_number(random);
    if (random.one_in(2))
      header.insert(prefix + name, Imf::FloatAttribute(float(value)));
    else
      header.insert(prefix + name, Imf::DoubleAttribute(value));
  };
  const auto add_text = [&](const char* name, const std::string& value) {
    header.insert(prefix + name, Imf::StringAttribute(value));
  };
  if (random.one_in(2)) add_camera(header, prefix, random);
  if (random.one_in(4)) add_number("near"), add_number("far");
  if (random.one_in(8)) add_text("gloamCamera", odd_word(random));
  if (random.one_in(8)) add_text("gloamPose", random.pick({"unknown", "known"}));
  if (random.one_in(8)) add_text("gloamNormalSpace", random.pick({"view", "world", "none"}));
  if (random.one_in(8)) add_text("generatedBy", random.pick({"Mitsuba 3", "Blender"}));
  if (random.one_in(8)) add_text("BlenderMultiChannel", "Blender V2.55.1 and newer");
  if (random.one_in(16)) add_text("gloamDisplay", random.pick(display_texts()));
  if (random.one_in(8)) add_number("aoRadius");
}

// --- Values

float made_value(Random& random, int kind) {
  switch (kind) {
    case 0:  // a depth
      return float(random.between(1, 100)) / 8;
    case 1:  // a component of a normal
      return float(random.between(-8, 8)) / 8;
    case 2:
      return -float(random.between(1, 100)) / 8;
    case 3:  // a window depth
      return float(random.between(0, 16)) / 16;
    default:
      return float(odd_number(random));
  }
}

/// Owns the pixels of one level of one part. Values are floats; OpenEXR gets them in their true type.
struct Pixels {
  std::list<std::vector<uint32_t>> memory;
  Imf::FrameBuffer buffer;

  Pixels(const Imf::Header& header, const Imath::Box2i& window, Random& random) {
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
      auto& values = memory.emplace_back(size_t(width) * size_t(height));
      const int kind = random.between(0, 4);
      for (uint32_t& value : values)
        value = bits_of(made_value(random, random.one_in(32) ? 4 : kind), c.channel().type);
      buffer.insert(c.name(),
                    Imf::Slice::Make(c.channel().type, values.data(), window.min, int64_t(width), int64_t(height),
                                     size_t(4), 4 * size_t(width), c.channel().xSampling, c.channel().ySampling));
    }
  }

  static uint32_t bits_of(float value, Imf::PixelType type) {
    uint32_t bits = 0;
    const half rounded(std::fabs(value) < 65504 || !std::isfinite(value) ? value : 65504.0f);
    if (type == Imf::HALF) std::memcpy(&bits, &rounded, sizeof rounded);
    if (type == Imf::FLOAT) std::memcpy(&bits, &value, sizeof value);
    if (type == Imf::UINT) bits = value >= 0 && value < 4e9f ? uint32_t(value) : UINT32_MAX;
    return bits;
  }
};

// --- The file

void write_scanlines(Imf::MultiPartOutputFile& file, int part, Random& random) {
  const Imf::Header& header = file.header(part);
  const Pixels pixels(header, header.dataWindow(), random);
  Imf::OutputPart output(file, part);
  output.setFrameBuffer(pixels.buffer);
  output.writePixels(header.dataWindow().max.y - header.dataWindow().min.y + 1);
}

void write_tiles(Imf::MultiPartOutputFile& file, int part, Random& random) {
  Imf::TiledOutputPart output(file, part);
  for (int y = 0; y < output.numYLevels(); ++y) {
    for (int x = 0; x < output.numXLevels(); ++x) {
      if (!output.isValidLevel(x, y)) continue;
      const Pixels pixels(file.header(part), output.dataWindowForLevel(x, y), random);
      output.setFrameBuffer(pixels.buffer);
      output.writeTiles(0, output.numXTiles(x) - 1, 0, output.numYTiles(y) - 1, x, y);
    }
  }
}

std::vector<std::string> made_views(Random& random) {
  std::vector<std::string> views;
  if (random.one_in(3))
    for (int count = random.between(1, 3); count > 0; --count) views.push_back(random.pick(view_words()));
  return views;
}

std::vector<Imf::Header> made_headers(Random& random) {
  const std::vector<std::string> views = made_views(random);
  const Imath::Box2i display = window_near({0, 0}, random);
  std::vector<Imf::Header> headers;
  for (int parts = random.one_in(3) ? random.between(2, 4) : 1; parts > 0; --parts) {
    Imf::Header& header = headers.emplace_back();
    set_windows(header, display, random);
    set_storage(header, random);
    add_channels(header, views, random);
    add_attributes(header, "", random);
    for (const std::string& view : views)
      if (random.one_in(2)) add_attributes(header, view + ".", random);
    if (!views.empty() && random.one_in(2)) Imf::addMultiView(header, views);
    if (!views.empty() && random.one_in(2)) header.setView(random.pick(views));
    if (parts > 1 || headers.size() > 1) header.setName(random.pick(layer_words()) + std::to_string(headers.size()));
  }
  return headers;
}

/// Throws as OpenEXR does for inconsistent headers.
std::string written(const std::vector<Imf::Header>& headers, Random& random) {
  Memory memory;
  {
    Imf::MultiPartOutputFile file(memory, headers.data(), int(headers.size()), true, 0);
    for (int part = 0; part < int(headers.size()); ++part) {
      if (headers[size_t(part)].type() == Imf::TILEDIMAGE)
        write_tiles(file, part, random);
      else
        write_scanlines(file, part, random);
    }
  }
  return memory.text;
}

}  // namespace

std::string made_exr(Random& random) {
  for (;;) {
    try {
      return written(made_headers(random), random);
    } catch (const IEX_NAMESPACE::BaseExc&) {
    }
  }
}

}  // namespace gloam::fuzz
