// Scenes of a few surfaces in closed form, in addition to those of frames.h, and their depths.
#pragma once

#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include "stress/frames.h"

namespace gloam::stress {

glm::dvec3 point_at(const EyeRay& ray, double depth);

/// Depth at the centre of a pixel, rounded to float; +inf if nothing is seen.
float depth_at(const Shot& shot, const Scene& scene, int x, int y);

/// The nearest surface of several scenes.
Scene nearest_of(const std::vector<Scene>& scenes);

/// A ball in view space.
Scene ball(const glm::dvec3& centre, double radius);

/// Two walls that meet in a line across the image at depth 4: the lower one turned away from the eye by 45 degrees, the
/// upper one by `tilt`, radians. By default a right angle.
Scene corner(double tilt = std::numbers::pi / 4);

/// For an orthographic eye: a wall at depth 4 on the left (x < 0), and one nearer by `rise` on the right.
Scene step(double rise);

/// A hand before the eye at 1e-6, beside a mountain at 1e6: in halves in the upper part, pixel by pixel below.
Scene near_and_far();

}  // namespace gloam::stress
