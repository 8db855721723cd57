// Comparison of an estimate of ambient occlusion with the integral that its samples estimate, over surfaces in closed form.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "support/estimate.h"
#include "support/stress.h"

namespace gloam::test {

/// A scene, and pixels of it that are well and smoothly occluded.
struct IntegralCase {
  std::string name;
  Shot shot;
  Scene scene;
  std::vector<glm::ivec2> pixels;
};

/// For a radius of 0.8: two walls that meet at right angles, with a perspective, an orthographic and an off-axis camera, and a
/// ball over a plane with the first two. Each has this many pixels on a line.
std::vector<IntegralCase> integral_cases(int pixels = 14);
/// The case of that name, "corner, perspective".
IntegralCase integral_case(const std::string& name, int pixels = 14);
/// The case with an addition to its name: the settings.
IntegralCase named(IntegralCase test, const std::string& more);

// --- For writing an integral

/// The surface that a pixel shows at its centre.
struct Receiver {
  EyeRay ray;
  Surface surface;
  glm::dvec3 point;
};
Receiver receiver_at(const IntegralCase& test, glm::ivec2 pixel);

/// From a receiver to the surface seen at a position in the image, in pixels.
std::optional<glm::dvec3> towards(const IntegralCase& test, const Receiver& receiver, glm::dvec2 place);

/// Number of pixels that a length facing the eye covers at a depth.
double pixels_across(const Shot& shot, double length, double depth);

/// Position of a point in the image, in pixels.
glm::dvec2 pixel_of(const Shot& shot, const glm::dvec3& point);

/// Point `i` of a sequence that is even in the unit cube (Roberts 2018).
glm::dvec3 even_point(int i);

/// Weight of an occluder, from the vector to it and the receiver's surface.
using Contribution = std::function<double(const glm::dvec3& v, const Surface& here)>;

/// (1 - |v|^2 / radius^2) max(0, n.v/|v| - bias) within the radius.
Contribution obscurance(double radius, double bias);

/// Mean contribution of the visible surfaces, over directions on the screen and over distances from `from` to `to` (pixels,
/// uniform), with this many midpoints of each.
double mean_on_screen(const IntegralCase& test, glm::ivec2 pixel, double from, double to, int directions, int distances,
                      const Contribution& contribution);

// --- Estimate and integral

/// Mean over seeds at one pixel, and the standard error of that mean.
struct Estimate {
  double mean = 0, error = 0;
};

/// Runs a technique unfiltered and precise. To save time only the pixels are computed, by dp-`technique` over one layer equal to
/// the depth, if it exists; with one seed the technique itself computes the whole image, and must have the same values there.
std::vector<Estimate> estimates(const IntegralCase& test, const std::string& technique, const Settings& settings,
                                int seeds);

/// The integral in double at the centre of a pixel.
using Integral = std::function<double(const IntegralCase&, glm::ivec2 pixel)>;

struct Bounds {
  double pixel = 1e-3;  ///< of the difference at each pixel, besides `errors` standard errors
  double mean = 1e-3;   ///< of the mean difference over all pixels
  double errors = 4;
  double well_occluded = 0.95;  ///< AO must be below this at some pixel: else the case tests nothing
};

/// Compares the limit of a technique with the integral, and prints the difference.
void expect_integral(const IntegralCase& test, const std::string& technique, const Settings& settings,
                     const Integral& integral, const Bounds& bounds = {}, int seeds = 12);

}  // namespace gloam::test
