#include "image/png_values.h"

#include <png.h>

#include <cerrno>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>

#include "base/file_ledger.h"
#include "base/files.h"
#include "gloam/error.h"
#include "gloam/frame.h"

namespace gloam {
namespace {

/// What libpng decodes into. It leaves by longjmp, over no object with a destructor: all are here.
struct Decoding {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::FILE* file = nullptr;
  std::string why;
  png_uint_32 width = 0, height = 0;
  int bits = 0, channels = 0;
  std::vector<unsigned char> bytes;
  std::vector<png_bytep> rows;
  ~Decoding() {
    if (png) png_destroy_read_struct(&png, &info, nullptr);
    if (file) std::fclose(file);
  }
};

constexpr png_alloc_size_t largest_chunk = 1 << 20;

void keep_reason(png_structp png, png_const_charp text) {
  static_cast<Decoding*>(png_get_error_ptr(png))->why = text;
  png_longjmp(png, 1);
}
void ignore_warning(png_structp, png_const_charp) {}

/// Begins to decode: the size, and which values come. False if it failed.
bool read_header(Decoding& d, PngAlpha alpha) {
  if (setjmp(png_jmpbuf(d.png))) return false;
  png_init_io(d.png, d.file);
  png_read_info(d.png, d.info);
  d.width = png_get_image_width(d.png, d.info);
  d.height = png_get_image_height(d.png, d.info);
  png_set_expand(d.png);  // palettes to colours, grey of few bits to 8
  if (alpha == PngAlpha::left_out) png_set_strip_alpha(d.png);
  png_set_swap(d.png);  // 16 bits to this machine's order of bytes
  png_set_interlace_handling(d.png);
  png_read_update_info(d.png, d.info);
  d.bits = png_get_bit_depth(d.png, d.info);
  d.channels = png_get_channels(d.png, d.info);
  return true;
}

bool read_rows(Decoding& d) {
  if (setjmp(png_jmpbuf(d.png))) return false;
  png_read_image(d.png, d.rows.data());
  png_read_end(d.png, nullptr);
  return true;
}

Channel channel_of(const Decoding& d, int component) {
  Channel channel(Layout(int(d.width), int(d.height)), 0);
  for (int y = 0; y < int(d.height); ++y) {
    const unsigned char* row = d.rows[size_t(y)];
    const auto* wide = reinterpret_cast<const uint16_t*>(row);
    for (int x = 0; x < int(d.width); ++x) {
      const size_t i = size_t(x) * size_t(d.channels) + size_t(component);
      channel.at(x, y) = d.bits == 16 ? float(wide[i]) : float(row[i]);
    }
  }
  return channel;
}

}  // namespace

PngValues read_png_values(const std::filesystem::path& path, const std::function<void(const PngSize&)>& check,
                          PngAlpha alpha) {
  check_regular(path);
  Decoding d;
  const auto refuse = [&]() { return Error("{}: cannot be read as PNG: {}", path.string(), d.why); };
  d.file = std::fopen(path.c_str(), "rb");
  if (!d.file) throw Error("{}: cannot read: {}", path.string(), std::strerror(errno));
  opens_file(path);
  d.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &d, keep_reason, ignore_warning);
  d.info = d.png ? png_create_info_struct(d.png) : nullptr;
  if (d.png) png_set_chunk_malloc_max(d.png, largest_chunk);  // texts and profiles, which a file may have compressed
  if (!d.info) throw Error("{}: cannot be read as PNG: out of memory", path.string());
  if (!read_header(d, alpha)) throw refuse();
  if ((long long)d.width * d.height > max_pixels)
    throw Error("{}: has {}x{} pixels; {} are read at most", path.string(), d.width, d.height, max_pixels);
  const size_t row = png_get_rowbytes(d.png, d.info);
  const unsigned long long decoded = row + size_t(d.channels) * sizeof(float) * d.width;
  if (check) check({int(d.width), int(d.height), decoded * d.height});
  d.bytes.resize(row * d.height);
  for (size_t y = 0; y < d.height; ++y) d.rows.push_back(d.bytes.data() + y * row);
  if (!read_rows(d)) throw refuse();
  PngValues values;
  values.bits = d.bits;
  values.largest = d.bits == 16 ? 65535 : 255;
  for (int i = 0; i < d.channels; ++i) values.channels.push_back(channel_of(d, i));
  return values;
}

}  // namespace gloam
