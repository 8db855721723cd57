// What a scene needs so that light can be traced in it.
#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "gloam/scene/scene.h"

namespace gloam {

/// "x,y,z", as flags have it.
std::string in_words(const glm::dvec3& v);

/// Throws Error for a material whose albedo is outside 0 to 1: light between two such surfaces grows without end.
void check_albedo(const Scene& scene);

/// Throws Error for a scene without any light of its own, and for light that is negative or not finite.
void check_light(const Scene& scene);

/// Throws Error for a sun without a direction.
void check_sun_direction(const Scene& scene);

}  // namespace gloam
