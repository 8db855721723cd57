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

/// A higher level gains a few percent and takes several times as long.
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
std::vector<unsigned char> byte_planes(const Channel& channel, const Layout& size, int step, ChannelFacts& facts) {
  using Bits = decltype(bits_of(Value(0.0f)));
  const size_t pixels = size_t(size.width) * size_t(size.height);
  std::vector<unsigned char> bytes(pixels * sizeof(Bits));
  Bits above = 0;
  size_t i = 0;
  for (int y = 0; y < size.height; ++y) {
    const float* row = channel.row(y * step);
    Bits before = above;
    for (int x = 0; x < size.width; ++x, ++i) {
      const Value value = Value(row[x * step]);
      count(float(value), facts);
      const Bits bits = bits_of(value), difference = folded(Bits(bits - before));
      for (size_t k = 0; k < sizeof(Bits); ++k) bytes[k * pixels + i] = (unsigned char)(difference >> (8 * k));
      before = bits;
      if (x == 0) above = bits;
    }
  }
  return bytes;
}

}  // namespace

Packed packed(const Channel& channel, int step, bool half) {
  const Layout size = reduced(channel.layout(), step);
  Packed result;
  result.is_half = half;
  result.text = deflated(half ? byte_planes<Imath::half>(channel, size, step, result.facts)
                              : byte_planes<float>(channel, size, step, result.facts));
  return result;
}

bool fits_half(const Channel& channel) {
  for (int y = 0; y < channel.layout().height; ++y)
    for (int x = 0; x < channel.layout().width; ++x) {
      const float size = std::abs(channel.at(x, y));
      if (size >= first_beyond_half && !std::isinf(size)) return false;
    }
  return true;
}

std::string deflated(const std::vector<unsigned char>& bytes) {
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(compression_level), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string stream(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  stream.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), stream.data(), stream.size()));
  return page::base64(stream);
}

}  // namespace gloam::viewer
