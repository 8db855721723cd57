#include "scene/cosine_rays.h"

#include <glm/geometric.hpp>

#include "base/low_discrepancy.h"

namespace gloam {

CosineRays cosine_rays(const Site& site, uint32_t seed, int first) {
  CosineRays rays;
  for (int i = 0; i < rays_per_packet; ++i) {
    const glm::dvec3 local = cosine_direction(scrambled_sobol(uint32_t(first + i), seed));
    const glm::vec3 direction(site.to_world * local);
    if (glm::dot(direction, site.facing) <= 0) {
      rays.cosines_below[rays.count_below++] = float(local.z);
      continue;
    }
    rays.cosines[rays.count] = float(local.z);
    rays.directions[rays.count++] = direction;
  }
  return rays;
}

}  // namespace gloam
