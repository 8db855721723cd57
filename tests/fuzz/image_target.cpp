// Images of other formats than EXR: any bytes are a frame whose planes keep gloam's conventions, or are refused in one line. The first byte
// of an input chooses the format.
#include <png.h>
#include <tiffio.h>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/temporary_folder.h"
#include "fuzz/memory_file.h"
#include "fuzz/promise.h"
#include "fuzz/target.h"
#include "gloam/exr.h"
#include "image/image_values.h"

namespace gloam::fuzz {
namespace {

constexpr long long most_pixels = 1 << 14;
constexpr int seed_width = 5, seed_height = 4;

constexpr std::array endings = {".png", ".tif", ".pfm", ".hdr", ".npy", ".npz", ".hdf5"};

/// One name for each format, all of them the same bytes.
class Names {
 public:
  /// The path of this input under the ending that its first byte chooses.
  std::string hold(const uint8_t* data, size_t size) {
    const std::string& bytes = file_.hold(data + 1, size - 1);
    const std::filesystem::path name = folder_.path() / (std::string("depth") + endings[data[0] % endings.size()]);
    std::filesystem::remove(name);
    std::filesystem::create_symlink(bytes, name);
    return name.string();
  }

 private:
  MemoryFile file_;
  TemporaryFolder folder_{"fuzz"};
};

void check_images(const std::vector<ImageValues>& images) {
  require(!images.empty(), "a file holds an image");
  for (const ImageValues& image : images) {
    require(image.channels.size() >= 1 && image.channels.size() <= 4, "an image has 1 to 4 components");
    require((long long)image.layout().width * image.layout().height <= most_pixels, "an image is not too large");
    for (const Channel& channel : image.channels)
      require(channel.layout() == image.layout(), "all components have one size");
  }
}

void read_frame(const std::string& path) {
  ReadOptions options;
  options.most_pixels = most_pixels;
  options.fov_degrees = 60;
  FrameFile file(path, options);
  const Frame frame = file.read(file.common_planes());
  for (const View& view : frame.views) {
    const Plane* depth = view.find("depth");
    if (!depth) continue;
    const Layout& layout = depth->channels.front().layout();
    for (int y = 0; y < layout.height; ++y)
      for (int x = 0; x < layout.width; ++x)
        require(depth->channels.front().at(x, y) >= 1e-30f, "a depth is above 0 or infinite");
  }
}

template <typename Number>
std::string values(Number (*at)(int)) {
  std::string bytes;
  for (int i = 0; i < seed_width * seed_height; ++i) {
    const Number value = at(i);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  return bytes;
}

float length_at(int i) { return 1 + 0.25f * float(i % seed_width); }
uint16_t millimetres_at(int i) { return uint16_t(1000 + 250 * (i % seed_width)); }

std::string npy(const std::string& type, const std::string& bytes) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + std::to_string(seed_height) +
                       ", " + std::to_string(seed_width) + "), }";
  header.resize((10 + header.size() + 64) / 64 * 64 - 10, ' ');
  return std::string("\x93NUMPY\x01\x00", 8) + char(header.size() & 255) + char(header.size() >> 8) + header + bytes;
}

void put_number(std::string& to, unsigned long long value, int bytes) {
  for (int i = 0; i < bytes; ++i) to += char(value >> (8 * i) & 255);
}

/// A ZIP archive of one stored file.
std::string archive(const std::string& name, const std::string& bytes) {
  std::string local = "PK\x03\x04", entry = "PK\x01\x02", end = "PK\x05\x06";
  const auto common = [&](std::string& to) {
    put_number(to, 0, 2), put_number(to, 0, 2), put_number(to, 0, 8);  // flags, method, time, check sum
    put_number(to, bytes.size(), 4), put_number(to, bytes.size(), 4), put_number(to, name.size(), 2);
  };
  put_number(local, 20, 2), common(local), put_number(local, 0, 2);
  local += name + bytes;
  put_number(entry, 20, 2), put_number(entry, 20, 2), common(entry), put_number(entry, 0, 18);
  entry += name;
  put_number(end, 0, 4), put_number(end, 1, 2), put_number(end, 1, 2), put_number(end, entry.size(), 4);
  put_number(end, local.size(), 4), put_number(end, 0, 2);
  return local + entry + end;
}

std::string png() {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = seed_width, image.height = seed_height;
  image.format = PNG_FORMAT_RGB;
  std::string pixels;
  for (int i = 0; i < 3 * seed_width * seed_height; ++i) pixels += char(7 * i);
  png_alloc_size_t size = 1 << 14;
  std::string bytes(size, '\0');
  require(png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr) != 0, "a PNG is made");
  bytes.resize(size);
  return bytes;
}

std::string file_bytes(const std::filesystem::path& file) {
  std::stringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

std::string tiff(const std::filesystem::path& file, int compression, bool is_tiled) {
  TIFF* out = TIFFOpen(file.c_str(), "w");
  TIFFSetField(out, TIFFTAG_IMAGEWIDTH, seed_width);
  TIFFSetField(out, TIFFTAG_IMAGELENGTH, seed_height);
  TIFFSetField(out, TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(out, TIFFTAG_BITSPERSAMPLE, 32);
  TIFFSetField(out, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
  TIFFSetField(out, TIFFTAG_COMPRESSION, compression);
  TIFFSetField(out, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  std::vector<float> block(256, 2.5f);
  if (is_tiled) {
    TIFFSetField(out, TIFFTAG_TILEWIDTH, 16);
    TIFFSetField(out, TIFFTAG_TILELENGTH, 16);
    TIFFWriteEncodedTile(out, 0, block.data(), tmsize_t(block.size() * sizeof(float)));
  } else {
    for (int y = 0; y < seed_height; ++y) TIFFWriteScanline(out, block.data(), uint32_t(y), 0);
  }
  TIFFClose(out);
  return file_bytes(file);
}

}  // namespace

std::vector<std::string> seeds() {
  const TemporaryFolder folder("seeds");
  const std::string size = std::to_string(seed_width) + " " + std::to_string(seed_height);
  const std::string lengths = values(length_at), whole = values(millimetres_at);
  const std::string flat(4 * seed_width * seed_height, '\x80');
  const auto of = [](int format, const std::string& bytes) { return char(format) + bytes; };
  return {of(0, png()),
          of(1, tiff(folder.path() / "strips.tif", COMPRESSION_LZW, false)),
          of(1, tiff(folder.path() / "tiles.tif", COMPRESSION_ADOBE_DEFLATE, true)),
          of(2, "Pf\n" + size + "\n-1.0\n" + lengths),
          of(3, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(seed_height) + " +X " +
                    std::to_string(seed_width) + "\n" + flat),
          of(4, npy("<f4", lengths)),
          of(4, npy(">u2", whole)),
          of(5, archive("depth.npy", npy("<f4", lengths))),
          of(6, file_bytes(std::filesystem::path(GLOAM_SOURCE_DIR) / "tests/fuzz/depth.hdf5"))};
}

}  // namespace gloam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace gloam::fuzz;
  static Names names;
  if (size < 2) return 0;
  const std::string path = names.hold(data, size);
  const auto read = [&] { check_images(gloam::read_images(path, most_pixels)); };
  if (reads(path, read)) reads(path, [&] { read_frame(path); });
  return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned) {
  if (size < 2) return LLVMFuzzerMutate(data, size, most);
  return 1 + LLVMFuzzerMutate(data + 1, size - 1, most - 1);  // the format stays
}
