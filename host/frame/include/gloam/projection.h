// Conversion between pixels and points in space, for every kind of camera, in double.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "gloam/camera.h"

namespace gloam {

/// The points that a pixel may show: start + depth * per_depth at `depth`. View space, scene units.
struct ViewRay {
  glm::dvec3 start{0.0}, per_depth{0.0, 0.0, -1.0};
  glm::dvec3 at(double depth) const { return start + depth * per_depth; }
};

/// The ray of a position in the image, pixels (centres at +0.5, as in `Camera`). None if a light-field display shows nothing there:
/// the module's light misses the screen.
std::optional<ViewRay> view_ray(const Camera& camera, const glm::dvec2& place);

/// Position in the image of a point of view space, pixels, inside the image or not. None for a point behind the eye, or, on a
/// light-field display, before the observers or behind the module.
std::optional<glm::dvec2> pixel_of(const Camera& camera, const glm::dvec3& point);

/// Position in the image of a point (w = 1) or a direction (w = 0) of the world, pixels, for a camera with a pose. Only a
/// perspective camera has a position for a direction.
std::optional<glm::dvec2> pixel_of_world(const Camera& camera, const glm::dvec3& world, double w);

/// Depth at which all rays of a light-field display's module meet above one another (its slit), scene units; infinite for other
/// cameras.
double depth_of_slit(const Camera& camera);

/// Width in pixels of one scene unit at a depth, near the middle of the image.
double pixels_per_unit(const Camera& camera, double depth);

}  // namespace gloam
