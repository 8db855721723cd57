// Cosine-weighted directions about a pixel's normal, in packets: what references of occlusion and of diffuse light share.
#pragma once

#include <cstdint>

#include "scene/reference_rows.h"

namespace gloam {

/// A packet of directions. Those below the surface's own triangle are closed, and only counted.
struct CosineRays {
  glm::vec3 directions[rays_per_packet];  ///< world, above the surface
  float cosines[rays_per_packet];         ///< of `directions`, to the normal
  int count = 0;                          ///< of `directions`
  float cosines_below[rays_per_packet];
  int count_below = 0;
};

/// Directions `first` to `first + rays_per_packet - 1` of the set with this seed.
CosineRays cosine_rays(const Site& site, uint32_t seed, int first);

}  // namespace gloam
