// Where what moves was in the frame before.
#pragma once

#include <glm/vec3.hpp>

#include "gloam/scene/scene.h"
#include "gloam/scene/tracer.h"

namespace gloam {

/// Throws UsageError if the scenes differ in more than where their vertices are.
void check_earlier_scene(const Scene& now, const Scene& before);

/// Position in the world, in `before`, of the point of a triangle that a surface of `now` shows: the same mesh, triangle and
/// barycentric coordinates. Where the triangle has not moved, the surface's position itself.
glm::dvec3 earlier_position(const Scene& now, const Scene& before, const Surface& surface);

}  // namespace gloam
