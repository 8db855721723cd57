// Images of floats, packed for a page: every bit comes back in the browser (data.js).
#pragma once

#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam::viewer {

/// What a page says of the values of a channel.
struct ChannelFacts {
  long long nan = 0, infinite = 0, minus_infinite = 0;  ///< pixels
  long long negative = 0;                               ///< pixels below 0, infinite ones left out
  double least = 0, most = 0;                           ///< of finite values
  bool has_finite = false;
};

/// An image as text. The values, read as integers (the bits of floats, or of halves), are predicted from the pixel to the left (at
/// the left border from the one above), differences are folded (0, -1, 1, -2 ... are 0, 1, 2, 3 ...) and split into planes of their
/// bytes, the lowest first. All of it is a zlib stream in base64.
struct Packed {
  std::string text;
  bool is_half = false;
  ChannelFacts facts;  ///< of the values that are packed
};

/// Every `step`-th pixel of every `step`-th row, beginning with the first. `half`: rounded to half.
Packed packed(const Channel& channel, int step, bool half);

/// Whether a channel may be rounded to half: no finite value is beyond its range.
bool fits_half(const Channel& channel);

/// The same of pixels that are 0 or 1, one byte each. `is_one(x, y)` is asked of the pixels taken.
template <typename IsOne>
std::string packed_mask(const Layout& layout, int step, const IsOne& is_one);

/// A zlib stream in base64.
std::string deflated(const std::vector<unsigned char>& bytes);

template <typename IsOne>
std::string packed_mask(const Layout& layout, int step, const IsOne& is_one) {
  std::vector<unsigned char> bytes;
  for (int y = 0; y < layout.height; y += step)
    for (int x = 0; x < layout.width; x += step) bytes.push_back(is_one(x, y) ? 1 : 0);
  return deflated(bytes);
}

}  // namespace gloam::viewer
