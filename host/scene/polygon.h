// Polygons with holes, cut into triangles.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace gloam {

/// One loop for an outline with holes: each hole is cut open and joined to the rest by a seam that is walked both ways.
/// Outline and holes go round counter-clockwise.
std::vector<glm::vec2> joined(std::vector<glm::vec2> outline, std::vector<std::vector<glm::vec2>> holes);

/// A polygon cut into triangles of its corners' indices, ear by ear. It may touch itself along seams.
std::vector<glm::uvec3> triangulated(const std::vector<glm::vec2>& outline);

}  // namespace gloam
