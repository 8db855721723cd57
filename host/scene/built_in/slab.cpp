// A slab that stands out from a wall towards the camera, for occluders that no ray from the eye meets (Vermeer, Scandolo,
// Eisemann 2021, figure 3).
#include "scene/built_in/mesh_builder.h"

namespace gloam::scenes {
namespace {

Scene make(const ParameterValues& values) {
  Scene scene;
  const float height = float(values.number("height"));
  const int plaster = add_material(scene, "plaster", vec3(0.7f));
  const int stone = add_material(scene, "stone", {0.5f, 0.45f, 0.4f});
  const float half = 400;
  add_quad(add_mesh(scene, "wall", plaster), {-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0},
           64);
  add_box(add_mesh(scene, "slab", stone), {-0.3f, -half, 0}, {0.3f, half, height});
  // The camera is far away, so that the front hides little of the wall.
  scene.cameras = {looking_at("main", {0, 0, 24}, {0, 0, 0}, 8), looking_at("side", {10, 0, 22}, {0, 0, 0.5}, 8)};
  scene.ao_radius = 0.5;
  return scene;
}

}  // namespace

std::vector<SceneRecipe> slab() {
  return {{.name = "slab",
           .summary = "a slab on a wall, seen edge-on: its sides lie along the view",
           .kind = "object",
           .parameters = {float_parameter("height", 1, 0.01, 10, "metres", "height of the slab above the wall")},
           .make = make}};
}

}  // namespace gloam::scenes
