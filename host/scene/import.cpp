// Scenes from files, by assimp: placed meshes, cameras, and notes on repairs and omissions.
#include "gloam/scene/import.h"

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <limits>
#include <set>

#include "gloam/error.h"
#include "scene/assimp_files.h"
#include "scene/assimp_scene.h"
#include "scene/gltf_json.h"
#include "scene/import_cameras.h"
#include "scene/import_materials.h"
#include "scene/import_meshes.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

/// Counted with all instances: a small file can ask for any number of them.
constexpr size_t most_triangles = 100'000'000;

std::string counted(size_t n, const char* one) { return fmt::format("{} {}{}", n, one, n == 1 ? "" : "s"); }

/// The up axis that the file states (FBX), whose axes assimp keeps; other formats come with y up.
glm::dvec3 up_of(const aiScene& from) {
  int axis = 1, sign = 1;
  if (from.mMetaData) from.mMetaData->Get("UpAxis", axis), from.mMetaData->Get("UpAxisSign", sign);
  glm::dvec3 up(0.0);
  up[axis >= 0 && axis < 3 ? axis : 1] = sign < 0 ? -1 : 1;
  return up;
}

void add_notes(const Repairs& repairs, const Bounds& bounds, const aiScene& from, Scene& scene) {
  const auto note = [&](size_t n, const char* one, const char* many) {
    if (n > 0) scene.notes.push_back(n == 1 ? fmt::format("1 {}", one) : fmt::format("{} {}", n, many));
  };
  note(repairs.not_finite, "triangle was left out, with a vertex that is not finite",
       "triangles were left out, with vertices that are not finite");
  note(repairs.degenerate, "triangle was left out, without an area", "triangles were left out, without an area");
  note(repairs.not_surfaces, "point or line was left out", "points and lines were left out");
  note(repairs.normals, "vertex normal was zero or not finite, and is made from the faces around it",
       "vertex normals were zero or not finite, and are made from the faces around them");
  note(repairs.uvs, "texture coordinate was not finite, and is 0", "texture coordinates were not finite, and are 0");
  note(repairs.coloured, "mesh has vertex colours, which are left out",
       "meshes have vertex colours, which are left out");
  note(repairs.moving, "mesh has bones or morph targets, and stands as modelled",
       "meshes have bones or morph targets, and stand as modelled");
  note(from.mNumLights, "light of the file was left out", "lights of the file were left out");
  const double step = bounds.largest_local * std::numeric_limits<float>::epsilon();
  if (step > 1e-5 * bounds.diagonal())
    scene.notes.push_back(
        fmt::format("vertices lie up to {:.3g} from zero, where float has steps of {:.1g}: surfaces "
                    "are rough, unless the file moves the mesh by a transform instead",
                    bounds.largest_local, step));
}

/// Adds notes on material files.
void add_notes(const AssimpFiles& files, Scene& scene) {
  if (files.found.empty()) {
    for (const std::string& name : std::set(files.missing.begin(), files.missing.end()))
      scene.notes.push_back(
          fmt::format("material file '{}' is not there or does not begin with newmtl; its materials are plain", name));
  }
  if (!files.left_out.empty())
    scene.notes.push_back(
        fmt::format("{} of the material files {} left out, as {} no number: {}",
                    counted(files.left_out.size(), "statement"), files.left_out.size() == 1 ? "was" : "were",
                    files.left_out.size() == 1 ? "its value is" : "their values are", enumerate(files.left_out)));
}

void check_count(const std::vector<Instance>& instances, const fs::path& path) {
  size_t count = 0;
  for (const Instance& instance : instances) count += instance.mesh->mNumFaces;
  if (count > most_triangles)
    throw Error("{}: has {} triangles with all instances; up to {} are read", path.string(), count, most_triangles);
}

[[noreturn]] void refuse_empty(const Repairs& repairs, const fs::path& path) {
  std::vector<std::string> found;
  if (repairs.not_surfaces) found.push_back(counted(repairs.not_surfaces, "point or line"));
  if (repairs.degenerate) found.push_back(counted(repairs.degenerate, "triangle") + " without an area");
  if (repairs.not_finite)
    found.push_back(counted(repairs.not_finite, "triangle") + " with vertices that are not finite");
  throw Error("{}: has no triangles{}{}", path.string(), found.empty() ? "" : ", only ", enumerate(found));
}

Scene imported(const fs::path& path) {
  check_scene_file(path);
  const bool is_gltf = has_gltf_ending(path);
  const GltfJson gltf = is_gltf ? read_gltf_json(path) : GltfJson{};
  Assimp::Importer importer;
  AssimpFiles* files = new AssimpFiles;
  importer.SetIOHandler(files);  // the importer owns it
  const aiScene& from = read_assimp_scene(importer, path, is_gltf, *files);

  Scene scene;
  scene.name = path.filename().string();
  scene.up = up_of(from);
  const std::vector<Instance> instances = instances_of(from);
  check_count(instances, path);
  const Bounds bounds = bounds_of(instances, path);
  if (!bounds.empty()) scene.origin = 0.5 * (bounds.low + bounds.high);
  add_notes(*files, scene);
  const std::vector<UvUse> uv_uses = import_materials(from, path.parent_path(), gltf.emissive_strength, scene);
  Repairs repairs;
  add_meshes(instances, uv_uses, scene, repairs);
  if (scene.faces() == 0) refuse_empty(repairs, path);
  add_notes(repairs, bounds, from, scene);

  scene.notes.insert(scene.notes.end(), gltf.notes.begin(), gltf.notes.end());
  if (is_gltf)
    add_cameras(gltf.cameras, scene);
  else
    add_assimp_cameras(from, scene);
  add_overview(bounds, scene);
  return scene;
}

}  // namespace

Scene import_scene(const fs::path& path) {
  try {
    return imported(path);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error("{}: not enough memory to read it", path.string());
  } catch (const std::exception& e) {
    throw Error("{}: cannot be read as a scene: {}", path.string(), reason_on_one_line(e.what()));
  }
}

}  // namespace gloam
