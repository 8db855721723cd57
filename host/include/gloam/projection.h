// Between pixels and points in space, for every kind of camera, in double.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "gloam/camera.h"

namespace gloam {

/// What a pixel shows, by depth: the point at `depth` is start + depth * per_depth. View space, scene units.
struct ViewRay {
  glm::dvec3 start{0.0}, per_depth{0.0, 0.0, -1.0};
  glm::dvec3 at(double depth) const { return start + depth * per_depth; }
};

/// Of a place in the image, pixels (centres at +0.5, as in `Camera`). None where a light-field display shows nothing: the
/// module's light misses the screen.
std::optional<ViewRay> view_ray(const Camera& camera, const glm::dvec2& place);

/// Where the image shows a point of view space, pixels; none where it does not, whatever the image's size: behind the eye, or
/// before the observers or behind the module of a light-field display.
std::optional<glm::dvec2> place_of(const Camera& camera, const glm::dvec3& point);

/// The same of a point (w = 1) or a direction (w = 0) of the world, for a camera with a pose. Directions have a place in the image
/// of an eye alone.
std::optional<glm::dvec2> place_in_world(const Camera& camera, const glm::dvec3& world, double w);

/// Depth at which all rays of a light-field display's module meet above one another, scene units; infinite for other cameras.
double depth_of_slit(const Camera& camera);

/// Pixels to the right that a length of one scene unit across takes at a depth, about the middle of the image.
double pixels_per_unit(const Camera& camera, double depth);

}  // namespace gloam
