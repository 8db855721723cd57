#include "gloam/scene/radiance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "base/low_discrepancy.h"

namespace gloam {

using glm::dvec3;
using glm::vec3;

vec3 sky_radiance(const Scene& scene, const dvec3& direction) {
  const Light& light = scene.light;
  const float height = float(glm::dot(glm::normalize(direction), glm::normalize(scene.up)));
  if (height < 0) return glm::mix(light.horizon, light.ground, std::min(-4 * height, 1.0f));
  return glm::mix(light.horizon, light.zenith, std::sqrt(height));
}

Radiance radiance(const Tracer& tracer, const Surface& surface, uint32_t seed, int sun_rays) {
  const Scene& scene = tracer.scene();
  const Light& light = scene.light;
  const SurfaceMaterial material = tracer.material(surface);
  const vec3 diffuse = material.albedo * (1 - material.metallic);
  // The sky as a blend of its zenith and the ground, by how far the surface faces up.
  const float facing_up = 0.5f + 0.5f * float(glm::dot(surface.normal, glm::normalize(scene.up)));
  const vec3 of_sky = glm::pi<float>() * glm::mix(light.ground, 0.5f * (light.zenith + light.horizon), facing_up);
  vec3 irradiance = of_sky;
  const dvec3 to_sun = glm::normalize(dvec3(light.to_sun));
  if (light.sun != vec3(0) && glm::dot(to_sun, surface.normal) > -0.1) {
    vec3 directions[most_sun_rays];
    bool blocked[most_sun_rays];
    const glm::dmat3 about = frame_about(to_sun);
    const double disc = std::tan(light.sun_angle_degrees * glm::pi<double>() / 180);
    for (int i = 0; i < sun_rays; ++i) {
      const glm::dvec2 u = scrambled_sobol(uint32_t(i), hash(seed));
      const double radius = disc * std::sqrt(u.x), angle = glm::two_pi<double>() * u.y;
      directions[i] = vec3(glm::normalize(about * dvec3(radius * std::cos(angle), radius * std::sin(angle), 1.0)));
    }
    tracer.blocked(tracer.lifted(surface), directions, sun_rays, std::numeric_limits<float>::infinity(), blocked);
    float cosines = 0;
    for (int i = 0; i < sun_rays; ++i) {
      const vec3& d = directions[i];
      if (blocked[i] || glm::dot(d, vec3(surface.facing)) <= 0) continue;
      cosines += std::max(glm::dot(d, vec3(surface.normal)), 0.0f);
    }
    irradiance += light.sun * (cosines / float(sun_rays));
  }
  return {material.emission + diffuse * irradiance / glm::pi<float>(), diffuse * of_sky / glm::pi<float>()};
}

}  // namespace gloam
