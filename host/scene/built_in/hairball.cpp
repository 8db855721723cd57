// A ball of long thin strands, after the well-known model by Samuli Laine: many layers, no large surface.
#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "scene/built_in/mesh_builder.h"
#include "scene/built_in/tube.h"

namespace gloam::scenes {
namespace {

constexpr vec3 centre(0, 1.2f, 0);
constexpr int locks = 24;     ///< meshes among which the strands are distributed
constexpr int segments = 32;  ///< segments of a strand
constexpr int sides = 5;

/// One strand, relative to the centre: it starts near it, turns at a rate that changes smoothly, and is bent back where it would
/// leave the ball.
std::vector<vec3> strand(uint32_t index) {
  const vec3 start = 0.12f * hash01(index, 1) * random_direction(index, 2);
  vec3 direction = random_direction(index, 3);
  const vec3 axes[3] = {random_direction(index, 4), random_direction(index, 5), random_direction(index, 6)};
  const float phase = random_in(0, glm::two_pi<float>(), index, 7);
  const float step = random_in(1.5f, 2.4f, index, 8) / segments;
  const float reach = random_in(0.8f, 1.0f, index, 9);
  std::vector<vec3> points = {start};
  for (int i = 1; i <= segments; ++i) {
    const float t = float(i) / segments;
    const vec3 turning =
        3.2f * std::sin(5 * t + phase) * axes[0] + 2.4f * std::sin(11 * t + 2 * phase) * axes[1] + 1.5f * axes[2];
    const float radius = glm::length(points.back());
    const vec3 out = points.back() / std::max(radius, 1e-3f);
    const float back = std::max(0.0f, radius - 0.75f * reach) / (0.25f * reach);
    const float outward = 1.5f * (1 - radius) - 6 * back * std::max(0.0f, glm::dot(direction, out) + 0.1f);
    direction = glm::normalize(direction + step * (glm::cross(turning, direction) + outward * out));
    points.push_back(points.back() + step * direction);
  }
  return points;
}

void add_strand(Mesh& mesh, uint32_t index) {
  std::vector<vec3> points = strand(index);
  std::vector<float> radii;
  const float thickness = random_in(0.0035f, 0.006f, index, 10);
  for (size_t i = 0; i < points.size(); ++i) {
    points[i] += centre;
    radii.push_back(thickness * (1 - 0.6f * float(i) / segments));
  }
  add_tube(mesh, points, radii, sides);
}

Scene make(const ParameterValues& values) {
  Scene scene;
  const int strands = int(values.number("strands"));
  const int floor = add_material(scene, "floor", vec3(0.55f, 0.53f, 0.5f), 0.7f);
  add_quad(add_mesh(scene, "floor", floor), {-40, 0, 40}, {40, 0, 40}, {40, 0, -40}, {-40, 0, -40}, 40);
  const int hair[] = {add_material(scene, "brown", {0.34f, 0.2f, 0.1f}, 0.45f),
                      add_material(scene, "chestnut", {0.42f, 0.19f, 0.09f}, 0.4f),
                      add_material(scene, "blond", {0.62f, 0.47f, 0.25f}, 0.5f),
                      add_material(scene, "grey", {0.5f, 0.49f, 0.47f}, 0.55f)};
  for (int lock = 0; lock < std::min(locks, strands); ++lock) {
    Mesh& mesh = add_mesh(scene, fmt::format("lock {}", lock), hair[lock % 4]);
    for (int i = lock; i < strands; i += locks) add_strand(mesh, uint32_t(i));
  }
  scene.cameras = {looking_at("main", {0.8, 1.75, 2.9}, {0, 1.1, 0}, 62),
                   looking_at("close", {0.35, 1.62, 1.35}, {0, 1.27, 0}, 50),
                   looking_at("inside", {0.1, 1.28, 0.65}, {-0.3, 1.08, -1}, 75)};
  scene.ao_radius = 0.25;
  return scene;
}

}  // namespace

std::vector<SceneRecipe> hairball() {
  return {{.name = "hairball",
           .summary = "a ball of thousands of long thin strands over a floor: many thin layers",
           .kind = "thin",
           .parameters = {int_parameter("strands", 2500, 10, 20000, "", "number of strands, 330 triangles each")},
           .make = make}};
}

}  // namespace gloam::scenes
