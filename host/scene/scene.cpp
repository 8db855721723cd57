#include "gloam/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>

#include "gloam/error.h"
#include "gloam/scene/import.h"

namespace gloam {

std::vector<std::vector<SceneRecipe>> scene_files();  // generated

namespace {

bool finite_point(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check_mesh(const Scene& scene, const Mesh& mesh) {
  const size_t n = mesh.positions.size();
  if ((!mesh.normals.empty() && mesh.normals.size() != n) || (!mesh.uvs.empty() && mesh.uvs.size() != n))
    throw Error("{}: mesh '{}' has {} vertices, {} normals and {} texture coordinates", scene.name, mesh.name, n,
                mesh.normals.size(), mesh.uvs.size());
  if (mesh.material < 0 || size_t(mesh.material) >= scene.materials.size())
    throw Error("{}: mesh '{}' has material {}, and there are {}", scene.name, mesh.name, mesh.material,
                scene.materials.size());
  for (const glm::vec3& p : mesh.positions) {
    if (!finite_point(p)) throw Error("{}: mesh '{}' has a vertex that is not finite", scene.name, mesh.name);
    const float most = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (double(most) > farthest_traced)
      throw Error(
          "{}: mesh '{}' has a vertex {:g} from the middle of the scene; up to {:g} is traced: scale the scene, or "
          "leave the mesh out",
          scene.name, mesh.name, most, farthest_traced);
  }
  for (const glm::vec3& n : mesh.normals) {
    if (!finite_point(n)) throw Error("{}: mesh '{}' has a normal that is not finite", scene.name, mesh.name);
  }
  for (const glm::uvec3& t : mesh.triangles) {
    if (t.x >= n || t.y >= n || t.z >= n)
      throw Error("{}: mesh '{}' has a triangle with vertex {}, and there are {}", scene.name, mesh.name,
                  std::max({t.x, t.y, t.z}), n);
  }
}

void check_material(const Scene& scene, const Material& material) {
  for (const int texture :
       {material.albedo_texture, material.roughness_texture, material.metallic_texture, material.emission_texture}) {
    if (texture < -1 || texture >= int(scene.textures.size()))
      throw Error("{}: material '{}' has texture {}, and there are {}", scene.name, material.name, texture,
                  scene.textures.size());
  }
}

void check_texture(const Scene& scene, const Texture& texture) {
  if (texture.width < 1 || texture.height < 1 ||
      texture.texels.size() != 4 * size_t(texture.width) * size_t(texture.height))
    throw Error("{}: texture '{}' of {}x{} has {} bytes", scene.name, texture.name, texture.width, texture.height,
                texture.texels.size());
}

}  // namespace

size_t Scene::faces() const {
  size_t count = 0;
  for (const Mesh& mesh : meshes) count += mesh.triangles.size();
  return count;
}

Camera camera_for(const SceneCamera& from, int width, int height) {
  Camera camera;
  camera.orthographic = from.orthographic;
  camera.fx = camera.fy =
      from.orthographic ? width / from.width : width / 2.0 / std::tan(from.fov_degrees * glm::pi<double>() / 360);
  camera.cx = width / 2.0;
  camera.cy = height / 2.0;
  camera.pose = from.pose;
  camera.source = "scene camera '" + from.name + "'";
  return camera;
}

SceneCamera looking_at(const std::string& name, const glm::dvec3& eye, const glm::dvec3& target, double fov_degrees,
                       const glm::dvec3& up) {
  const glm::dvec3 away = eye - target;
  // Divided by its largest component first: squares of very small or large numbers are out of double's range.
  const double largest = std::max({std::abs(away.x), std::abs(away.y), std::abs(away.z)});
  if (!(largest > 0 && std::isfinite(largest)))
    throw UsageError("a camera at ({:g}, {:g}, {:g}) cannot look at ({:g}, {:g}, {:g})", eye.x, eye.y, eye.z, target.x,
                     target.y, target.z);
  const glm::dvec3 back = glm::normalize(away / largest);
  glm::dvec3 right = glm::cross(up, back);
  if (glm::length(right) < 1e-9) right = glm::cross(glm::dvec3(0, 0, -1), back);
  right = glm::normalize(right);
  SceneCamera camera;
  camera.name = name;
  camera.fov_degrees = fov_degrees;
  camera.pose.position = eye;
  camera.pose.world_to_view = glm::transpose(glm::dmat3(right, glm::cross(back, right), back));
  return camera;
}

const std::vector<SceneRecipe>& builtin_scenes() {
  static const std::vector<SceneRecipe> recipes = [] {
    std::vector<SceneRecipe> all;
    for (const std::vector<SceneRecipe>& file : scene_files()) all.insert(all.end(), file.begin(), file.end());
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return all;
  }();
  return recipes;
}

const SceneRecipe* find_builtin_scene(const std::string& name) {
  for (const SceneRecipe& recipe : builtin_scenes()) {
    if (recipe.name == name) return &recipe;
  }
  return nullptr;
}

Scene load_scene(const std::string& name, const Settings& settings) {
  const SceneRecipe* recipe = find_builtin_scene(name);
  if (!recipe) {
    const bool is_path = name.find_first_of("./\\") != std::string::npos || std::filesystem::exists(name);
    if (!is_path) {
      std::vector<std::string> names;
      for (const SceneRecipe& r : builtin_scenes()) names.push_back(r.name);
      throw UsageError("no scene '{}'{}; built in are {}, and OBJ and glTF files are read", name,
                       suggestion(name, names), enumerate(names));
    }
    if (!settings.empty())
      throw UsageError("{}: '{}' can be set for built-in scenes only", name, settings.front().first);
    return import_scene(name);
  }
  ParameterValues values(recipe->parameters);
  for (const auto& [key, value] : settings) values.set(key, value, name);
  Scene scene = recipe->make(values);
  scene.name = name;
  for (const Parameter& p : recipe->parameters) {
    scene.name += fmt::format("{}{}={}", &p == &recipe->parameters.front() ? ": " : " ", p.name, values.text(p.name));
  }
  return scene;
}

void check(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) check_mesh(scene, mesh);
  for (const Material& material : scene.materials) check_material(scene, material);
  for (const Texture& texture : scene.textures) check_texture(scene, texture);
  if (scene.meshes.size() >= (1u << 24))
    throw Error("{}: has {} meshes; fewer than {} can be told apart", scene.name, scene.meshes.size(), 1 << 24);
  if (scene.cameras.empty()) throw Error("{}: has no camera", scene.name);
  if (scene.faces() == 0) throw Error("{}: has no triangles", scene.name);
}

}  // namespace gloam
