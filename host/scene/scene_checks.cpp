#include "scene/scene_checks.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/files.h"
#include "gloam/error.h"

namespace gloam {
namespace {

using glm::vec3;

std::string in_words(const vec3& v) { return fmt::format("{:g}, {:g}, {:g}", v.x, v.y, v.z); }

template <typename Fits>
bool all(const vec3& v, const Fits& fits) {
  return fits(v.x) && fits(v.y) && fits(v.z);
}

/// Checks one light. Returns whether it gives any.
bool gives_light(const Scene& scene, const std::string& what, const vec3& light) {
  if (!all(light, [](float x) { return x >= 0 && std::isfinite(x); }))
    throw Error("{}: {} is {}; finite numbers from 0 on are allowed", scene.name, what, in_words(light));
  return light != vec3(0);
}

}  // namespace

std::string in_words(const glm::dvec3& v) { return fmt::format("{:g},{:g},{:g}", v.x, v.y, v.z); }

void check_albedo(const Scene& scene) {
  for (const Material& material : scene.materials) {
    if (all(material.albedo, [](float x) { return x >= 0 && x <= 1; })) continue;
    throw Error("{}: material '{}' has the albedo {}; 0 to 1 are allowed, so change the material", scene.name,
                printable(material.name), in_words(material.albedo));
  }
}

void check_sun_direction(const Scene& scene) {
  const float length = glm::length(scene.light.to_sun);
  if (!(length > 0 && std::isfinite(length)))
    throw Error("{}: the direction of the sun is {}; a finite one that is not 0 is allowed", scene.name,
                in_words(scene.light.to_sun));
}

void check_light(const Scene& scene) {
  const Light& light = scene.light;
  const bool has_sun = gives_light(scene, "the light of the sun", light.sun);
  if (has_sun) check_sun_direction(scene);
  bool is_lit = has_sun;
  is_lit |= gives_light(scene, "the light of the zenith", light.zenith);
  is_lit |= gives_light(scene, "the light of the horizon", light.horizon);
  is_lit |= gives_light(scene, "the light of the ground", light.ground);
  for (const Material& material : scene.materials)
    is_lit |=
        gives_light(scene, fmt::format("the emission of material '{}'", printable(material.name)), material.emission);
  if (!is_lit)
    throw Error("{}: has no light: no sun, no sky and no surface that emits any, so that all would be black",
                scene.name);
}

}  // namespace gloam
