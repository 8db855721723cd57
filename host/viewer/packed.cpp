#include "viewer/packed.h"

#include <Imath/half.h>
#include <libdeflate.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>

#include "gloam/error.h"
#include "page/html.h"

namespace gloam::viewer {
namespace {

/// A higher level makes the page a few percent smaller, and takes several times as long.
constexpr int compression_level = 4;

/// Largest finite half, and the least float that is rounded to infinity.
constexpr float first_beyond_half = 65520;

void count(float value, ChannelFacts& facts) {
  if (std::isnan(value)) {
    ++facts.nan;
  } else if (std::isinf(value)) {
    ++(value > 0 ? facts.infinite : facts.minus_infinite);
  } else {
    facts.negative += value < 0;
    facts.least = facts.has_finite ? std::min(facts.least, double(value)) : value;
    facts.most = facts.has_finite ? std::max(facts.most, double(value)) : value;
    facts.has_finite = true;
  }
}

uint32_t bits_of(float value) { return std::bit_cast<uint32_t>(value); }
uint16_t bits_of(Imath::half value) { return value.bits(); }

/// 0, -1, 1, -2 ... become 0, 1, 2, 3 ...
template <typename Bits>
Bits folded(Bits difference) {
  using Signed = std::make_signed_t<Bits>;
  return Bits(Bits(difference << 1) ^ Bits(Signed(difference) >> (8 * int(sizeof(Bits)) - 1)));
}

/// The planes of bytes, the lowest first. `Value`: float or half.
template <typename Value>
std::vector<unsigned char> byte_planes(const Channel& channel, const Grid& grid, ChannelFacts& facts) {
  using Bits = decltype(bits_of(Value(0.0f)));
  const size_t pixels = grid.pixels();
  std::vector<unsigned char> bytes(pixels * sizeof(Bits));
  Bits above = 0;
  size_t i = 0;
  for (int y = 0; y < grid.height; ++y) {
    const float* row = channel.row(grid.y0 + y * grid.step) + grid.x0;
    Bits before = above;
    for (int x = 0; x < grid.width; ++x, ++i) {
      const Value value = Value(row[x * grid.step]);
      count(float(value), facts);
      const Bits bits = bits_of(value), difference = folded(Bits(bits - before));
      for (size_t k = 0; k < sizeof(Bits); ++k) bytes[k * pixels + i] = (unsigned char)(difference >> (8 * k));
      before = bits;
      if (x == 0) above = bits;
    }
  }
  return bytes;
}

/// A zlib stream in base64.
std::string deflated(const std::vector<unsigned char>& bytes) {
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(compression_level), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string stream(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  stream.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), stream.data(), stream.size()));
  return page::base64(stream);
}

/// From the corner of `whole` to the first pixel taken at or after `start`, and how many there are before `end`.
std::pair<int, int> taken(int start, int end, int step) {
  const int first = (start + step - 1) / step * step;
  return first < end ? std::pair(first, (end - first + step - 1) / step) : std::pair(start, 1);
}

}  // namespace

Grid grid_of(const Window& part, const Window& whole, int step) {
  const auto [x0, width] = taken(part.x0 - whole.x0, part.x1 - whole.x0, step);
  const auto [y0, height] = taken(part.y0 - whole.y0, part.y1 - whole.y0, step);
  return {x0, y0, width, height, step};
}

Packed packed(const Channel& channel, const Grid& grid, bool half) {
  Packed result;
  result.is_half = half;
  result.text = deflated(half ? byte_planes<Imath::half>(channel, grid, result.facts)
                              : byte_planes<float>(channel, grid, result.facts));
  return result;
}

std::string packed_background(const Channel& depth, const Grid& grid) {
  std::vector<unsigned char> bytes(grid.pixels());
  for (size_t i = 0; i < bytes.size(); ++i) {
    const int x = int(i) % grid.width, y = int(i) / grid.width;
    bytes[i] = is_background(depth.at(grid.x0 + x * grid.step, grid.y0 + y * grid.step)) ? 1 : 0;
  }
  return deflated(bytes);
}

bool fits_half(const Channel& channel) {
  for (int y = 0; y < channel.layout().height; ++y)
    for (int x = 0; x < channel.layout().width; ++x) {
      const float size = std::abs(channel.at(x, y));
      if (size >= first_beyond_half && !std::isinf(size)) return false;
    }
  return true;
}

}  // namespace gloam::viewer
