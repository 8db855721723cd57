// Meshes of an assimp scene, placed.
#pragma once

#include <assimp/scene.h>

#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <limits>
#include <string>
#include <vector>

#include "gloam/scene/scene.h"
#include "scene/import_materials.h"

namespace gloam {

inline bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
inline glm::dvec3 vector_of(const aiVector3D& v) { return {v.x, v.y, v.z}; }
inline glm::dmat4 matrix_of(const aiMatrix4x4& m) {
  return {m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4};
}

/// A mesh of the file and its transform.
struct Instance {
  const aiMesh* mesh;
  std::string name;
  glm::dmat4 to_world;
  glm::dvec3 vertex(unsigned index) const {
    return glm::dvec3(to_world * glm::dvec4(vector_of(mesh->mVertices[index]), 1.0));
  }
};

/// Instances in the order of the file, parents before children.
std::vector<Instance> instances_of(const aiScene& scene);

/// Bounds in the world, over finite vertices that triangles use.
struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  double largest_local = 0;  ///< coordinate as assimp holds it: in float, before the transform
  bool empty() const { return low.x > high.x; }
  double diagonal() const { return glm::length(high - low); }
};

/// Throws Error for a coordinate too large for float.
Bounds bounds_of(const std::vector<Instance>& instances, const std::filesystem::path& path);

/// Counts of repairs and omissions.
struct Repairs {
  size_t degenerate = 0, not_finite = 0;  ///< triangles
  size_t not_surfaces = 0;                ///< points and lines
  size_t normals = 0, uvs = 0;            ///< of vertices
  size_t coloured = 0, moving = 0;        ///< instances with vertex colours, with bones or morph targets
};

/// Adds the instances with at least one triangle to `scene`, relative to its origin; triangles are reversed if the transform
/// mirrors. The last of the scene's materials is for meshes without one. `uv_uses`: by material.
void add_meshes(const std::vector<Instance>& instances, const std::vector<UvUse>& uv_uses, Scene& scene,
                Repairs& repairs);

}  // namespace gloam
