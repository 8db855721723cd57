// The bundled scene: the corner of a loggia above the sea, its furniture, light and camera.
#pragma once

#include "analytic_scene.h"
#include "gloam/camera.h"

namespace gloam::analytic {

/// The radius of the reference, metres.
inline constexpr double loggia_ao_radius = 0.5;

Scene loggia_scene();

/// Perspective, horizontal field of view 65 degrees, looking slightly down.
Camera loggia_camera(int width, int height);

/// The ray through a position in the image, in pixels (centres at +0.5).
Ray camera_ray(const Camera& camera, double x, double y);

/// Planar view-space depth of a world position.
double view_depth(const Camera& camera, const glm::dvec3& position);

/// Colour of the sky and the sea where nothing is hit; scene-linear.
glm::vec3 loggia_background(const glm::dvec3& direction);

/// Direct light of a sun (a wide one: soft shadows) and a sky term without occlusion, times albedo; scene-linear. Ambient
/// occlusion can be multiplied into the sky term without counting it twice.
glm::vec3 loggia_radiance(const Scene& scene, const glm::dvec3& position, const Hit& hit, uint32_t seed);

}  // namespace gloam::analytic
