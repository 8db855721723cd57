// Texture lookup.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "gloam/scene/scene.h"

namespace gloam {

/// Bilinear, repeating; 0 to 1, colours made linear if the texture is sRGB (alpha never is). (0, 0) is the top left corner.
glm::vec4 texel(const Texture& texture, glm::vec2 uv, bool srgb);

/// Whether rays may pass through holes in a mesh's texture.
bool has_holes(const Scene& scene, const Mesh& mesh);

}  // namespace gloam
