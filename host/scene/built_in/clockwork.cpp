// A tower clock's works: toothed wheels, a crank, a fan and a pendulum, which move with the parameter `time`.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "scene/built_in/mesh_builder.h"
#include "scene/built_in/shot_cameras.h"

namespace gloam::scenes {
namespace {

using glm::mat4;
constexpr double pi = glm::pi<double>();
constexpr vec3 along_z(0, 0, 1);

/// All wheels have teeth of one size: so many metres of the pitch circle's diameter for each.
constexpr double tooth = 1.0 / 30;
constexpr double wheel_half = 0.04;                     // of a wheel's thickness
constexpr double crank_radius = 0.3, rod_length = 0.8;  // of the third wheel
constexpr double swing_degrees = 7, swing_seconds = 2;  // of the pendulum
constexpr double wheel_speed = 0.4, fan_speed = 1.2;    // radians a second

struct Materials {
  int stone, board, timber, brass, steel, iron, bronze;
};

Materials add_materials(Scene& scene) {
  Materials m;
  m.stone = add_material(scene, "stone", {0.46f, 0.43f, 0.38f}, 0.9f);
  m.board = add_material(scene, "boards", {0.32f, 0.22f, 0.14f}, 0.7f);
  m.timber = add_material(scene, "timber", {0.24f, 0.15f, 0.09f}, 0.8f);
  m.brass = add_material(scene, "brass", {0.78f, 0.57f, 0.25f}, 0.35f, 0.5f);
  m.steel = add_material(scene, "steel", {0.55f, 0.56f, 0.58f}, 0.3f, 0.5f);
  m.iron = add_material(scene, "painted iron", {0.12f, 0.2f, 0.17f}, 0.5f);
  m.bronze = add_material(scene, "bronze", {0.42f, 0.3f, 0.17f}, 0.4f, 0.4f);
  return m;
}

vec2 polar(double radius, double angle) { return {float(radius * std::cos(angle)), float(radius * std::sin(angle))}; }

struct Wheel {
  int teeth, spokes;
  double x = 0, y = 0, turn = 0;  ///< turn: of a tooth's middle from +x, radians
  double radius() const { return tooth * teeth / 2; }
};

/// A wheel that meshes with another at its side, in a direction (degrees from +x).
Wheel beside(const Wheel& driver, int teeth, int spokes, double degrees) {
  Wheel wheel{teeth, spokes};
  const double direction = degrees * pi / 180, apart = driver.radius() + wheel.radius();
  wheel.x = driver.x + apart * std::cos(direction);
  wheel.y = driver.y + apart * std::sin(direction);
  // A gap of one is where a tooth of the other is.
  wheel.turn = direction + pi - (pi - (direction - driver.turn) * driver.teeth) / teeth;
  return wheel;
}

struct Works {
  Wheel great, second, third, small;
};

Works works_at(double seconds) {
  Works w;
  w.great = {36, 6, -0.55, 1.75, wheel_speed * seconds};
  w.second = beside(w.great, 24, 5, 20);
  w.third = beside(w.second, 30, 5, -60);
  w.small = beside(w.great, 18, 4, 110);
  return w;
}

std::vector<vec2> toothed(const Wheel& wheel) {
  const double pitch = 2 * pi / wheel.teeth, root = wheel.radius() - tooth, tip = wheel.radius() + 0.8 * tooth;
  std::vector<vec2> outline;
  for (int i = 0; i < wheel.teeth; ++i) {
    for (const auto& [radius, part] : {std::pair(root, -0.29), {tip, -0.13}, {tip, 0.13}, {root, 0.29}})
      outline.push_back(polar(radius, (i + part) * pitch));
  }
  return outline;
}

/// What is cut out between two spokes.
std::vector<vec2> opening(double inner, double outer, double from, double to) {
  constexpr int steps = 8;
  std::vector<vec2> outline;
  for (int i = 0; i <= steps; ++i) outline.push_back(polar(outer, glm::mix(from, to, double(i) / steps)));
  for (int i = steps; i >= 0; --i) outline.push_back(polar(inner, glm::mix(from, to, double(i) / steps)));
  return outline;
}

/// A wheel at rest, about the z axis.
Mesh wheel_shape(const Wheel& wheel) {
  Mesh mesh;
  std::vector<std::vector<vec2>> openings;
  const double sector = 2 * pi / wheel.spokes;
  for (int i = 0; i < wheel.spokes; ++i)
    openings.push_back(opening(0.3 * wheel.radius(), 0.76 * wheel.radius(), (i + 0.16) * sector, (i + 0.84) * sector));
  add_extrusion(mesh, toothed(wheel), openings, float(-wheel_half), float(wheel_half));
  const float hub = float(0.18 * wheel.radius());
  add_cylinder(mesh, {0, 0, -0.09f}, {0, 0, 0.09f}, hub, hub, 40);
  add_torus(mesh, {0, 0, float(wheel_half)}, along_z, float(0.86 * wheel.radius()), 0.012f, 72, 8);
  return mesh;
}

void add_wheel(Scene& scene, const std::string& name, int material, const Wheel& wheel) {
  place(scene, name, material, wheel_shape(wheel),
        moved({float(wheel.x), float(wheel.y), 0}) * turned(float(wheel.turn), along_z));
}

/// A crank pin on the third wheel, the rod, and the block that the rod moves up and down.
void add_crank(Scene& scene, const Materials& m, const Wheel& wheel) {
  const double across = crank_radius * std::cos(wheel.turn), up = crank_radius * std::sin(wheel.turn);
  const double height = wheel.y + up - std::sqrt(rod_length * rod_length - across * across);
  Mesh pin, rod, block;
  add_cylinder(pin, {0, 0, -0.14f}, {0, 0, 0.1f}, 0.025f, 0.025f, 24);
  const vec3 at(float(wheel.x + across), float(wheel.y + up), 0.15f);
  place(scene, "crank pin", m.steel, pin, moved(at) * turned(float(wheel.turn), along_z));
  std::vector<vec2> bar;
  for (int i = 0; i <= 16; ++i) bar.push_back(polar(0.05, pi * i / 16) + vec2(0, float(rod_length)));
  for (int i = 0; i <= 16; ++i) bar.push_back(polar(0.05, pi + pi * i / 16));
  add_extrusion(rod, bar, {circle({0, 0.2f}, 0.02f), circle({0, 0.4f}, 0.02f), circle({0, 0.6f}, 0.02f)}, -0.02f,
                0.02f);
  const float lean = -float(std::asin(across / rod_length));
  place(scene, "rod", m.steel, rod, moved({float(wheel.x), float(height), 0.15f}) * turned(lean, along_z));
  add_chamfered_box(block, {-0.13f, -0.09f, -0.08f}, {0.13f, 0.09f, 0.11f}, 0.012f);
  place(scene, "block", m.iron, block, moved({float(wheel.x), float(height), 0}));
}

/// Two vanes that turn about an upright axle and brake the works.
void add_fan(Scene& scene, const Materials& m, double seconds) {
  Mesh fan;
  add_cylinder(fan, {0, -0.42f, 0}, {0, 0.32f, 0}, 0.018f, 0.018f, 20);
  for (const float side : {-1.0f, 1.0f}) {
    add_chamfered_box(fan, {side > 0 ? 0.06f : -0.3f, -0.2f, -0.008f}, {side > 0 ? 0.3f : -0.06f, 0.2f, 0.008f},
                      0.002f);
    for (const float y : {-0.12f, 0.12f}) add_cylinder(fan, {0, y, 0}, {0.07f * side, y, 0}, 0.01f, 0.01f, 12);
  }
  place(scene, "fan", m.brass, fan, moved({1.0f, 2.72f, 0.12f}) * turned_y(float(fan_speed * seconds + 0.5)));
}

void add_pendulum(Scene& scene, const Materials& m, double seconds) {
  Mesh pendulum;
  constexpr float length = 1.5f;
  add_cylinder(pendulum, {0, -length, 0}, {0, 0.12f, 0}, 0.014f, 0.014f, 20);
  add_cylinder(pendulum, {0, -length, -0.035f}, {0, -length, 0.035f}, 0.19f, 0.19f, 64);
  add_torus(pendulum, {0, -length, 0.035f}, along_z, 0.15f, 0.014f, 64, 10);
  add_sphere(pendulum, {0, -length - 0.24f, 0}, 0.03f, 24, 12);
  const double angle = swing_degrees * pi / 180 * std::sin(2 * pi * seconds / swing_seconds);
  place(scene, "pendulum", m.bronze, pendulum, moved({-0.1f, 2.95f, 0.4f}) * turned(float(angle), along_z));
}

/// Two frames of timber, between which the works turn, and the axles.
void add_frame(Scene& scene, const Materials& m, const Works& works) {
  Mesh& timber = add_mesh(scene, "frame", m.timber);
  for (const float x : {-1.45f, 1.35f}) {
    for (const float z : {-0.3f, 0.2f})
      add_chamfered_box(timber, {x - 0.07f, 0, z - 0.06f}, {x + 0.07f, 3.2f, z + 0.06f}, 0.01f);
    for (const float y : {0.3f, 3.05f})
      add_chamfered_box(timber, {x - 0.05f, y, -0.24f}, {x + 0.05f, y + 0.12f, 0.14f}, 0.008f);
  }
  for (const float y : {0.14f, 3.2f}) {
    for (const float z : {-0.3f, 0.2f})
      add_chamfered_box(timber, {-1.6f, y, z - 0.06f}, {1.5f, y + 0.14f, z + 0.06f}, 0.01f);
  }
  for (const Wheel* wheel : {&works.great, &works.second, &works.third, &works.small})
    add_chamfered_box(timber, {-1.4f, float(wheel->y) - 0.05f, -0.28f}, {1.3f, float(wheel->y) + 0.05f, -0.2f}, 0.006f);
  add_chamfered_box(timber, {-0.16f, 2.9f, 0.2f}, {-0.04f, 3.22f, 0.42f}, 0.01f);  // the pendulum's cock
  Mesh& axles = add_mesh(scene, "axles", m.steel);
  for (const Wheel* wheel : {&works.great, &works.second, &works.third, &works.small})
    add_cylinder(axles, {float(wheel->x), float(wheel->y), -0.25f}, {float(wheel->x), float(wheel->y), 0.13f}, 0.03f,
                 0.03f, 24);
  Mesh& guides = add_mesh(scene, "guides", m.iron);
  for (const float side : {-1.0f, 1.0f}) {
    const float x = float(works.third.x) + 0.17f * side;
    add_chamfered_box(guides, {x - 0.03f, 0.05f, -0.06f}, {x + 0.03f, 1.05f, 0.06f}, 0.006f);
    for (int i = 0; i < 6; ++i) add_sphere(guides, {x, 0.15f + 0.16f * float(i), 0.06f}, 0.014f, 12, 8);
  }
  add_chamfered_box(guides, {float(works.third.x) - 0.3f, 0, -0.12f}, {float(works.third.x) + 0.3f, 0.05f, 0.12f},
                    0.01f);
  add_chamfered_box(guides, {0.95f, 2.24f, 0.07f}, {1.3f, 2.3f, 0.17f}, 0.006f);  // below the fan
}

void add_bell(Scene& scene, const Materials& m) {
  add_lathe(add_mesh(scene, "bell", m.bronze), {-2.25f, 1.35f, -0.15f},
            {{0.36f, 0},
             {0.38f, 0.02f},
             {0.38f, 0.02f},
             {0.33f, 0.1f},
             {0.26f, 0.3f},
             {0.22f, 0.46f},
             {0.12f, 0.54f},
             {0, 0.56f}},
            64);
  Mesh& stand = add_mesh(scene, "bell stand", m.timber);
  for (const float x : {-2.75f, -1.75f})
    add_chamfered_box(stand, {x - 0.05f, 0, -0.2f}, {x + 0.05f, 2.1f, -0.1f}, 0.01f);
  add_chamfered_box(stand, {-2.85f, 2.0f, -0.22f}, {-1.65f, 2.12f, -0.08f}, 0.01f);
  add_cylinder(stand, {-2.25f, 1.9f, -0.15f}, {-2.25f, 2.0f, -0.15f}, 0.04f, 0.04f, 16);
}

void add_room(Scene& scene, const Materials& m) {
  Mesh& wall = add_mesh(scene, "wall", m.stone);
  add_quad(wall, {-5, 0, -0.93f}, {5, 0, -0.93f}, {5, 5, -0.93f}, {-5, 5, -0.93f});  // behind the joints
  for (int row = 0; row < 11; ++row) {
    const float y = 0.45f * float(row);
    float x = -4.6f - 0.4f * float(row % 2);
    for (uint32_t i = 0; x < 4.9f; ++i) {
      const float wide = 0.6f + 0.4f * hash01(uint32_t(row), i);
      const float out = -0.8f + 0.03f * hash01(uint32_t(row), i, 1);
      add_chamfered_box(wall, {x + 0.008f, y + 0.008f, -0.95f}, {x + wide - 0.008f, y + 0.442f, out}, 0.015f);
      x += wide;
    }
  }
  Mesh& floor = add_mesh(scene, "floor", m.board);
  add_quad(floor, {-5, -0.03f, 5}, {5, -0.03f, 5}, {5, -0.03f, -1}, {-5, -0.03f, -1});
  for (int i = 0; i < 50; ++i) {
    const float x = -5 + 0.2f * float(i), split = 0.5f + 3 * hash01(uint32_t(i), 7);
    add_chamfered_box(floor, {x + 0.003f, -0.04f, -1}, {x + 0.197f, 0, split - 0.003f}, 0.003f);
    add_chamfered_box(floor, {x + 0.003f, -0.04f, split + 0.003f}, {x + 0.197f, 0, 5}, 0.003f);
  }
}

Scene make(const ParameterValues& values) {
  Scene scene;
  const double seconds = values.number("time");
  const Materials m = add_materials(scene);
  const Works works = works_at(seconds);
  add_room(scene, m);
  add_frame(scene, m, works);
  add_bell(scene, m);
  add_wheel(scene, "great wheel", m.brass, works.great);
  add_wheel(scene, "second wheel", m.steel, works.second);
  add_wheel(scene, "third wheel", m.brass, works.third);
  add_wheel(scene, "small wheel", m.iron, works.small);
  add_crank(scene, m, works.third);
  add_fan(scene, m, seconds);
  add_pendulum(scene, m, seconds);
  scene.cameras = {looking_at("main", {-0.5f, 1.65f, 3.8f}, {-0.1f, 1.7f, 0}, 68),
                   looking_at("mesh", {0.5f, 2.2f, 1.1f}, {0.0f, 1.95f, 0}, 60)};
  scene.light.to_sun = {0.55f, 0.8f, 0.9f};
  scene.light.sun = {2.5f, 2.25f, 1.9f};
  scene.ao_radius = 0.25;
  return scene;
}

}  // namespace

std::vector<SceneRecipe> clockwork() {
  return {{.name = "clockwork",
           .summary = "a tower clock's works: toothed wheels, a crank, a fan and a pendulum, which move",
           .kind = "object",
           .parameters = {float_parameter("time", 0, 0, 3600, "seconds", "the moment of the movement")},
           .make = make,
           .shots = {{.name = "gears",
                      .summary = "the works run, so objects move, while a camera on rails goes sideways",
                      .camera =
                          [](double seconds) {
                            return dolly("gears", {-0.5, 1.65, 3.8}, {-0.1, 1.7, 0}, {0.2, 0, 0}, 68, seconds);
                          },
                      .moves_objects = true}}}};
}

}  // namespace gloam::scenes
