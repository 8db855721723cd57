// Materials and textures of an assimp scene.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <vector>

#include "gloam/scene/scene.h"

struct aiScene;

namespace gloam {

/// How a material derives its texture coordinates from a mesh's, both with (0, 0) at the top left.
struct UvUse {
  unsigned set = 0;
  glm::dvec2 scale{1.0};  ///< applied first
  double rotation = 0;    ///< applied then, radians, as in KHR_texture_transform
  glm::dvec2 offset{0.0};
  bool operator==(const UvUse&) const = default;
  glm::vec2 operator()(const glm::dvec2& uv) const;
};

/// "my%20buffer.bin" as "my buffer.bin".
std::string percent_decoded(const std::string& uri);

/// Adds the materials (assimp's in order, and a plain one after them), their textures and notes to `scene`. `emissive_strength`:
/// factor by the material's name. Returns the use of texture coordinates by material.
std::vector<UvUse> import_materials(const aiScene& from, const std::filesystem::path& folder,
                                    const std::map<std::string, float>& emissive_strength, Scene& scene);

}  // namespace gloam
