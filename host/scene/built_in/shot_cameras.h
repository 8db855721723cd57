// Cameras of the built-in shots.
#pragma once

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "gloam/scene/scene.h"

namespace gloam::scenes {

/// A camera on rails: it goes by `per_second` and looks past `target`, always in the same direction.
inline SceneCamera dolly(const std::string& name, const glm::dvec3& eye, const glm::dvec3& target,
                         const glm::dvec3& per_second, double fov_degrees, double seconds) {
  return looking_at(name, eye + seconds * per_second, target + seconds * per_second, fov_degrees);
}

/// A camera that circles `target`, counter-clockwise as seen from above, and looks at it.
inline SceneCamera orbit(const std::string& name, const glm::dvec3& eye, const glm::dvec3& target,
                         double degrees_per_second, double fov_degrees, double seconds) {
  const double angle = glm::radians(degrees_per_second * seconds), c = std::cos(angle), s = std::sin(angle);
  const glm::dvec3 arm = eye - target;
  return looking_at(name, target + glm::dvec3(c * arm.x + s * arm.z, arm.y, c * arm.z - s * arm.x), target,
                    fov_degrees);
}

/// A camera in the hands of someone who walks by `per_second` towards `target`, while the look wanders over to `last_target`
/// in `turn_seconds`: it rises with each of two steps a second, sways from foot to foot, and is never quite level.
inline SceneCamera walk(const std::string& name, const glm::dvec3& eye, const glm::dvec3& target,
                        const glm::dvec3& last_target, double turn_seconds, const glm::dvec3& per_second,
                        double fov_degrees, double seconds) {
  const double stride = glm::two_pi<double>() * seconds;  // a step with either foot
  const glm::dvec3 right = glm::normalize(glm::cross(per_second, glm::dvec3(0, 1, 0)));
  const glm::dvec3 at = eye + seconds * per_second + 0.012 * std::sin(stride) * right +
                        glm::dvec3(0, 0.012 * std::sin(2 * stride + 0.4), 0);
  const double turned = glm::smoothstep(0.0, turn_seconds, seconds);
  const glm::dvec3 look = glm::mix(target, last_target, turned) + 0.05 * std::sin(0.9 * stride + 1) * right +
                          glm::dvec3(0, 0.04 * std::sin(1.3 * stride), 0);
  return looking_at(name, at, look, fov_degrees, glm::dvec3(0, 1, 0) + 0.012 * std::sin(0.7 * stride + 2) * right);
}

}  // namespace gloam::scenes
