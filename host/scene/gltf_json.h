// Contents of a glTF file that assimp does not provide, from its JSON.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "gloam/scene/scene.h"

namespace gloam {

struct GltfJson {
  /// Every node with a camera. assimp 5.2 takes yfov * aspectRatio for the horizontal field of view, applies the translation of a
  /// camera's node twice, and keeps only one node per camera.
  std::vector<SceneCamera> cameras;
  std::map<std::string, float> emissive_strength;  ///< KHR_materials_emissive_strength by the material's name
  std::vector<std::string> notes;
};

/// By the ending, as assimp decides: .gltf or .glb.
bool has_gltf_ending(const std::filesystem::path& path);

/// Throws Error for a file that is cut short or no JSON, for versions other than 2, for compressed meshes that assimp does not
/// read, and for nesting so deep that assimp would overflow the stack.
GltfJson read_gltf_json(const std::filesystem::path& path);

}  // namespace gloam
