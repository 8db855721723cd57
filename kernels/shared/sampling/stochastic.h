// Which samples of a stochastic depth map are offered a surface (Vermeer, Scandolo, Eisemann 2021, equation 1 and Algorithm 1).
// Kernels and the host, which captures scenes, share this text: the same bits.
//
// Of S samples R = floor(alpha S + xi) are offered a surface, and each keeps the nearest that it was offered. The paper looks the
// subset up in a table. Here R is halved over halves of the samples, an odd one going to either half at random, down to single
// samples. A half gets floor(alpha S/2 + xi') again, so the first 1, 2, 4 and 8 of 16 samples each are a stratified map.
#ifndef GLOAM_STOCHASTIC_H
#define GLOAM_STOCHASTIC_H

#define STOCHASTIC_MOST 16

#include "shared/lanes/hash.h"

#ifndef __OPENCL_C_VERSION__
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
SHARED_FUNCTION natural stratified_subset(natural hash, natural alpha) {
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
