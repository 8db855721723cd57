// Whether a 3x3 matrix of a file is a rotation, and the rotation that it stands for.
#pragma once

#include <glm/mat3x3.hpp>
#include <string>

namespace gloam {

/// The orthonormal matrix nearest to `m`, by Newton's iteration for the polar decomposition: it favours no axis, and
/// from float rounding it converges to double precision in two steps.
glm::dmat3 nearest_rotation(glm::dmat3 m);

/// What is wrong with `m` as a rotation, as the end of a sentence; empty when it is one, mirrored or not.
std::string rotation_fault(const glm::dmat3& m);

}  // namespace gloam
