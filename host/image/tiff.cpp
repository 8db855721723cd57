#include "image/tiff.h"

#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>

#include "gloam/error.h"
#include "image/stored_array.h"

namespace gloam {
namespace {

/// Bytes in memory as a file for libtiff, and the first thing that it complains about.
struct TiffSource {
  const std::string& bytes;
  uint64_t at = 0;
  std::string why;
};

TiffSource& source_of(thandle_t handle) { return *static_cast<TiffSource*>(handle); }

tmsize_t read_some(thandle_t handle, void* to, tmsize_t count) {
  TiffSource& source = source_of(handle);
  if (source.at >= source.bytes.size()) return 0;
  const size_t got = std::min(size_t(count), source.bytes.size() - size_t(source.at));
  std::memcpy(to, source.bytes.data() + source.at, got);
  source.at += got;
  return tmsize_t(got);
}
tmsize_t write_none(thandle_t, void*, tmsize_t) { return 0; }
toff_t seek(thandle_t handle, toff_t offset, int whence) {
  TiffSource& source = source_of(handle);
  const uint64_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? source.at : source.bytes.size();
  return source.at = from + offset;
}
int close_none(thandle_t) { return 0; }
toff_t size_of(thandle_t handle) { return source_of(handle).bytes.size(); }

int keep_complaint(TIFF*, void* source, const char*, const char* format, va_list arguments) {
  char text[256];
  std::vsnprintf(text, sizeof text, format, arguments);
  std::string& why = static_cast<TiffSource*>(source)->why;
  if (why.empty()) why = printable(text);
  return 1;
}
int ignore_complaint(TIFF*, void*, const char*, const char*, va_list) { return 1; }

using OpenTiff = std::unique_ptr<TIFF, void (*)(TIFF*)>;

OpenTiff open_tiff(TiffSource& source, const std::string& name) {
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options, keep_complaint, &source);
  TIFFOpenOptionsSetWarningHandlerExtR(options, ignore_complaint, nullptr);
  // "m": libtiff does not map the file, "h": it reads no directory by itself before it has to
  OpenTiff tiff(TIFFClientOpenExt(name.c_str(), "rm", &source, read_some, write_none, seek, close_none, size_of,
                                  nullptr, nullptr, options),
                TIFFClose);
  TIFFOpenOptionsFree(options);
  return tiff;
}

template <typename Number>
Number field(TIFF* tiff, uint32_t tag) {
  Number value = 0;
  TIFFGetFieldDefaulted(tiff, tag, &value);
  return value;
}

/// What a file says of its image.
struct TiffImage {
  size_t width = 0, height = 0, components = 0, bytes = 0;  ///< bytes: of a value
  char kind = 'u';
  bool is_planar = false;
};

/// Copies rows of one block, whose pixels have `components` values beginning at `component`, into the array.
void place(const unsigned char* from, size_t from_row, size_t x0, size_t y0, size_t columns, size_t rows,
           size_t component, size_t components, const TiffImage& image, StoredArray& array) {
  for (size_t y = 0; y < rows; ++y) {
    for (size_t x = 0; x < columns; ++x) {
      const size_t pixel = (y0 + y) * image.width + x0 + x;
      std::memcpy(array.values.data() + (pixel * image.components + component) * image.bytes,
                  from + y * from_row + x * components * image.bytes, components * image.bytes);
    }
  }
}

bool read_tiles(TIFF* tiff, const TiffImage& image, StoredArray& array) {
  const size_t width = field<uint32_t>(tiff, TIFFTAG_TILEWIDTH), height = field<uint32_t>(tiff, TIFFTAG_TILELENGTH);
  const size_t planes = image.is_planar ? image.components : 1, per_pixel = image.is_planar ? 1 : image.components;
  const size_t row = width * per_pixel * image.bytes, size = size_t(std::max<tmsize_t>(TIFFTileSize(tiff), 0));
  // Tiles may reach beyond the image, but none is larger than all of it by more than a tile's usual size.
  if (width == 0 || height == 0 || size != row * height || width > image.width + 4096 || height > image.height + 4096)
    return false;
  std::vector<unsigned char> tile(size);
  for (size_t plane = 0; plane < planes; ++plane) {
    for (size_t y = 0; y < image.height; y += height) {
      for (size_t x = 0; x < image.width; x += width) {
        const uint32_t number = TIFFComputeTile(tiff, uint32_t(x), uint32_t(y), 0, uint16_t(plane));
        if (TIFFReadEncodedTile(tiff, number, tile.data(), tmsize_t(size)) < 0) return false;
        place(tile.data(), row, x, y, std::min(width, image.width - x), std::min(height, image.height - y), plane,
              per_pixel, image, array);
      }
    }
  }
  return true;
}

bool read_strips(TIFF* tiff, const TiffImage& image, StoredArray& array) {
  const size_t planes = image.is_planar ? image.components : 1, per_pixel = image.is_planar ? 1 : image.components;
  const size_t row = image.width * per_pixel * image.bytes;
  if (size_t(std::max<tmsize_t>(TIFFScanlineSize(tiff), 0)) != row) return false;
  std::vector<unsigned char> line(row);
  for (size_t plane = 0; plane < planes; ++plane) {
    for (size_t y = 0; y < image.height; ++y) {
      if (TIFFReadScanline(tiff, line.data(), uint32_t(y), uint16_t(plane)) < 0) return false;
      place(line.data(), row, 0, y, image.width, 1, plane, per_pixel, image, array);
    }
  }
  return true;
}

TiffImage image_in(TIFF* tiff, const std::string& name, long long most_pixels) {
  TiffImage image;
  image.width = field<uint32_t>(tiff, TIFFTAG_IMAGEWIDTH);
  image.height = field<uint32_t>(tiff, TIFFTAG_IMAGELENGTH);
  image.components = field<uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL);
  image.is_planar = field<uint16_t>(tiff, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE;
  const uint16_t bits = field<uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE),
                 format = field<uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT);
  image.kind = format == SAMPLEFORMAT_IEEEFP ? 'f' : format == SAMPLEFORMAT_INT ? 'i' : 'u';
  image.bytes = bits / 8u;
  if (bits % 8 != 0 || !is_known_type(image.kind, image.bytes) || image.components < 1 || image.components > 4)
    throw Error("{}: has {} components of {} bits; 1 to 4 are read, of 8, 16, 32 or 64 bits", name, image.components,
                bits);
  const uint16_t colours = field<uint16_t>(tiff, TIFFTAG_PHOTOMETRIC),
                 turn = field<uint16_t>(tiff, TIFFTAG_ORIENTATION);
  if (colours != PHOTOMETRIC_MINISBLACK && colours != PHOTOMETRIC_RGB)
    throw Error(
        "{}: its photometric interpretation is {}; 1 (black is 0) and 2 (RGB) are read, so save it as one of them",
        name, colours);
  if (turn != ORIENTATION_TOPLEFT)
    throw Error("{}: its orientation is {}; 1 (from the top left) is read, so save it upright", name, turn);
  if (format != SAMPLEFORMAT_UINT && format != SAMPLEFORMAT_INT && format != SAMPLEFORMAT_IEEEFP)
    throw Error("{}: its sample format is {}; 1 (whole), 2 (signed) and 3 (floating point) are read", name, format);
  check_image_size(image.width, image.height, name, most_pixels);
  return image;
}

}  // namespace

ImageValues image_of_tiff(const std::string& bytes, const std::string& name, long long most_pixels) {
  TiffSource source{bytes, 0, {}};
  const OpenTiff tiff = open_tiff(source, name);
  const auto refuse = [&] {
    return Error("{}: cannot be read as TIFF: {}", name, source.why.empty() ? "it is damaged" : source.why);
  };
  if (!tiff) throw refuse();
  const TiffImage image = image_in(tiff.get(), name, most_pixels);
  StoredArray array;
  array.kind = image.kind;
  array.bytes = image.bytes;
  array.shape = {image.height, image.width, image.components};
  // No code of TIFF makes a million bytes of one.
  const size_t size = image.width * image.height * image.components * image.bytes;
  if (size / (1 << 20) > bytes.size()) throw refuse();
  array.values.resize(size);
  if (!(TIFFIsTiled(tiff.get()) ? read_tiles(tiff.get(), image, array) : read_strips(tiff.get(), image, array)))
    throw refuse();
  return image_of(array, name, most_pixels);
}

}  // namespace gloam
