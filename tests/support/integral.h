// An estimate of ambient occlusion against the integral that its samples estimate, over surfaces known in closed form.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "support/frames.h"
#include "support/techniques.h"

namespace gloam::test {

glm::dvec3 point_at(const EyeRay& ray, double depth);

/// What is nearer of two scenes.
Scene nearer_of(const Scene& a, const Scene& b);

/// A ball in view space.
Scene ball(const glm::dvec3& centre, double radius);

/// A part of a scene and where to look: pixels that are well occluded, and smoothly.
struct IntegralCase {
  std::string name;
  Shot shot;
  Scene scene;
  std::vector<glm::ivec2> pixels;
};

/// Two walls that meet at right angles, and a ball over a plane, through a perspective and an orthographic
/// camera. For a radius of 0.8.
std::vector<IntegralCase> integral_cases();

/// The integral in double at the centre of a pixel.
using Integral = std::function<double(const IntegralCase&, glm::ivec2 pixel)>;

/// Runs a technique unfiltered with these settings, precise, with several seeds, and compares the mean with the integral: at
/// each pixel within twice `bound` and four standard errors, and in the mean over pixels within `bound` and two. Prints what it finds.
void expect_integral(const IntegralCase& test, const std::string& technique, const Settings& settings,
                     const Integral& integral, double bound = 1e-3, int seeds = 12);

}  // namespace gloam::test
