#include "scene/assimp_scene.h"

#include <assimp/postprocess.h>

#include <algorithm>
#include <cctype>

#include "gloam/error.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  if (reason.find("No suitable reader") != std::string::npos)
    throw Error("{}: is no scene; OBJ, glTF 2 and GLB are read, and what else assimp knows (PLY, STL, FBX, ...)",
                path.string());
  throw Error("{}: cannot be read as a scene: {}", path.string(), reason.empty() ? "no reason given" : reason);
}

/// Checks indices, which assimp does for some formats only and its triangulation trusts, and meshes that claim polygons but have
/// none, for which assimp ends the program.
void check_faces(const aiScene& scene, const fs::path& path) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    aiMesh& mesh = *scene.mMeshes[m];
    mesh.mPrimitiveTypes = 0;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      mesh.mPrimitiveTypes |= AI_PRIMITIVE_TYPE_FOR_N_INDICES(std::max(face.mNumIndices, 1u));
      for (unsigned i = 0; i < face.mNumIndices; ++i) {
        if (face.mIndices[i] >= mesh.mNumVertices)
          throw Error("{}: mesh '{}' has a face with vertex {}, and there are {}", path.string(), mesh.mName.C_Str(),
                      face.mIndices[i], mesh.mNumVertices);
      }
    }
  }
}

/// Throws Error if assimp silently skipped parts of an OBJ file.
void check_understood(const aiScene& scene, size_t expected, const fs::path& path) {
  size_t found = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    found += size_t(std::count_if(mesh.mFaces, mesh.mFaces + mesh.mNumFaces,
                                  [](const aiFace& face) { return face.mNumIndices > 2; }));
  }
  if (found != expected)
    throw Error("{}: has {} faces, and {} were understood; write it again as glTF or GLB", path.string(), expected,
                found);
}

}  // namespace

std::string reason_on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::isspace(c) != 0; }, ' ');
  text.erase(std::unique(text.begin(), text.end(), [](char a, char b) { return a == ' ' && b == ' '; }), text.end());
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text;
}

const aiScene& read_assimp_scene(Assimp::Importer& importer, const fs::path& path, bool is_gltf,
                                 const AssimpFiles& files) {
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  if (files.refused) std::rethrow_exception(files.refused);
  if (!files.why_not.empty()) throw Error("{}", files.why_not);
  if (!scene || !scene->mRootNode) refuse(path, reason_on_one_line(importer.GetErrorString()));
  check_faces(*scene, path);
  if (files.faces) check_understood(*scene, *files.faces, path);
  // assimp gets glTF texture transforms with a rotation wrong: import_materials handles those.
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate | (is_gltf ? 0u : aiProcess_TransformUVCoords));
  if (!scene) refuse(path, reason_on_one_line(importer.GetErrorString()));
  return *scene;
}

}  // namespace gloam
