// A pose moved and turned along its own axes, to place further cameras beside a first one.
#pragma once

#include <cmath>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "gloam/camera.h"

namespace gloam {

/// A turn about the y axis; positive takes z towards x.
inline glm::dmat3 turn(double degrees) {
  const double cosine = std::cos(glm::radians(degrees)), sine = std::sin(glm::radians(degrees));
  return {glm::dvec3(cosine, 0, -sine), glm::dvec3(0, 1, 0), glm::dvec3(sine, 0, cosine)};
}

/// `pose` moved to `place`, along its own axes (x to the right, y up, z backwards; scene units), and turned there about its y
/// axis by `degrees`; positive: to the left.
inline Pose moved(const Pose& pose, const glm::dvec3& place, double degrees) {
  return {glm::transpose(turn(degrees)) * pose.world_to_view,
          pose.position + glm::transpose(pose.world_to_view) * place};
}

}  // namespace gloam
