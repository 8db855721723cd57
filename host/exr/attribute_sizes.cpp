#include "exr/attribute_sizes.h"

#include <map>
#include <string>

#include "gloam/error.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

/// An attribute of a header, and the place of its value in the file.
struct Attribute {
  std::string name, type;
  uint64_t begin = 0, end = 0;
  uint64_t size() const { return end - begin; }
};

[[noreturn]] void refuse(const fs::path& path, const Attribute& attribute) {
  throw Error("{}: truncated or corrupted EXR (attribute {} of type {} claims {} bytes); render or copy it again",
              path.string(), attribute.name, attribute.type, attribute.size());
}

/// Reads a name and the 0 that ends it.
std::string read_name(ExrInput& stream) {
  std::string name;
  for (char c = 0; stream.read(&c, 1), c != 0;) name += c;
  return name;
}

uint32_t read_number(ExrInput& stream) {
  uint8_t bytes[4];
  stream.read(reinterpret_cast<char*>(bytes), 4);
  return bytes[0] | uint32_t(bytes[1]) << 8 | uint32_t(bytes[2]) << 16 | uint32_t(bytes[3]) << 24;
}

/// The end of a list of channels: names followed by 16 bytes each, up to an empty name.
uint64_t end_of_channels(ExrInput& stream, const Attribute& attribute) {
  while (stream.tellg() < attribute.end && !read_name(stream).empty()) stream.seekg(stream.tellg() + 16);
  return stream.tellg();
}

/// The end of a list of texts: each is a length and as many bytes.
uint64_t end_of_texts(ExrInput& stream, const Attribute& attribute) {
  while (stream.tellg() < attribute.end) {
    const uint64_t length = read_number(stream);
    stream.seekg(stream.tellg() + length);
  }
  return stream.tellg();
}

/// The end of a preview: width, height, and four bytes for each pixel.
uint64_t end_of_preview(ExrInput& stream) {
  const uint64_t width = read_number(stream), height = read_number(stream);
  return width <= 1 << 16 && height <= 1 << 16 ? stream.tellg() + 4 * width * height : 0;
}

/// The place that OpenEXR reaches by reading the value, for the types whose stated size it ignores.
uint64_t end_of_value(ExrInput& stream, const Attribute& attribute) {
  static const std::map<std::string, uint64_t> sizes = {{"box2f", 16},
                                                        {"box2i", 16},
                                                        {"chromaticities", 32},
                                                        {"compression", 1},
                                                        {"deepImageState", 1},
                                                        {"double", 8},
                                                        {"envmap", 1},
                                                        {"float", 4},
                                                        {"int", 4},
                                                        {"keycode", 28},
                                                        {"lineOrder", 1},
                                                        {"m33d", 72},
                                                        {"m33f", 36},
                                                        {"m44d", 128},
                                                        {"m44f", 64},
                                                        {"rational", 8},
                                                        {"tiledesc", 9},
                                                        {"timecode", 8},
                                                        {"v2d", 16},
                                                        {"v2f", 8},
                                                        {"v2i", 8},
                                                        {"v3d", 24},
                                                        {"v3f", 12},
                                                        {"v3i", 12}};
  if (const auto fixed = sizes.find(attribute.type); fixed != sizes.end()) return attribute.begin + fixed->second;
  if (attribute.type == "chlist") return end_of_channels(stream, attribute);
  if (attribute.type == "stringvector") return end_of_texts(stream, attribute);
  if (attribute.type == "preview") return end_of_preview(stream);
  return attribute.end;
}

/// Returns false for a header without attributes, which ends the headers of a file of several parts.
bool check_header(const fs::path& path, ExrInput& stream) {
  bool any = false;
  for (Attribute attribute; !(attribute.name = read_name(stream)).empty(); any = true) {
    attribute.type = read_name(stream);
    const uint32_t size = read_number(stream);
    attribute.begin = stream.tellg();
    attribute.end = attribute.begin + size;
    if (attribute.end > stream.size() || end_of_value(stream, attribute) != attribute.end) refuse(path, attribute);
    stream.seekg(attribute.end);
  }
  return any;
}

}  // namespace

uint64_t check_attribute_sizes(const fs::path& path, ExrInput& stream, bool is_multipart) {
  const uint64_t begin = stream.tellg();
  while (check_header(path, stream) && is_multipart) {
  }
  const uint64_t end = stream.tellg();
  stream.seekg(begin);
  return end;
}

}  // namespace gloam
