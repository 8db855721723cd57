// Scenes from files.
#pragma once

#include <filesystem>

#include "gloam/scene/scene.h"

namespace gloam {

/// Reads OBJ, glTF 2, GLB and whatever else assimp knows (docs/scenes-from-files.md); every instance becomes a mesh of its own. A
/// mesh without normals is flat; normals that are zero or not finite are made from the faces around them. Triangles without an
/// area or with vertices that are not finite are left out. A texture that cannot be read is left out; its factor stays. `notes`
/// says so, with counts. The last camera is "overview", which sees everything.
/// Throws Error for a missing file, a file that is not a scene (with the reason) or is cut short, no triangles, coordinates over
/// 1e15.
Scene import_scene(const std::filesystem::path& path);

}  // namespace gloam
