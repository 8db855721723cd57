// A hash of 32 bits, the same text for kernels and host: lowbias32 (Wellons 2018).
#ifndef GLOAM_HASH_H
#define GLOAM_HASH_H

#ifdef __OPENCL_C_VERSION__
#include "shared/lanes/lanes.h"
#define SHARED_FUNCTION static inline
#else
#include <cstdint>
#define SHARED_FUNCTION inline
namespace gloam {
using natural = std::uint32_t;
#endif

SHARED_FUNCTION natural hash_of(natural h) {
  h ^= h >> 16;
  h *= 0x7feb352du;
  h ^= h >> 15;
  h *= 0x846ca68bu;
  return h ^ (h >> 16);
}

#ifndef __OPENCL_C_VERSION__
}  // namespace gloam
#endif
#endif
