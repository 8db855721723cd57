#include "image/float_pictures.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "gloam/error.h"

namespace gloam {
namespace {

/// The next word of a header, and the place after it. Empty at the end.
std::string next_word(const std::string& bytes, size_t& at) {
  constexpr size_t longest = 40;
  constexpr const char* blanks = " \t\r\n";
  const size_t begin = bytes.find_first_not_of(blanks, at);
  if (begin == std::string::npos) return "";
  const size_t end = std::min(bytes.find_first_of(blanks, begin), bytes.size());
  at = end;
  return end - begin > longest ? "" : bytes.substr(begin, end - begin);
}

}  // namespace

ImageValues image_of_pfm(const std::string& bytes, const std::string& name, long long most_pixels) {
  size_t at = 0;
  const std::string kind = next_word(bytes, at);
  const long long width = std::atoll(next_word(bytes, at).c_str()), height = std::atoll(next_word(bytes, at).c_str());
  const double scale = std::atof(next_word(bytes, at).c_str());
  if ((kind != "PF" && kind != "Pf") || scale == 0 || !std::isfinite(scale))
    throw Error("{}: cannot be read as PFM: its header is damaged", name);
  check_image_size((unsigned long long)std::max(width, 0ll), (unsigned long long)std::max(height, 0ll), name,
                   most_pixels);
  const size_t components = kind == "PF" ? 3 : 1, begin = at + 1, row_bytes = size_t(width) * components * 4;
  if (begin > bytes.size() || (bytes.size() - begin) / row_bytes < size_t(height))
    throw Error("{}: cannot be read as PFM: it ends too early", name);
  ImageValues image;
  image.type = "float32";
  for (size_t c = 0; c < components; ++c) image.channels.emplace_back(Layout(int(width), int(height)), 0.0f);
  for (int y = 0; y < int(height); ++y) {
    const char* from = bytes.data() + begin + size_t(height - 1 - y) * row_bytes;
    for (int x = 0; x < int(width); ++x) {
      for (Channel& channel : image.channels) {
        uint32_t bits;
        std::memcpy(&bits, from, 4);
        from += 4;
        channel.at(x, y) = std::bit_cast<float>(scale > 0 ? __builtin_bswap32(bits) : bits);
      }
    }
  }
  return image;
}

namespace {

[[noreturn]] void refuse_picture(const std::string& name, const char* why) {
  throw Error("{}: cannot be read as Radiance HDR: {}", name, why);
}

/// Whether rows of this width may be run-length encoded.
bool has_runs(size_t width) { return width >= 8 && width < 32768; }

/// One row of pixels of red, green, blue and exponent, component by component; returns the place after it.
size_t decode_row(const std::string& bytes, size_t at, size_t width, std::vector<unsigned char>& row,
                  const std::string& name) {
  const auto byte = [&](size_t i) {
    if (i >= bytes.size()) refuse_picture(name, "it ends too early");
    return (unsigned char)bytes[i];
  };
  const bool is_encoded = has_runs(width) && byte(at) == 2 && byte(at + 1) == 2 && byte(at + 2) < 128;
  if (!is_encoded) {
    for (size_t x = 0; x < width; ++x)
      for (size_t c = 0; c < 4; ++c) row[c * width + x] = byte(at++);
    return at;
  }
  if ((size_t(byte(at + 2)) << 8 | byte(at + 3)) != width) refuse_picture(name, "a row has another width");
  at += 4;
  for (size_t c = 0; c < 4; ++c) {
    for (size_t x = 0; x < width;) {
      size_t count = byte(at++);
      const bool is_run = count > 128;
      if (is_run) count -= 128;
      if (count == 0 || count > width - x) refuse_picture(name, "a row is damaged");
      for (size_t i = 0; i < count; ++i, ++x) row[c * width + x] = byte(is_run ? at : at++);
      if (is_run) ++at;
    }
  }
  return at;
}

}  // namespace

ImageValues image_of_hdr(const std::string& bytes, const std::string& name, long long most_pixels) {
  const size_t blank = bytes.find("\n\n");
  if (!bytes.starts_with("#?") || blank == std::string::npos) refuse_picture(name, "its header is damaged");
  size_t at = blank + 2;
  const std::string down = next_word(bytes, at);
  const long long height = std::atoll(next_word(bytes, at).c_str());
  const std::string right = next_word(bytes, at);
  const long long width = std::atoll(next_word(bytes, at).c_str());
  if (bytes.substr(0, blank).find("xyze") != std::string::npos)
    refuse_picture(name, "its colours are XYZ, not red, green and blue");
  if (down != "-Y" || right != "+X") refuse_picture(name, "its rows do not run from the top left");
  check_image_size((unsigned long long)std::max(width, 0ll), (unsigned long long)std::max(height, 0ll), name,
                   most_pixels);
  ++at;
  // A run of 127 pixels takes two bytes; rows without runs four a pixel.
  const unsigned long long pixels = (unsigned long long)width * (unsigned long long)height;
  if ((has_runs(size_t(width)) ? pixels / 64 : 4 * pixels) > bytes.size()) refuse_picture(name, "it ends too early");
  ImageValues image;
  image.type = "shared exponent";
  for (int c = 0; c < 3; ++c) image.channels.emplace_back(Layout(int(width), int(height)), 0.0f);
  std::vector<unsigned char> row(4 * size_t(width));
  for (int y = 0; y < int(height); ++y) {
    at = decode_row(bytes, at, size_t(width), row, name);
    for (int x = 0; x < int(width); ++x) {
      const int exponent = row[3 * size_t(width) + size_t(x)];
      for (size_t c = 0; c < 3; ++c) {
        const double mantissa = row[c * size_t(width) + size_t(x)];
        image.channels[c].at(x, y) = exponent == 0 ? 0.0f : float(std::ldexp(mantissa + 0.5, exponent - 136));
      }
    }
  }
  return image;
}

}  // namespace gloam
