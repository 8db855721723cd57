// A scene as assimp reads it, checked.
#pragma once

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>
#include <string>

#include "scene/assimp_files.h"

namespace gloam {

/// Triangles. No smooth normals are made (missing ones mean flat faces) and no vertices joined. The scene is the importer's,
/// which has `files`. Throws Error for what assimp cannot read, or reads and does not understand.
const aiScene& read_assimp_scene(Assimp::Importer& importer, const std::filesystem::path& path, bool is_gltf,
                                 const AssimpFiles& files);

/// assimp's reason on one line, without a full stop.
std::string reason_on_one_line(std::string text);

}  // namespace gloam
