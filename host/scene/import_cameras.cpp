#include "scene/import_cameras.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat4x4.hpp>

#include "gloam/error.h"

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

}  // namespace

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

void add_cameras(const std::vector<SceneCamera>& cameras, Scene& scene) {
  for (SceneCamera camera : cameras) {
    camera.name = unique_name(scene, camera.name);
    scene.cameras.push_back(camera);
  }
}

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

}  // namespace gloam
