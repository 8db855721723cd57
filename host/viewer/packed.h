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

/// The pixels that are taken of a channel: every `step`-th of every `step`-th row.
struct Grid {
  int x0 = 0, y0 = 0;  ///< the first pixel
  int width = 0, height = 0, step = 1;
  size_t pixels() const { return size_t(width) * size_t(height); }
};

/// The pixels of `whole` that are multiples of `step` from its corner and lie in `part`; the first one of `part` if there is none.
Grid grid_of(const Window& part, const Window& whole, int step);

/// `half`: rounded to half.
Packed packed(const Channel& channel, const Grid& grid, bool half);

/// Whether a channel may be rounded to half: no finite value is beyond its range.
bool fits_half(const Channel& channel);

/// Pixels that are background, 1, and others, 0, one byte each, as a zlib stream in base64.
std::string packed_background(const Channel& depth, const Grid& grid);

}  // namespace gloam::viewer
