// An estimate of ambient occlusion against the integral that its samples estimate, over surfaces known in closed form.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "support/estimate.h"
#include "support/stress.h"

namespace gloam::test {

/// A scene and where to look: pixels that are well occluded, and smoothly.
struct IntegralCase {
  std::string name;
  Shot shot;
  Scene scene;
  std::vector<glm::ivec2> pixels;
};

/// For a radius of 0.8: two walls that meet at right angles through a perspective, an orthographic and an off-axis camera,
/// and a ball over a plane through the first two. Of each so many pixels on a line.
std::vector<IntegralCase> integral_cases(int pixels = 14);
/// The one of that name, "corner, perspective".
IntegralCase integral_case(const std::string& name, int pixels = 14);
/// The same with something added to its name: what is set.
IntegralCase named(IntegralCase test, const std::string& more);

// --- For writing an integral

/// What a pixel shows at its centre.
struct Receiver {
  EyeRay ray;
  Surface surface;
  glm::dvec3 point;
};
Receiver receiver_at(const IntegralCase& test, glm::ivec2 pixel);

/// From a receiver to what is seen through a place of the image, in pixels.
std::optional<glm::dvec3> towards(const IntegralCase& test, const Receiver& receiver, glm::dvec2 place);

/// How many pixels a length covers at a depth, where it faces the eye.
double pixels_across(const Shot& shot, double length, double depth);

/// The place of the image that shows a point, in pixels.
glm::dvec2 pixel_of(const Shot& shot, const glm::dvec3& point);

/// Point `i` of a sequence that is even in the unit cube (Roberts 2018).
glm::dvec3 even_point(int i);

/// What an occluder takes away, from the vector to it and the receiver's surface.
using Contribution = std::function<double(const glm::dvec3& v, const Surface& here)>;

/// (1 - |v|^2 / radius^2) max(0, n.v/|v| - bias) within the radius.
Contribution obscurance(double radius, double bias);

/// Mean of what is seen, over directions on the screen and over distances from `from` to `to` (pixels, uniform), by as many
/// midpoints of each.
double mean_on_screen(const IntegralCase& test, glm::ivec2 pixel, double from, double to, int directions, int distances,
                      const Contribution& contribution);

// --- Estimate and integral

/// Mean over seeds at one pixel, and the standard error of that mean.
struct Estimate {
  double mean = 0, error = 0;
};

/// Runs a technique unfiltered and precise. To save time the pixels are computed alone, by dp-`technique` over one layer
/// that is the depth, where there is such a form; with one seed the whole image is computed by the technique itself, and has
/// to have the same values there.
std::vector<Estimate> estimates(const IntegralCase& test, const std::string& technique, const Settings& settings,
                                int seeds);

/// The integral in double at the centre of a pixel.
using Integral = std::function<double(const IntegralCase&, glm::ivec2 pixel)>;

struct Bounds {
  double pixel = 1e-3;  ///< of the difference at each pixel, beside `errors` standard errors
  double mean = 1e-3;   ///< of the mean difference over all pixels
  double errors = 4;
  double well_occluded = 0.95;  ///< AO lies below at some pixel: else the case tests nothing
};

/// Compares what a technique tends to with the integral, and prints by how much they differ.
void expect_integral(const IntegralCase& test, const std::string& technique, const Settings& settings,
                     const Integral& integral, const Bounds& bounds = {}, int seeds = 12);

}  // namespace gloam::test
