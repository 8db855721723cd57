// A pillar in front of a rib on a wall, with any number of sheets between them: how deep a hidden occluder may lie (Vermeer,
// Scandolo, Eisemann 2021, figure 8).
#include "scene/built_in/mesh_builder.h"

namespace gloam::scenes {
namespace {

Scene make(const ParameterValues& values) {
  Scene scene;
  const int sheets = int(values.number("sheets"));
  const int plaster = add_material(scene, "plaster", vec3(0.7f));
  const int stone = add_material(scene, "stone", {0.5f, 0.45f, 0.4f});
  const int paper = add_material(scene, "paper", {0.8f, 0.8f, 0.75f});
  const float half = 400, eye = 12;
  add_quad(add_mesh(scene, "wall", plaster), {-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0},
           64);
  // Hidden by the pillar, with a small margin, from the camera `main`.
  add_box(add_mesh(scene, "rib", stone), {-0.55f, -half, 0}, {0.55f, half, 0.4f});
  add_cylinder(add_mesh(scene, "pillar", stone), {0, -20, 4}, {0, 20, 4}, 0.4f, 0.4f, 64);
  // As wide as the rib for the camera, and further from the wall than the radius.
  for (int i = 0; i < sheets; ++i) {
    const float z = 3.4f - 0.1f * float(i), wide = 0.58f * (eye - z) / eye;
    add_quad(add_mesh(scene, "sheet", paper), {-wide, -20, z}, {wide, -20, z}, {wide, 20, z}, {-wide, 20, z});
  }
  scene.cameras = {looking_at("main", {0, 0, eye}, {0, 0, 0}, 30)};
  scene.ao_radius = 0.5;
  return scene;
}

}  // namespace

std::vector<SceneRecipe> pillar() {
  return {{.name = "pillar",
           .summary = "a pillar that hides a rib on the wall behind it, and sheets between the two",
           .kind = "object",
           .parameters = {int_parameter("sheets", 0, 0, 20, "", "layers between the pillar and the rib")},
           .make = make}};
}

}  // namespace gloam::scenes
