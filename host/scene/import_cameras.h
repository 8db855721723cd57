// Cameras of a scene file.
#pragma once

#include <assimp/scene.h>

#include <vector>

#include "gloam/scene/scene.h"
#include "scene/import_meshes.h"

namespace gloam {

/// Adds the cameras that assimp read. A camera that cannot be used becomes a note.
void add_assimp_cameras(const aiScene& from, Scene& scene);

/// Adds the cameras of a glTF file (gltf_json.h).
void add_cameras(const std::vector<SceneCamera>& cameras, Scene& scene);

/// Adds "overview", a camera above a corner, as near as possible with the whole bounding box in an image of up to 16:9.
void add_overview(const Bounds& bounds, Scene& scene);

}  // namespace gloam
