// Texture lookup.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <string>

#include "gloam/scene/scene.h"

namespace gloam {

/// Throws Error with only the reason ("unknown image type"); the caller adds the picture's name.
Texture decode_image(const std::string& name, const uint8_t* bytes, size_t size);
/// As above, from a file.
Texture read_image(const std::filesystem::path& path);

/// Bilinear, repeating; 0 to 1, colours made linear if the texture is sRGB (alpha never is). (0, 0) is the top left corner.
glm::vec4 texel(const Texture& texture, glm::vec2 uv, bool srgb);

/// Whether rays may pass through holes in a mesh's texture.
bool has_holes(const Scene& scene, const Mesh& mesh);

}  // namespace gloam
