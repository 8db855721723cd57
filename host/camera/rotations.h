// Checks whether a 3x3 matrix of a file is a rotation, and finds the nearest one.
#pragma once

#include <glm/mat3x3.hpp>
#include <string>

namespace gloam {

/// The orthonormal matrix nearest to `m`, by Newton's iteration for the polar decomposition: it favours no axis, and converges
/// from float rounding to double precision in two steps.
glm::dmat3 nearest_rotation(glm::dmat3 m);

/// The fault of `m` as a rotation, as the end of a sentence; empty if it is a rotation, mirrored or not.
std::string rotation_fault(const glm::dmat3& m);

}  // namespace gloam
