// The rays of a camera into a scene.
#pragma once

#include <glm/vec3.hpp>

#include "gloam/camera.h"
#include "gloam/scene/tracer.h"

namespace gloam {

/// The ray through a point of the image, in pixels (centres at +0.5). Distances along it are planar view-space depths.
/// Relative to Scene::origin. Throws Error where a light-field display shows nothing (`view_ray`).
TracerRay camera_ray(const Camera& camera, const glm::dvec3& scene_origin, double x, double y);

}  // namespace gloam
