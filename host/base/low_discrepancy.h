// Sample points and directions that every tracer shares; the same on every machine.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace gloam {

/// A well-mixed 32-bit hash (lowbias32, Wellons 2018).
uint32_t hash(uint32_t value);

/// Point `index` of a two-dimensional Sobol sequence under hashed Owen scrambling; each `seed` is one independent
/// randomisation. In [0,1).
glm::dvec2 scrambled_sobol(uint32_t index, uint32_t seed);

/// Two unit vectors that make a right-handed frame with a unit normal (Duff et al. 2017), as columns: x, y, normal.
glm::dmat3 frame_about(const glm::dvec3& normal);

/// A direction about +z with probability proportional to its cosine, for u in [0,1)^2.
glm::dvec3 cosine_direction(const glm::dvec2& u);

}  // namespace gloam
