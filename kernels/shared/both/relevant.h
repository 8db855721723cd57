// Which surfaces of a stochastic depth map are relevant: those that may be within the radius of something visible. Depth is divided
// into slices of one radius, which have one bit each of a whole number; every RELEVANT_SLICES-th slice has the same one. Each tile of
// pixels knows in which slices a tile that reaches it shows something, and the slices beside these. Kernels and the host, which captures
// scenes, share this text: the same bits.
#ifndef GLOAM_RELEVANT_H
#define GLOAM_RELEVANT_H

#define RELEVANT_TILE 8     // pixels, each way
#define RELEVANT_SLICES 24  // as many bits as a float holds in a whole number

#include "shared/both/hash.h"

#ifdef __OPENCL_C_VERSION__
#include "shared/lanes/load.h"  // with frame.h
#else
#include <algorithm>
#include <cmath>
namespace gloam::relevance {

// The words of kernels, for one lane.
using real = float;
using scalar = float;
using std::fabs;
using std::floor;
using std::min;
inline real smaller(real a, real b) { return a < b ? a : b; }
inline real larger(real a, real b) { return a > b ? a : b; }
inline natural to_natural(real x) { return natural(x); }

#define FRAME_SCALAR float
#define FRAME_NAME Frame
#define NEIGHBOUR_NAME Neighbour
#include "shared/both/frame.h"
#undef FRAME_SCALAR
#undef FRAME_NAME
#undef NEIGHBOUR_NAME
#endif

// The bit of the slice of a depth that is not infinite. What is more than a million radii away is in one slice.
SHARED_FUNCTION natural slice_of(real depth, scalar radius) {
  const real slice = floor(smaller(depth * min(1 / radius, (scalar)1e30f), (real)(1e6f)));
  // The product may be rounded down below a whole number: 24 in place of 0.
  const natural bit = (natural)(1u)
                      << to_natural(slice - RELEVANT_SLICES * floor(slice * (scalar)(1.0f / RELEVANT_SLICES)));
  return (bit | bit >> RELEVANT_SLICES) & ((1u << RELEVANT_SLICES) - 1u);
}

// What is within the radius of something lies in the same slice or in one beside it.
SHARED_FUNCTION natural with_slices_beside(natural shown) {
  const natural with = shown | shown << 1 | shown >> 1 | shown << (RELEVANT_SLICES - 1) | shown >> (RELEVANT_SLICES - 1);
  return with & ((1u << RELEVANT_SLICES) - 1u);
}

// How far something in a tile at the depth `nearest` looks for occluders, in tiles. x, y: the tile's middle from the principal point,
// pixels. `most`: cap on the radius on the screen, pixels.
SHARED_FUNCTION real reach_in_tiles(Frame frame, real x, real y, real nearest, scalar radius, scalar most) {
  // Off the axis a ball is longer on the screen than its radius.
  const real stretch = 1 + frame.perspective * (fabs(x) * frame.scale_x + fabs(y) * frame.scale_y);
  const real per_depth = frame.perspective / nearest + frame.parallel;
  const real pixels = smaller(radius / min(frame.scale_x, frame.scale_y) * per_depth, (real)(most));
  // One pixel more, as samples are rounded to pixels.
  return (pixels * stretch + 1) * (1.0f / RELEVANT_TILE);
}

// Tiles whose pixels are closer to each other than the tiles are, in tiles.
SHARED_FUNCTION real gap_between(real tiles) { return larger(fabs(tiles) - 1, (real)(0)); }

#ifndef __OPENCL_C_VERSION__
}  // namespace gloam::relevance
#endif
#endif
