#include "scene/import_meshes.h"

#include <algorithm>
#include <array>

#include "gloam/error.h"

namespace gloam {
namespace {

/// Float has steps of 1e8 there; squares of distances still fit it.
constexpr double largest_coordinate = 1e15;
/// A triangle counts as without area if its height is less than this share of its length: float cannot give its normal.
constexpr double thinnest = 1e-7;

double largest_of(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

glm::dvec3 area_vector(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
}

bool degenerate(const std::array<glm::vec3, 3>& p) {
  const double longest =
      std::max({glm::distance(glm::dvec3(p[0]), glm::dvec3(p[1])), glm::distance(glm::dvec3(p[1]), glm::dvec3(p[2])),
                glm::distance(glm::dvec3(p[2]), glm::dvec3(p[0]))});
  return !(glm::length(area_vector(p[0], p[1], p[2])) > thinnest * longest * longest);
}

/// The cofactors: inverse transpose times determinant. They exist even if an axis is scaled by zero.
glm::dmat3 cofactors(const glm::dmat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

class Placing {
 public:
  Placing(const Instance& instance, const glm::dvec3& origin, Repairs& repairs)
      : instance_(instance), from_(*instance.mesh), origin_(origin), repairs_(repairs) {
    mirrored_ = glm::determinant(glm::dmat3(instance.to_world)) < 0;
  }

  Mesh place(const UvUse& uv_use) {
    mesh_.name = instance_.name;
    index_.assign(from_.mNumVertices, none);
    mesh_.triangles.reserve(from_.mNumFaces);
    for (unsigned f = 0; f < from_.mNumFaces; ++f) add(from_.mFaces[f]);
    if (!mesh_.triangles.empty() && from_.HasNormals()) add_normals();
    add_uvs(uv_use);
    return std::move(mesh_);
  }

 private:
  static constexpr unsigned none = ~0u;

  void add(const aiFace& face) {
    if (face.mNumIndices != 3) {
      ++repairs_.not_surfaces;
      return;
    }
    std::array<glm::vec3, 3> p;
    for (unsigned i = 0; i < 3; ++i) p[i] = glm::vec3(instance_.vertex(face.mIndices[i]) - origin_);
    if (!finite(p[0]) || !finite(p[1]) || !finite(p[2])) {
      ++repairs_.not_finite;
    } else if (degenerate(p)) {
      ++repairs_.degenerate;
    } else {
      glm::uvec3 t;
      for (int i = 0; i < 3; ++i) t[i] = vertex(face.mIndices[i], p[size_t(i)]);
      mesh_.triangles.push_back(mirrored_ ? glm::uvec3(t.x, t.z, t.y) : t);
    }
  }

  /// Keeps only vertices that triangles use, so that a stray vertex that is not finite does no harm.
  unsigned vertex(unsigned from, const glm::vec3& position) {
    if (index_[from] == none) {
      index_[from] = unsigned(source_.size());
      source_.push_back(from);
      mesh_.positions.push_back(position);
    }
    return index_[from];
  }

  void add_normals() {
    const glm::dmat3 turn = cofactors(glm::dmat3(instance_.to_world)) * (mirrored_ ? -1.0 : 1.0);
    std::vector<unsigned> broken;
    for (unsigned from : source_) {
      const glm::dvec3 n = turn * vector_of(from_.mNormals[from]);
      const double length = glm::length(n);
      const bool usable = std::isfinite(length) && length > 0;
      if (!usable) broken.push_back(unsigned(mesh_.normals.size()));
      mesh_.normals.push_back(usable ? glm::vec3(n / length) : glm::vec3(0));
    }
    repairs_.normals += broken.size();
    if (broken.size() == mesh_.normals.size())
      mesh_.normals.clear();
    else if (!broken.empty())
      repair(broken);
  }

  /// Sets a normal to the area-weighted sum of the faces around the vertex, or to one of them if they cancel.
  void repair(const std::vector<unsigned>& broken) {
    std::vector<glm::dvec3> sum(mesh_.positions.size(), glm::dvec3(0)), last = sum;
    for (const glm::uvec3& t : mesh_.triangles) {
      const glm::dvec3 area = area_vector(mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z]);
      for (int i = 0; i < 3; ++i) sum[t[i]] += area, last[t[i]] = area;
    }
    for (unsigned v : broken) {
      const bool cancels = glm::length(sum[v]) <= thinnest * glm::length(last[v]);
      mesh_.normals[v] = glm::vec3(glm::normalize(cancels ? last[v] : sum[v]));
    }
  }

  /// assimp has v up from the bottom, for all formats.
  void add_uvs(const UvUse& use) {
    const bool has_set = use.set < AI_MAX_NUMBER_OF_TEXTURECOORDS && from_.HasTextureCoords(use.set);
    const unsigned set = has_set ? use.set : 0;
    if (!from_.HasTextureCoords(set)) return;
    for (unsigned from : source_) {
      const aiVector3D& uv = from_.mTextureCoords[set][from];
      const glm::vec2 used = use({uv.x, 1.0 - uv.y});
      const bool usable = std::isfinite(used.x) && std::isfinite(used.y);
      if (!usable) ++repairs_.uvs;
      mesh_.uvs.push_back(usable ? used : glm::vec2(0));
    }
  }

  const Instance& instance_;
  const aiMesh& from_;
  glm::dvec3 origin_;
  Repairs& repairs_;
  bool mirrored_ = false;
  Mesh mesh_;
  std::vector<unsigned> index_, source_;  // from the file's vertices to ours, and back
};

}  // namespace

std::vector<Instance> instances_of(const aiScene& scene) {
  std::vector<Instance> instances;
  std::vector<std::pair<const aiNode*, glm::dmat4>> open = {
      {scene.mRootNode, matrix_of(scene.mRootNode->mTransformation)}};
  while (!open.empty()) {
    const auto [node, to_world] = open.back();
    open.pop_back();
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      if (node->mMeshes[i] >= scene.mNumMeshes) continue;
      const aiMesh* mesh = scene.mMeshes[node->mMeshes[i]];
      instances.push_back({mesh, node->mName.length ? node->mName.C_Str() : mesh->mName.C_Str(), to_world});
    }
    for (unsigned i = node->mNumChildren; i-- > 0;)
      open.emplace_back(node->mChildren[i], to_world * matrix_of(node->mChildren[i]->mTransformation));
  }
  return instances;
}

Bounds bounds_of(const std::vector<Instance>& instances, const std::filesystem::path& path) {
  Bounds bounds;
  for (const Instance& instance : instances) {
    for (unsigned f = 0; f < instance.mesh->mNumFaces; ++f) {
      const aiFace& face = instance.mesh->mFaces[f];
      for (unsigned i = 0; face.mNumIndices == 3 && i < 3; ++i) {
        const glm::dvec3 p = instance.vertex(face.mIndices[i]);
        if (!finite(p)) continue;
        if (largest_of(p) > largest_coordinate)
          throw Error("{}: '{}' has a vertex at ({:g}, {:g}, {:g}); up to {:g} is read, so move or scale it",
                      path.string(), instance.name, p.x, p.y, p.z, largest_coordinate);
        bounds.low = glm::min(bounds.low, p);
        bounds.high = glm::max(bounds.high, p);
        bounds.largest_local =
            std::max(bounds.largest_local, largest_of(vector_of(instance.mesh->mVertices[face.mIndices[i]])));
      }
    }
  }
  return bounds;
}

void add_meshes(const std::vector<Instance>& instances, const std::vector<UvUse>& uv_uses, Scene& scene,
                Repairs& repairs) {
  const unsigned plain = unsigned(scene.materials.size()) - 1;
  for (const Instance& instance : instances) {
    const unsigned material = std::min(instance.mesh->mMaterialIndex, plain);
    Mesh mesh = Placing(instance, scene.origin, repairs).place(uv_uses[material]);
    if (mesh.triangles.empty()) continue;
    mesh.material = int(material);
    repairs.coloured += instance.mesh->HasVertexColors(0);
    repairs.moving += instance.mesh->HasBones() || instance.mesh->mNumAnimMeshes > 0;
    scene.meshes.push_back(std::move(mesh));
  }
}

}  // namespace gloam
