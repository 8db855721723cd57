// Direct light of a scene, as in captured colours.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "gloam/scene/scene.h"
#include "gloam/scene/tracer.h"

namespace gloam {

/// Direct light that leaves a surface, the same in every direction. Scene-linear.
struct Radiance {
  glm::vec3 all;  ///< emission, and diffuse light of the sun (with shadows) and of the sky
  glm::vec3
      ambient;  ///< of `all` the light of the sky: without occlusion, so that ambient occlusion does not count twice
};

/// `seed` picks `sun_rays` points of the sun's disc, at most 16.
inline constexpr int most_sun_rays = 16;
Radiance radiance(const Tracer& tracer, const Surface& surface, uint32_t seed, int sun_rays = most_sun_rays);

/// Radiance of the sky, for rays that meet nothing.
glm::vec3 sky_radiance(const Scene& scene, const glm::dvec3& direction);

}  // namespace gloam
