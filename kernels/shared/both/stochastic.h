// Which samples of a stochastic depth map are offered a surface (Vermeer, Scandolo, Eisemann 2021, equation 1 and Algorithm 1).
// Kernels and the host, which captures scenes, share this text: the same bits.
//
// Of S samples R = floor(alpha S + xi) are offered a surface, and each keeps the nearest that it was offered. The paper looks the
// subset up in a table. Here R of 16 is halved over halves of the samples, an odd one going to either half at random, down to
// single samples. A half gets floor(alpha S/2 + xi') again, so the first 1, 2, 4 and 8 of 16 samples each are a stratified map.
// Where S is no power of two, the samples after the largest power of two below S are decided one after another, each by how many
// before it were offered the surface: the first n are floor(alpha n + xi') for every n.
#ifndef GLOAM_STOCHASTIC_H
#define GLOAM_STOCHASTIC_H

#define STOCHASTIC_MOST 16

#include "shared/both/hash.h"

#ifdef __OPENCL_C_VERSION__
#define UPPER_PRODUCT(a, b) mul_hi(a, b)
#define COUNT_OF_BITS(bits) popcount(bits)
#else
#include <bit>
// a b / 2^32, rounded down.
#define UPPER_PRODUCT(a, b) natural(std::uint64_t(a) * (b) >> 32)
#define COUNT_OF_BITS(bits) natural(std::popcount(bits))
namespace gloam {
#endif

// Hash of a surface under a pixel, from the bits of its depth as float and of the nearest surface's. The exponent is relative to
// the nearest surface's, so that the unit of the scene does not matter.
SHARED_FUNCTION natural surface_hash(natural x, natural y, natural seed, natural depth_bits, natural first_bits) {
  const natural depth = depth_bits - (first_bits & 0x7f800000u);
  return hash_of(depth + hash_of(x + hash_of(y + hash_of(seed))));
}

// alpha in units of 2^-24.
#define STOCHASTIC_ONE 0x1000000u

// Bit j: sample j of 16 is offered the surface. `alpha`: 0 to 2^24.
SHARED_FUNCTION natural halved_subset(natural hash, natural alpha) {
  // floor(16 alpha + xi), xi with 24 bits.
  const natural count = (alpha * 16u + (hash >> 8)) >> 24;
  natural coins = hash_of(hash + 0x9e3779b9u);
  // Counts of the halves, then quarters ..., side by side in fields of one word: 1 field of 16 samples, 2 of 8, 4 of 4, 8 of 2.
  natural first = (count + (coins & 1u)) >> 1;
  natural fields = first | (count - first) << 16;
  coins >>= 1;
  first = (fields + ((coins & 1u) | (coins & 2u) << 15)) >> 1 & 0x00070007u;
  fields = first | (fields - first) << 8;
  coins >>= 2;
  first = (fields + ((coins & 1u) | (coins & 2u) << 7 | (coins & 4u) << 14 | (coins & 8u) << 21)) >> 1 & 0x03030303u;
  fields = first | (fields - first) << 4;
  coins >>= 4;
  first = (fields + ((coins & 1u) | (coins & 2u) << 3 | (coins & 4u) << 6 | (coins & 8u) << 9 | (coins & 16u) << 12 |
                     (coins & 32u) << 15 | (coins & 64u) << 18 | (coins & 128u) << 21)) >>
              1 &
          0x11111111u;
  fields = first | (fields - first) << 2;
  // Eight pairs of single samples, two bits apart: sample 2k at bit 4k, 2k + 1 at bit 4k + 2.
  fields = (fields | fields >> 1) & 0x33333333u;
  fields = (fields | fields >> 2) & 0x0f0f0f0fu;
  fields = (fields | fields >> 4) & 0x00ff00ffu;
  return (fields | fields >> 8) & 0xffffu;
}

// 1 where sample n, counted from 0, is offered the surface, as `count` of the n samples before it were: floor(alpha n + xi) for a
// random xi. Then `count` with this sample is floor(alpha (n + 1) + xi').
SHARED_FUNCTION natural next_bit(natural hash, natural alpha, unsigned int n, natural count) {
  const natural one = STOCHASTIC_ONE, part = (alpha * n) & (one - 1u), left = one - part;
  // 1 where `count` is alpha n rounded up, which has the probability `part` (in 2^-24); rounded down it has `left`.
  const natural is_up = count - ((alpha * n) >> 24), of_count = left + is_up * (part - left);
  // The probability of such a count with this sample offered the surface: alpha in all, for counts rounded down as far as there is
  // room, for those rounded up the rest.
  const natural if_down = alpha < left ? alpha : left, if_up = alpha - if_down,
                of_both = if_down + is_up * (if_up - if_down);
  // A random number below of_both / of_count: the difference borrows from bit 31.
  return (UPPER_PRODUCT(hash_of(hash + n * 0x9e3779b9u), of_count) - of_both) >> 31;
}

// Bit j: sample j of `samples` is offered the surface.
SHARED_FUNCTION natural stratified_subset(natural hash, natural alpha, unsigned int samples) {
  unsigned int halved = 1u;
  while (2u * halved <= samples) halved *= 2u;
  natural subset = halved_subset(hash, alpha) & ((1u << halved) - 1u), count = COUNT_OF_BITS(subset);
  for (unsigned int n = halved; n < samples; ++n) {
    const natural bit = next_bit(hash, alpha, n, count);
    subset |= bit << n;
    count += bit;
  }
  return subset;
}

// 1 where sample `sample` is offered the surface, each sample by a random number of its own.
SHARED_FUNCTION natural hashed_bit(natural hash, natural sample, natural alpha) {
  const natural u = hash_of(hash + sample * 0x9e3779b9u) >> 8;
  // u < alpha: the difference borrows from bit 31.
  return (u - alpha) >> 31;
}

#ifndef __OPENCL_C_VERSION__
}  // namespace gloam
#endif
#endif
