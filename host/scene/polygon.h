// Polygons with holes, cut into triangles.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace gloam {

/// Joins an outline and its holes to one loop: each hole is cut open and connected by a seam that is walked both ways. Outline
/// and holes are counter-clockwise.
std::vector<glm::vec2> joined(std::vector<glm::vec2> outline, std::vector<std::vector<glm::vec2>> holes);

/// Cuts a polygon into triangles of corner indices, ear by ear. It may touch itself along seams.
std::vector<glm::uvec3> triangulated(const std::vector<glm::vec2>& outline);

}  // namespace gloam
