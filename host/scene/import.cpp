// Scenes from files, by assimp: placed meshes, cameras, and notes on repairs and omissions.
#include "gloam/scene/import.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat4x4.hpp>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "gloam/error.h"
#include "gloam/scene/scene.h"
#include "scene/assimp_files.h"
#include "scene/gltf_json.h"
#include "scene/import_materials.h"
#include "scene/import_meshes.h"

namespace gloam {
namespace {

/// "name", or "name 2" and so on if the name is taken.
std::string unique_name(const Scene& scene, const std::string& wanted) {
  const std::string base = wanted.empty() ? "camera" : wanted;
  std::string name = base;
  const auto taken = [&](const SceneCamera& camera) { return camera.name == name; };
  for (int i = 2; std::any_of(scene.cameras.begin(), scene.cameras.end(), taken); ++i)
    name = fmt::format("{} {}", base, i);
  return name;
}

/// The transform of the node with this name; identity if there is none.
glm::dmat4 to_world_of(const aiNode* node) {
  glm::dmat4 m(1.0);
  for (; node; node = node->mParent) m = matrix_of(node->mTransformation) * m;
  return m;
}

/// Adds the cameras that assimp read. A camera that cannot be used becomes a note.
/// assimp's cameras have a position and a direction within their node. The field of view is the whole horizontal angle; assimp's
/// header says half of it, wrongly.
void add_assimp_cameras(const aiScene& from, Scene& scene) {
  for (unsigned i = 0; i < from.mNumCameras; ++i) {
    const aiCamera& camera = *from.mCameras[i];
    const glm::dmat4 m = to_world_of(from.mRootNode->FindNode(camera.mName));
    const glm::dvec3 eye(m * glm::dvec4(vector_of(camera.mPosition), 1.0));
    const glm::dvec3 forward = glm::dmat3(m) * vector_of(camera.mLookAt), up = glm::dmat3(m) * vector_of(camera.mUp);
    const double fov = double(camera.mHorizontalFOV) * 180 / glm::pi<double>(), width = 2.0 * camera.mOrthographicWidth;
    const bool orthographic = width > 0, lens = orthographic ? std::isfinite(width) : fov > 0 && fov < 179.9;
    const double area = glm::length(glm::cross(forward, up));
    if (!lens || !finite(eye) || !std::isfinite(area) || !(area > 0)) {
      scene.notes.push_back(
          fmt::format("camera '{}' has no usable field of view or transform and was left out", camera.mName.C_Str()));
      continue;
    }
    SceneCamera made = looking_at(unique_name(scene, camera.mName.C_Str()), glm::dvec3(0), glm::normalize(forward),
                                  orthographic ? 60 : fov, glm::normalize(up));
    made.pose.position = eye;
    made.orthographic = orthographic;
    if (orthographic) made.width = width;
    scene.cameras.push_back(made);
  }
}

/// Adds the cameras of a glTF file (gltf_json.h).
void add_cameras(const std::vector<SceneCamera>& cameras, Scene& scene) {
  for (SceneCamera camera : cameras) {
    camera.name = unique_name(scene, camera.name);
    scene.cameras.push_back(camera);
  }
}

/// Adds "overview", a camera above a corner, as near as possible with the whole bounding box in an image of up to 16:9.
void add_overview(const Bounds& bounds, Scene& scene) {
  constexpr double fov_degrees = 50, margin = 1.05;
  const glm::dvec3 side = std::abs(scene.up.x) > 0.5 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 out = glm::normalize(1.0 * glm::cross(side, scene.up) + 0.6 * side + 0.6 * scene.up);
  SceneCamera camera = looking_at(unique_name(scene, "overview"), out, glm::dvec3(0), fov_degrees, scene.up);
  const double across = std::tan(fov_degrees * glm::pi<double>() / 360), down = across * 9 / 16;
  double distance = 0;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 sign(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
    const glm::dvec3 corner = camera.pose.world_to_view * (sign * (bounds.high - bounds.low));
    distance = std::max(distance, corner.z + margin * std::max(std::abs(corner.x) / across, std::abs(corner.y) / down));
  }
  camera.pose.position = scene.origin + distance * out;
  scene.cameras.push_back(camera);
}

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

/// assimp's reason on one line, without a full stop.
std::string reason_on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::isspace(c) != 0; }, ' ');
  text.erase(std::unique(text.begin(), text.end(), [](char a, char b) { return a == ' ' && b == ' '; }), text.end());
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text;
}

/// A scene of triangles. Makes no smooth normals (missing ones mean flat faces) and joins no vertices. The importer owns the scene
/// and `files`. Throws Error for a file that assimp cannot read, and for one whose contents it silently skipped or got wrong.
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
