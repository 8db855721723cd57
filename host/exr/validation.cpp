#include "exr/validation.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfVersion.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <map>
#include <string>

#include "exr/chunks.h"
#include "exr/stream.h"
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

/// OpenEXR allocates memory of an attribute's stated size before it reads the attribute. It reads types that it knows by their own
/// size, whatever the file states, and then takes the wrong bytes for the next attribute. This function goes through the headers
/// from the stream's position, and returns the stream there. Returns where the headers end. Throws Error naming the file and the
/// attribute for a size that is larger than the file or does not match the attribute's type; throws the stream's error at the end of
/// the file.
uint64_t check_attribute_sizes(const fs::path& path, ExrInput& stream, bool is_multipart) {
  const uint64_t begin = stream.tellg();
  while (check_header(path, stream) && is_multipart) {
  }
  const uint64_t end = stream.tellg();
  stream.seekg(begin);
  return end;
}

namespace fs = std::filesystem;

void check_windows(const fs::path& path, const Imf::Header& header, long long most_pixels) {
  check_size(path, box_of(header.displayWindow()), "display", most_pixels);
  check_size(path, box_of(header.dataWindow()), "data", most_pixels);
}

}  // namespace

void check_size(const fs::path& path, const Box& box, const char* what, long long most_pixels) {
  constexpr int64_t end = 1LL << 30;  // larger coordinates overflow in OpenEXR
  if (box.empty()) throw Error("{}: corrupted EXR: its {} window is empty", path.string(), what);
  if (!box.larger_than(most_pixels) && box.x0 > -end && box.y0 > -end && box.x1 < end && box.y1 < end) return;
  throw Error("{}: claims a {} window of {} x {} pixels; at most 2^{} pixels in all are read", path.string(), what,
              box.x1 - box.x0, box.y1 - box.y0, std::bit_width(uint64_t(most_pixels)) - 1);
}

uint64_t check_headers(const fs::path& path, ExrInput& stream, long long most_pixels) {
  char start[8];
  stream.read(start, 8);
  const unsigned flags = unsigned(uint8_t(start[5])) << 8;
  int version = int(uint8_t(start[4]) | flags);
  const uint64_t end = check_attribute_sizes(path, stream, flags & Imf::MULTI_PART_FILE_FLAG);
  try {
    do {
      Imf::Header header;
      header.readFrom(stream, version);
      if (header.readsNothing()) break;
      check_windows(path, header, most_pixels);
    } while (flags & Imf::MULTI_PART_FILE_FLAG);
  } catch (const IEX_NAMESPACE::BaseExc&) {
  }
  stream.seekg(0);
  return end;
}

bool is_deep(const Imf::Header& header) { return header.hasType() && Imf::isDeepData(header.type()); }

void check_parts(const fs::path& path, const Imf::MultiPartInputFile& file, long long most_pixels) {
  int deep = 0;
  for (int part = 0; part < file.parts(); ++part) {
    const Imf::Header& header = file.header(part);
    deep += is_deep(header);
    check_windows(path, header, most_pixels);
  }
  if (deep == file.parts())
    throw Error("{}: is a deep EXR, with many samples per pixel; flatten it first", path.string());
}

// No codec compresses a million to one.
void check_plausible(const fs::path& path, const Imf::Header& header, uint64_t file_size) {
  const Box data = box_of(header.dataWindow());
  const int64_t width = data.x1 - data.x0, height = data.y1 - data.y0, per_pixel = bytes_per_pixel(header);
  const bool is_plausible = pixels_per_chunk(header) <= INT32_MAX / std::max<int64_t>(per_pixel, 1) &&
                            uint64_t(width * height) / (1 << 20) * uint64_t(per_pixel) <= file_size;
  if (!is_plausible)
    throw Error("{}: truncated or corrupted EXR (claims {} x {} pixels in {} bytes); render or copy it again",
                path.string(), width, height, file_size);
}

}  // namespace gloam
