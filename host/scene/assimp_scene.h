// A scene as assimp reads it, checked.
#pragma once

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>
#include <string>

#include "scene/assimp_files.h"

namespace gloam {

/// A scene of triangles. Makes no smooth normals (missing ones mean flat faces) and joins no vertices. The importer owns the scene
/// and `files`. Throws Error for a file that assimp cannot read, and for one whose contents it silently skipped or got wrong.
const aiScene& read_assimp_scene(Assimp::Importer& importer, const std::filesystem::path& path, bool is_gltf,
                                 const AssimpFiles& files);

/// assimp's reason on one line, without a full stop.
std::string reason_on_one_line(std::string text);

}  // namespace gloam
