// One plane: AO must be open everywhere.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scene/built_in/mesh_builder.h"

namespace gloam::scenes {
namespace {

Scene make(const ParameterValues& values) {
  Scene scene;
  const float tilt = float(values.number("tilt")) * glm::pi<float>() / 180;
  const int stone = add_material(scene, "stone", vec3(0.6f));
  Mesh& mesh = add_mesh(scene, "plane", stone);
  // Tilted about the image's horizontal axis: 0 faces the camera, 90 is edge-on.
  const vec3 across(1, 0, 0), along(0, std::cos(tilt), -std::sin(tilt));
  const float half = 400;
  add_quad(mesh, -half * across - half * along, half * across - half * along, half * across + half * along,
           -half * across + half * along, 64);
  scene.cameras = {looking_at("main", {0, 0, 4}, {0, 0, 0}, 60)};
  scene.ao_radius = 0.5;
  return scene;
}

}  // namespace

std::vector<SceneRecipe> plane() {
  return {{.name = "plane",
           .summary = "one plane, 4 m away, tilted away from the camera",
           .kind = "flat",
           .parameters = {float_parameter("tilt", 60, 0, 89.9, "degrees", "angle between the plane and the image")},
           .make = make}};
}

}  // namespace gloam::scenes
