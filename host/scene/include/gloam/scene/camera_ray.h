// The rays of a camera into a scene.
#pragma once

#include <glm/vec3.hpp>

#include "gloam/camera.h"
#include "gloam/scene/tracer.h"

namespace gloam {

/// The ray through a position in the image, in pixels (centres at +0.5), relative to Scene::origin. Distances along it are planar
/// view-space depths, scene units. Throws Error if a light-field display shows nothing there (`view_ray`).
TracerRay camera_ray(const Camera& camera, const glm::dvec3& scene_origin, double x, double y);

}  // namespace gloam
