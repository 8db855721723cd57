// A town courtyard: houses with tiled roofs on four sides, an arcade, a fountain, stairs, tables, a cart.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "scene/built_in/mesh_builder.h"

namespace gloam::scenes {
namespace {

using glm::mat4;
constexpr float pi = glm::pi<float>();

// The court is 16 m by 14 m; the arcade lies behind its far side.
constexpr float half_width = 8, half_depth = 7, arcade_depth = 2.5f, eaves = 6.6f, wall_thickness = 0.45f;

struct Materials {
  int plaster, ochre, stone, paving, tile, wood, dark_wood, green_paint, iron, brass, glass, clay, leaf, water, cloth,
      lamp, rope, earth;
};

Materials add_materials(Scene& scene) {
  Materials m;
  m.plaster = add_material(scene, "plaster", {0.72f, 0.66f, 0.55f}, 0.9f);
  m.ochre = add_material(scene, "ochre plaster", {0.66f, 0.45f, 0.24f}, 0.9f);
  m.stone = add_material(scene, "limestone", {0.60f, 0.57f, 0.50f}, 0.8f);
  m.paving = add_material(scene, "paving", {0.38f, 0.36f, 0.33f}, 0.7f);
  m.tile = add_material(scene, "roof tile", {0.52f, 0.22f, 0.12f}, 0.85f);
  m.wood = add_material(scene, "oak", {0.40f, 0.26f, 0.14f}, 0.6f);
  m.dark_wood = add_material(scene, "dark oak", {0.16f, 0.10f, 0.06f}, 0.5f);
  m.green_paint = add_material(scene, "green paint", {0.12f, 0.28f, 0.20f}, 0.4f);
  m.iron = add_material(scene, "painted iron", {0.08f, 0.08f, 0.09f}, 0.45f);
  m.brass = add_material(scene, "brass", {0.80f, 0.60f, 0.28f}, 0.25f, 1);
  m.glass = add_material(scene, "window pane", {0.05f, 0.06f, 0.07f}, 0.05f);
  m.clay = add_material(scene, "terracotta", {0.60f, 0.30f, 0.18f}, 0.8f);
  m.leaf = add_material(scene, "leaf", {0.14f, 0.30f, 0.08f}, 0.6f);
  m.water = add_material(scene, "water", {0.05f, 0.12f, 0.13f}, 0.03f);
  m.cloth = add_material(scene, "linen", {0.78f, 0.75f, 0.70f}, 0.95f);
  m.rope = add_material(scene, "hemp", {0.42f, 0.34f, 0.22f}, 0.95f);
  m.earth = add_material(scene, "earth", {0.14f, 0.10f, 0.07f}, 1);
  m.lamp = add_material(scene, "lamp glass", {0.9f, 0.85f, 0.7f}, 0.3f);
  scene.materials[size_t(m.lamp)].emission = {0.9f, 0.62f, 0.3f};
  return m;
}

void add_paving(Scene& scene, const Materials& m) {
  const float low_z = -half_depth - arcade_depth, slab = 0.5f;
  add_box(add_mesh(scene, "ground", m.earth), {-12, -0.3f, -13}, {12, -0.05f, 11});
  Mesh& mesh = add_mesh(scene, "paving", m.paving);
  const int columns = int(2 * half_width / slab), rows = int((half_depth - low_z) / slab);
  for (int row = 0; row < rows; ++row) {
    for (int column = -1; column < columns; ++column) {
      // Courses are staggered by half a slab; the ends are cut to fit.
      const float start = -half_width + slab * (float(column) + (row % 2 ? 0.5f : 0));
      const float x0 = std::max(start, -half_width), x1 = std::min(start + slab, half_width);
      if (x1 - x0 < 0.1f) continue;
      const float top = 0.012f * (hash01(uint32_t(row), uint32_t(column + 1), 1) - 1), z0 = low_z + slab * float(row);
      add_chamfered_box(mesh, {x0 + 0.006f, -0.06f, z0 + 0.006f}, {x1 - 0.006f, top, z0 + slab - 0.006f}, 0.012f);
    }
  }
}

/// One leaf of a slatted shutter, hinged at the origin, closed along +x.
void add_shutter(Mesh& mesh, float width, float height) {
  const float bar = 0.06f, depth = 0.04f;
  add_box(mesh, {0, 0, 0}, {bar, height, depth});
  add_box(mesh, {width - bar, 0, 0}, {width, height, depth});
  for (const float y : {0.0f, 0.5f * (height - bar), height - bar}) {
    add_box(mesh, {bar, y, 0.002f}, {width - bar, y + bar, depth - 0.002f});
  }
  Mesh slat;
  add_box(slat, {bar - 0.01f, -0.004f, -0.022f}, {width - bar + 0.01f, 0.004f, 0.022f});
  const int count = int(height / 0.055f);
  for (int i = 1; i < count; ++i) {
    append(mesh, slat, moved({0, height * float(i) / float(count), 0.5f * depth}) * turned(0.6f, {1, 0, 0}));
  }
}

/// A window's frame, bars, sill and shutters about an opening whose lower left corner is at the origin of `at`.
void add_window(Scene& scene, const Materials& m, const mat4& at, float width, float height, uint32_t seed) {
  Mesh frame, pane, sill, shutter;
  const float bar = 0.06f, back = -0.26f;
  add_box(frame, {0, 0, back}, {bar, height, back + 0.08f});
  add_box(frame, {width - bar, 0, back}, {width, height, back + 0.08f});
  add_box(frame, {bar, 0, back}, {width - bar, bar, back + 0.08f});
  add_box(frame, {bar, height - bar, back}, {width - bar, height, back + 0.08f});
  add_box(frame, {0.5f * width - 0.03f, bar, back}, {0.5f * width + 0.03f, height - bar, back + 0.06f});
  for (const float share : {0.36f, 0.68f}) {
    for (int half = 0; half < 2; ++half) {
      const float x0 = half ? 0.5f * width + 0.03f : bar, x1 = half ? width - bar : 0.5f * width - 0.03f;
      add_box(frame, {x0, share * height - 0.015f, back + 0.01f}, {x1, share * height + 0.015f, back + 0.05f});
    }
  }
  add_box(pane, {0, 0, back - 0.03f}, {width, height, back});
  add_chamfered_box(sill, {-0.12f, -0.1f, -0.1f}, {width + 0.12f, 0, 0.12f}, 0.015f);
  add_chamfered_box(sill, {-0.12f, height, -0.05f}, {width + 0.12f, height + 0.16f, 0.05f}, 0.015f);
  place(scene, "window frame", m.dark_wood, frame, at);
  place(scene, "window pane", m.glass, pane, at);
  place(scene, "window sill", m.stone, sill, at);
  add_shutter(shutter, 0.5f * width, height);
  // Open angles: flat against the wall is 180 degrees.
  const float left = pi * (0.66f + 0.3f * hash01(seed, 1)), right = pi * (0.66f + 0.3f * hash01(seed, 2));
  place(scene, "shutter", m.green_paint, shutter, at * moved({0, 0, 0.02f}) * turned_y(-left));
  place(scene, "shutter", m.green_paint, shutter, at * moved({width, 0, 0.02f}) * turned_y(right) * scaled({-1, 1, 1}));
}

/// A plank door in an opening whose lower left corner is at the origin of `at`.
void add_door(Scene& scene, const Materials& m, const mat4& at, float width, float height) {
  Mesh frame, leaf, fittings, surround;
  add_box(frame, {0, 0, -0.3f}, {0.08f, height, -0.16f});
  add_box(frame, {width - 0.08f, 0, -0.3f}, {width, height, -0.16f});
  add_box(frame, {0.08f, height - 0.08f, -0.3f}, {width - 0.08f, height, -0.16f});
  const int planks = 6;
  const float inner = width - 0.16f, step = inner / planks;
  for (int i = 0; i < planks; ++i) {
    const float x = 0.08f + step * float(i);
    add_chamfered_box(leaf, {x, 0.01f, -0.28f}, {x + step, height - 0.08f, -0.22f}, 0.008f);
  }
  for (const float y : {0.3f, height - 0.5f}) {
    add_box(fittings, {0.1f, y, -0.22f}, {0.08f + 0.8f * inner, y + 0.05f, -0.208f});
  }
  add_torus(fittings, {width - 0.2f, 1.0f, -0.19f}, {0, 0, 1}, 0.05f, 0.009f, 20, 8);
  add_cylinder(fittings, {width - 0.2f, 1.06f, -0.22f}, {width - 0.2f, 1.06f, -0.17f}, 0.018f, 0.012f, 12);
  for (const float x : {-0.2f, width}) {
    add_chamfered_box(surround, {x, 0, -0.02f}, {x + 0.2f, height, 0.05f}, 0.012f);
  }
  add_chamfered_box(surround, {-0.28f, height, -0.02f}, {width + 0.28f, height + 0.24f, 0.08f}, 0.02f);
  add_chamfered_box(surround, {-0.25f, -0.05f, -0.4f}, {width + 0.25f, 0.03f, 0.3f}, 0.015f);
  place(scene, "door frame", m.dark_wood, frame, at);
  place(scene, "door", m.wood, leaf, at);
  place(scene, "door fittings", m.iron, fittings, at);
  place(scene, "door surround", m.stone, surround, at);
}

struct Opening {
  float x, y, width, height;
};

/// A house front along +x from the origin of `at`, its face at z = 0. `raised` doors are those at the head of stairs.
void add_front(Scene& scene, const Materials& m, int plaster, const mat4& at, float length,
               const std::vector<Opening>& doors, const std::vector<Opening>& windows, uint32_t seed,
               const std::vector<Opening>& raised = {}) {
  std::vector<std::vector<vec2>> notches, holes;
  for (const Opening& o : doors) notches.push_back(rectangle({o.x, 0}, {o.x + o.width, o.height}));
  for (const Opening& o : raised) holes.push_back(rectangle({o.x, o.y}, {o.x + o.width, o.y + o.height}));
  for (const Opening& o : windows) holes.push_back(rectangle({o.x, o.y}, {o.x + o.width, o.y + o.height}));
  Mesh shape;
  add_extrusion(shape, wall({0, 0}, {length, eaves}, notches), holes, -wall_thickness, 0);
  place(scene, "house wall", plaster, shape, at);
  for (const Opening& o : doors) add_door(scene, m, at * moved({o.x, 0, 0}), o.width, o.height);
  for (const Opening& o : raised) add_door(scene, m, at * moved({o.x, o.y, 0}), o.width, o.height);
  for (const Opening& o : windows) add_window(scene, m, at * moved({o.x, o.y, 0}), o.width, o.height, seed++);
  // Base course, interrupted by the doors, and a string course between the storeys.
  Mesh courses;
  float x = 0;
  for (const Opening& o : doors) {
    add_chamfered_box(courses, {x, -0.05f, -0.05f}, {o.x - 0.2f, 0.5f, 0.04f}, 0.015f);
    x = o.x + o.width + 0.2f;
  }
  add_chamfered_box(courses, {x, -0.05f, -0.05f}, {length, 0.5f, 0.04f}, 0.015f);
  x = 0;
  for (const Opening& o : raised) {
    add_chamfered_box(courses, {x, 3.35f, -0.05f}, {o.x - 0.2f, 3.5f, 0.06f}, 0.02f);
    x = o.x + o.width + 0.2f;
  }
  add_chamfered_box(courses, {x, 3.35f, -0.05f}, {length, 3.5f, 0.06f}, 0.02f);
  place(scene, "string course", m.stone, courses, at);
}

/// A roof that rises from the eaves away from the court, with rafters and a gutter, along +x from `from` to `to`.
void add_roof(Scene& scene, const Materials& m, const mat4& at, float from, float to, uint32_t seed) {
  const float front = 0.6f, depth = 3.6f, rise = 1.7f, slope = std::atan2(rise, depth);
  const mat4 on_slope = at * moved({0, eaves, front}) * turned(slope, {1, 0, 0});
  const float run = std::hypot(depth, rise);
  Mesh slab, rafters, gutter, brackets;
  add_box(slab, {from, 0, -run}, {to, 0.06f, 0});
  place(scene, "roof boards", m.wood, slab, on_slope);
  for (float x = from + 0.3f; x < to; x += 0.6f) {
    add_chamfered_box(rafters, {x, -0.16f, -1.4f}, {x + 0.1f, 0, -0.04f}, 0.01f);
  }
  place(scene, "rafters", m.dark_wood, rafters, on_slope);

  std::vector<vec2> half_ring;
  const int sides = 6;
  for (int i = 0; i <= sides; ++i) {
    const float angle = pi * float(i) / sides;
    half_ring.push_back(0.125f * vec2(std::cos(angle), std::sin(angle)));
  }
  for (int i = sides; i >= 0; --i) half_ring.push_back(0.83f * half_ring[size_t(i)]);
  Mesh tile, tiles;
  add_extrusion(tile, half_ring, -0.55f, 0.04f);
  const int rows = int(run / 0.45f);
  uint32_t count = 0;
  for (int row = 0; row <= rows; ++row) {
    for (float x = from + 0.13f; x < to; x += 0.25f, ++count) {
      const float yaw = 0.04f * (hash01(seed, count, 3) - 0.5f), back = 0.45f * float(row);
      const mat4 lift = turned(-0.05f, {1, 0, 0}) * turned_y(yaw);
      append(tiles, tile, moved({x, 0.06f + 0.03f * hash01(seed, count, 4), -back}) * lift);
    }
  }
  place(scene, "roof tiles", m.tile, tiles, on_slope);

  std::vector<vec2> trough;
  for (int i = 0; i <= 8; ++i) {
    const float angle = pi + pi * float(i) / 8;
    trough.push_back(0.08f * vec2(std::cos(angle), std::sin(angle)));
  }
  for (int i = 8; i >= 0; --i) trough.push_back(0.9f * trough[size_t(i)]);
  add_extrusion(gutter, trough, from, to);
  place(scene, "gutter", m.brass, gutter, at * moved({0, eaves - 0.02f, front + 0.09f}) * turned_y(pi / 2));
}

void add_houses(Scene& scene, const Materials& m) {
  const float side = 2 * half_depth + arcade_depth;
  const mat4 left = moved({-half_width, 0, half_depth}) * turned_y(pi / 2);
  const mat4 right = moved({half_width, 0, -half_depth - arcade_depth}) * turned_y(-pi / 2);
  const mat4 near = moved({half_width, 0, half_depth}) * turned_y(pi);
  add_front(scene, m, m.ochre, left, side, {{2.2f, 0, 1.1f, 2.3f}, {8.6f, 0, 1.3f, 2.5f}},
            {{0.6f, 1.0f, 0.9f, 1.4f},
             {4.6f, 1.0f, 1.0f, 1.5f},
             {6.6f, 1.0f, 1.0f, 1.5f},
             {11.2f, 1.0f, 1.0f, 1.5f},
             {0.9f, 4.2f, 1.0f, 1.6f},
             {3.1f, 4.2f, 1.0f, 1.6f},
             {5.8f, 4.2f, 1.0f, 1.6f},
             {8.7f, 4.2f, 1.0f, 1.6f},
             {11.4f, 4.2f, 1.0f, 1.6f}},
            10);
  add_front(scene, m, m.plaster, right, side, {{4.0f, 0, 1.2f, 2.3f}},
            {{6.6f, 1.0f, 1.0f, 1.4f}, {4.3f, 4.2f, 1.0f, 1.6f}, {6.6f, 4.2f, 1.0f, 1.6f}, {8.8f, 4.2f, 1.0f, 1.6f}},
            40, {{13.1f, 2.52f, 1.1f, 2.2f}});
  add_front(scene, m, m.ochre, near, 2 * half_width, {{7.4f, 0, 1.3f, 2.4f}},
            {{2, 1, 1, 1.5f},
             {5, 1, 1, 1.5f},
             {11, 1, 1, 1.5f},
             {2, 4.2f, 1, 1.6f},
             {5, 4.2f, 1, 1.6f},
             {8, 4.2f, 1, 1.6f},
             {11, 4.2f, 1, 1.6f}},
            70);
  add_roof(scene, m, left, -1, 2 * half_depth + 3.5f, 1);
  add_roof(scene, m, right, arcade_depth - 3.5f, side + 1, 2);
  add_roof(scene, m, near, -1, 2 * half_width + 1, 3);
}

/// The far side: five arches, a passage behind them, windows above.
void add_arcade(Scene& scene, const Materials& m) {
  const mat4 at = moved({-half_width, 0, -half_depth});
  const float bay = 2 * half_width / 5, opening = 2.3f, spring = 1.75f;
  std::vector<std::vector<vec2>> arches, holes;
  for (int i = 0; i < 5; ++i) {
    const float middle = bay * (float(i) + 0.5f);
    arches.push_back(arch({middle - 0.5f * opening, 0}, opening, spring, 20));
    holes.push_back(rectangle({middle - 0.5f, 4.2f}, {middle + 0.5f, 5.8f}));
  }
  Mesh shape;
  add_extrusion(shape, wall({0, 0}, {2 * half_width, eaves}, arches), holes, -0.5f, 0);
  place(scene, "arcade wall", m.plaster, shape, at);
  for (int i = 0; i < 5; ++i) {
    const float middle = bay * (float(i) + 0.5f);
    add_window(scene, m, at * moved({middle - 0.5f, 4.2f, 0}), 1, 1.6f, 100 + uint32_t(i));
    // Voussoirs: wedges around the arch, proud of the wall.
    Mesh stones;
    const int count = 13;
    const float inner = 0.5f * opening + 0.01f, outer = inner + 0.28f;
    for (int k = 0; k < count; ++k) {
      const float a = pi * (float(k) + 0.03f) / count, b = pi * (float(k) + 0.97f) / count;
      const float reach = k == count / 2 ? outer + 0.1f : outer;
      const vec2 ca(std::cos(a), std::sin(a)), cb(std::cos(b), std::sin(b));
      add_extrusion(stones, {inner * ca, reach * ca, reach * cb, inner * cb}, -0.05f, k == count / 2 ? 0.09f : 0.05f);
    }
    place(scene, "voussoirs", m.stone, stones, at * moved({middle, spring, 0}));
  }
  for (int i = 0; i <= 5; ++i) {
    // Imposts and plinths of the piers; the end piers are half as wide.
    const float width = bay - opening, middle = bay * float(i);
    const float x0 = std::max(middle - 0.5f * width, 0.0f), x1 = std::min(middle + 0.5f * width, 2 * half_width);
    Mesh pier;
    add_chamfered_box(pier, {x0 - 0.06f, spring - 0.14f, -0.56f}, {x1 + 0.06f, spring, 0.07f}, 0.02f);
    add_chamfered_box(pier, {x0 - 0.05f, -0.05f, -0.55f}, {x1 + 0.05f, 0.35f, 0.06f}, 0.02f);
    place(scene, "impost", m.stone, pier, at);
  }
  Mesh course;
  add_chamfered_box(course, {0, 3.35f, -0.05f}, {2 * half_width, 3.5f, 0.08f}, 0.02f);
  place(scene, "string course", m.stone, course, at);

  Mesh back, ceiling, beams;
  const float depth = arcade_depth;
  const float door_x[] = {2.0f, 9.0f};
  std::vector<std::vector<vec2>> doors;
  for (const float x : door_x) doors.push_back(rectangle({x, 0}, {x + 1.2f, 2.3f}));
  add_extrusion(back, wall({0, 0}, {2 * half_width, 3.35f}, doors), {rectangle({5.5f, 1.0f}, {6.5f, 2.4f})},
                -depth - wall_thickness, -depth);
  place(scene, "passage wall", m.ochre, back, at);
  for (const float x : door_x) add_door(scene, m, at * moved({x, 0, -depth}), 1.2f, 2.3f);
  add_window(scene, m, at * moved({5.5f, 1.0f, -depth}), 1, 1.4f, 120);
  add_box(ceiling, {0, 3.2f, -depth - wall_thickness}, {2 * half_width, 3.4f, -0.4f});
  place(scene, "passage ceiling", m.plaster, ceiling, at);
  for (float x = 0.4f; x < 2 * half_width; x += 0.8f) {
    add_chamfered_box(beams, {x - 0.07f, 3.02f, -depth}, {x + 0.07f, 3.21f, -0.49f}, 0.012f);
  }
  place(scene, "passage beams", m.dark_wood, beams, at);
  add_roof(scene, m, at, -3.5f, 2 * half_width + 3.5f, 4);
}

void add_fountain(Scene& scene, const Materials& m, vec3 at) {
  Mesh& step = add_mesh(scene, "fountain step", m.stone);
  add_lathe(step, at,
            {{0, -0.05f},
             {2.2f, -0.05f},
             {2.2f, -0.05f},
             {2.2f, 0.14f},
             {2.2f, 0.14f},
             {2.17f, 0.17f},
             {2.17f, 0.17f},
             {0, 0.17f}},
            8);
  add_lathe(add_mesh(scene, "fountain basin", m.stone), at + vec3(0, 0.17f, 0),
            {{0, 0},
             {1.62f, 0},
             {1.62f, 0},
             {1.62f, 0.1f},
             {1.62f, 0.1f},
             {1.54f, 0.18f},
             {1.50f, 0.3f},
             {1.52f, 0.45f},
             {1.60f, 0.52f},
             {1.64f, 0.56f},
             {1.64f, 0.62f},
             {1.60f, 0.65f},
             {1.40f, 0.65f},
             {1.36f, 0.62f},
             {1.36f, 0.62f},
             {1.36f, 0.15f},
             {1.36f, 0.15f},
             {0, 0.15f}},
            48);
  add_lathe(add_mesh(scene, "fountain water", m.water), at + vec3(0, 0.17f, 0), {{1.37f, 0.5f}, {0, 0.5f}}, 48);
  add_lathe(add_mesh(scene, "fountain column", m.stone), at + vec3(0, 0.3f, 0),
            {{0.34f, 0},    {0.34f, 0.3f},  {0.34f, 0.3f},  {0.26f, 0.36f}, {0.17f, 0.45f}, {0.14f, 0.6f},
             {0.18f, 0.8f}, {0.22f, 0.9f},  {0.18f, 1.0f},  {0.13f, 1.06f}, {0.13f, 1.12f}, {0.3f, 1.18f},
             {0.6f, 1.28f}, {0.78f, 1.42f}, {0.82f, 1.48f}, {0.82f, 1.52f}, {0.76f, 1.53f}, {0.72f, 1.47f},
             {0.5f, 1.36f}, {0.16f, 1.32f}, {0.12f, 1.36f}, {0.1f, 1.5f},   {0.15f, 1.62f}, {0.12f, 1.74f},
             {0.06f, 1.8f}, {0.06f, 1.86f}, {0.1f, 1.9f},   {0.11f, 1.98f}, {0.06f, 2.1f},  {0, 2.2f}},
            40);
  for (int i = 0; i < 4; ++i) {  // spouts
    const float angle = pi / 2 * float(i) + 0.3f;
    const vec3 out(std::sin(angle), 0, std::cos(angle)), start = at + vec3(0, 1.2f, 0) + 0.1f * out;
    add_tube(add_mesh(scene, "spout", m.brass),
             {start, start + 0.1f * out + vec3(0, 0.03f, 0), start + 0.2f * out + vec3(0, 0.02f, 0),
              start + 0.26f * out - vec3(0, 0.05f, 0)},
             0.022f, 10);
  }
}

/// Chair facing +z, its seat's middle over the origin.
Mesh chair() {
  Mesh mesh;
  for (const float side : {-1.0f, 1.0f}) {
    add_tube(mesh, {{side * 0.20f, 0, 0.19f}, {side * 0.18f, 0.44f, 0.17f}}, 0.018f);
    add_tube(mesh,
             {{side * 0.20f, 0, -0.23f},
              {side * 0.18f, 0.44f, -0.18f},
              {side * 0.18f, 0.65f, -0.2f},
              {side * 0.19f, 0.9f, -0.27f}},
             0.018f);
    add_tube(mesh, {{side * 0.19f, 0.2f, 0.18f}, {side * 0.19f, 0.2f, -0.205f}}, 0.011f);
  }
  add_tube(mesh, {{-0.19f, 0.26f, 0.18f}, {0.19f, 0.26f, 0.18f}}, 0.011f);
  for (int i = 0; i < 7; ++i) {
    const float z = -0.19f + 0.057f * float(i);
    add_chamfered_box(mesh, {-0.22f, 0.44f, z}, {0.22f, 0.462f, z + 0.047f}, 0.005f);
  }
  for (int i = 0; i < 3; ++i) {
    const float y = 0.58f + 0.11f * float(i), z = -0.2f - 0.025f * float(i);
    add_chamfered_box(mesh, {-0.18f, y, z - 0.012f}, {0.18f, y + 0.07f, z + 0.012f}, 0.005f);
  }
  return mesh;
}

void add_tables(Scene& scene, const Materials& m) {
  const Mesh seat = chair();
  const vec2 places[] = {{2.0f, 3.2f}, {4.6f, 1.0f}, {-4.6f, 3.6f}};
  uint32_t id = 0;
  for (const vec2 p : places) {
    const vec3 at(p.x, 0, p.y);
    add_lathe(add_mesh(scene, "table", m.wood), at,
              {{0, 0},
               {0.27f, 0},
               {0.27f, 0},
               {0.27f, 0.03f},
               {0.2f, 0.06f},
               {0.05f, 0.1f},
               {0.035f, 0.3f},
               {0.05f, 0.36f},
               {0.035f, 0.42f},
               {0.04f, 0.66f},
               {0.1f, 0.7f},
               {0.1f, 0.7f},
               {0.44f, 0.705f},
               {0.45f, 0.72f},
               {0.45f, 0.735f},
               {0.44f, 0.745f},
               {0.44f, 0.745f},
               {0, 0.745f}},
              36);
    for (int i = 0; i < 3; ++i, ++id) {
      const float angle = 2 * pi * (float(i) + 0.3f * hash01(id, 7)) / 3 + p.x;
      const float pulled = 0.66f + 0.16f * hash01(id, 8);
      place(scene, "chair", i % 2 ? m.wood : m.green_paint, seat,
            moved(at) * turned_y(angle) * moved({0, 0, -pulled}) * turned_y(0.3f * (hash01(id, 9) - 0.5f)));
    }
    // On the table: a carafe, cups and plates.
    const vec3 top = at + vec3(0, 0.745f, 0);
    add_lathe(add_mesh(scene, "carafe", m.clay), top + vec3(0.05f, 0, -0.08f),
              {{0, 0},
               {0.06f, 0},
               {0.085f, 0.05f},
               {0.08f, 0.12f},
               {0.035f, 0.19f},
               {0.035f, 0.23f},
               {0.05f, 0.26f},
               {0.044f, 0.26f},
               {0.028f, 0.225f},
               {0, 0.2f}},
              24);
    for (int i = 0; i < 3; ++i) {
      const float angle = 2 * pi * float(i) / 3 + p.x + pi;
      const vec3 spot = top + 0.27f * vec3(std::sin(angle), 0, std::cos(angle));
      add_lathe(add_mesh(scene, "plate", m.cloth), spot,
                {{0, 0}, {0.06f, 0}, {0.11f, 0.015f}, {0.112f, 0.02f}, {0.06f, 0.007f}, {0, 0.007f}}, 28);
      add_lathe(add_mesh(scene, "cup", m.brass), top + 0.2f * vec3(std::sin(angle + 0.9f), 0, std::cos(angle + 0.9f)),
                {{0, 0}, {0.025f, 0}, {0.035f, 0.03f}, {0.038f, 0.08f}, {0.033f, 0.08f}, {0.028f, 0.02f}, {0, 0.015f}},
                20);
    }
  }
}

/// Thin bent leaves around a stem; one layer each.
Mesh plant(uint32_t seed, int leaves, float height, float spread) {
  Mesh mesh;
  for (int i = 0; i < leaves; ++i) {
    const uint32_t k = uint32_t(i);
    const float turn = 2 * pi * hash01(seed, k, 1), rise = height * (0.35f + 0.65f * hash01(seed, k, 2));
    const float reach = spread * (0.4f + 0.6f * hash01(seed, k, 3)), width = 0.02f + 0.035f * hash01(seed, k, 4);
    const auto surface = [&](float u, float v) {
      const float half = width * std::sin(pi * (0.08f + 0.9f * v));
      const vec3 middle(reach * (0.1f + 0.9f * v), rise * (0.3f + 0.7f * std::sin(2.2f * v)), 0);
      const float side = 2 * u - 1;
      return middle + vec3(0, 0.4f * half * side * side, -half * side);
    };
    Mesh leaf;
    add_surface(leaf, surface, 2, 6);
    append(mesh, leaf, turned_y(turn));
  }
  return mesh;
}

void add_pots(Scene& scene, const Materials& m) {
  const vec3 places[] = {{-7.3f, 0, 1.2f},  {-7.4f, 0, -0.6f}, {-7.3f, 0, -3.9f}, {7.3f, 0, -1.2f},
                         {-3.2f, 0, -6.6f}, {0.0f, 0, -6.6f},  {3.2f, 0, -6.6f},  {-7.3f, 0, 5.9f},
                         {0.9f, 0, 4.9f},   {-2.5f, 0, 1.9f},  {6.9f, 0, -5.6f}};
  uint32_t id = 0;
  for (const vec3 at : places) {
    ++id;
    const float size = 0.75f + 0.5f * hash01(id, 20);
    Mesh pot, soil;
    add_lathe(pot, {0, 0, 0},
              {{0, 0},
               {0.17f, 0},
               {0.17f, 0},
               {0.2f, 0.15f},
               {0.25f, 0.36f},
               {0.25f, 0.36f},
               {0.29f, 0.37f},
               {0.3f, 0.42f},
               {0.29f, 0.46f},
               {0.24f, 0.46f},
               {0.24f, 0.46f},
               {0.23f, 0.38f},
               {0, 0.38f}},
              28);
    add_lathe(soil, {0, 0, 0}, {{0.235f, 0.41f}, {0.15f, 0.43f}, {0, 0.44f}}, 20);
    const mat4 here = moved(at) * scaled(vec3(size));
    place(scene, "pot", m.clay, pot, here);
    place(scene, "soil", m.earth, soil, here);
    place(scene, "leaves", m.leaf, plant(id, 70, 0.9f, 0.6f), here * moved({0, 0.4f, 0}));
  }
}

/// Stairs along the right wall up to a landing, solid masonry, with an iron railing.
void add_stairs(Scene& scene, const Materials& m) {
  const float width = 1.2f, tread = 0.29f, riser = 0.18f, wall_x = half_width;
  const int steps = 14;
  const float z_top = 3.2f;  // the landing begins here; steps go down towards -z
  std::vector<vec2> profile = {{z_top + 1.9f, -0.05f}, {z_top + 1.9f, riser * steps}, {z_top, riser * steps}};
  for (int i = steps - 1; i > 0; --i) {
    const float z = z_top - tread * float(steps - 1 - i);
    profile.push_back({z, riser * float(i)});
    profile.push_back({z - tread, riser * float(i)});
  }
  profile.push_back({z_top - tread * (steps - 1), -0.05f});
  Mesh body, nosing, railing;
  // The profile's x is the world's z; the extrusion runs along -x from the wall.
  const mat4 at = moved({wall_x, 0, 0}) * turned_y(-pi / 2);
  add_extrusion(body, profile, 0, width);
  place(scene, "stairs", m.plaster, body, at);
  for (int i = 1; i <= steps; ++i) {
    const float z = z_top - tread * float(steps - i), back = i == steps ? z + 1.9f : z + tread;
    add_chamfered_box(nosing, {z - 0.03f, riser * float(i) - 0.02f, 0},
                      {back, riser * float(i) + 0.025f, width + 0.03f}, 0.01f);
  }
  place(scene, "stair treads", m.stone, nosing, at);
  const auto height_at = [&](float z) {
    return riser * (float(steps) - std::max(0.0f, std::ceil((z_top - z) / tread))) + 0.025f;
  };
  for (float z = z_top - tread * (steps - 0.5f); z < z_top + 1.85f; z += tread / 2) {
    const float floor = height_at(z), smooth = z < z_top ? riser * (steps - (z_top - z) / tread) : riser * steps;
    add_tube(railing, {{z, floor, width - 0.06f}, {z, smooth + 0.98f, width - 0.06f}}, 0.009f, 6);
    add_sphere(railing, {z, smooth + 0.5f, width - 0.06f}, 0.022f, 8, 6);
  }
  add_tube(railing,
           {{z_top - tread * steps, 0.98f, width - 0.06f},
            {z_top, riser * steps + 0.98f, width - 0.06f},
            {z_top + 1.86f, riser * steps + 0.98f, width - 0.06f},
            {z_top + 1.86f, riser * steps + 0.98f, 0}},
           0.022f, 8);
  place(scene, "railing", m.iron, railing, at);
}

void add_wheel(Mesh& mesh, vec3 centre) {
  add_torus(mesh, centre, {1, 0, 0}, 0.52f, 0.035f, 40, 8);
  add_cylinder(mesh, centre - vec3(0.1f, 0, 0), centre + vec3(0.1f, 0, 0), 0.08f, 0.08f, 20);
  for (int i = 0; i < 12; ++i) {
    const float angle = 2 * pi * float(i) / 12;
    const vec3 out(0, std::cos(angle), std::sin(angle));
    add_cylinder(mesh, centre + 0.06f * out, centre + 0.5f * out, 0.022f, 0.018f, 8, false);
  }
}

/// A hand cart, its shafts resting on the ground towards +z.
void add_cart(Scene& scene, const Materials& m, const mat4& at) {
  Mesh wheels, bed, load;
  for (const float x : {-0.62f, 0.62f}) add_wheel(wheels, {x, 0.555f, 0});
  add_cylinder(wheels, {-0.66f, 0.555f, 0}, {0.66f, 0.555f, 0}, 0.03f, 0.03f, 12);
  for (int i = 0; i < 8; ++i) {
    const float x = -0.48f + 0.12f * float(i);
    add_chamfered_box(bed, {x, 0.62f, -0.9f}, {x + 0.115f, 0.655f, 0.9f}, 0.006f);
  }
  for (const float x : {-0.5f, 0.46f}) {
    add_chamfered_box(bed, {x, 0.55f, -0.95f}, {x + 0.06f, 0.63f, 0.95f}, 0.008f);
    for (int i = 0; i < 3; ++i) {
      const float y = 0.68f + 0.11f * float(i);
      add_chamfered_box(bed, {x + 0.005f, y, -0.9f}, {x + 0.035f, y + 0.09f, 0.9f}, 0.005f);
    }
    for (const float z : {-0.85f, 0.0f, 0.82f}) {
      add_chamfered_box(bed, {x + 0.036f, 0.62f, z}, {x + 0.066f, 1.0f, z + 0.05f}, 0.006f);
    }
    add_tube(bed, {{x + 0.03f, 0.58f, 0.9f}, {x + 0.03f, 0.55f, 1.4f}, {x + 0.03f, 0.5f, 2.1f}}, 0.03f, 10);
  }
  add_chamfered_box(bed, {-0.03f, 0, 0.85f}, {0.03f, 0.58f, 0.91f}, 0.008f);  // the prop it stands on
  place(scene, "cart wheels", m.dark_wood, wheels, at);
  place(scene, "cart", m.wood, bed, at);
  for (uint32_t i = 0; i < 40; ++i) {  // pumpkins and melons
    const float radius = 0.09f + 0.05f * hash01(i, 31);
    const vec3 spot(-0.34f + 0.68f * hash01(i, 32), 0.655f + 0.9f * radius + (i > 22 ? 0.16f : 0),
                    (i > 22 ? 0.6f : 0.78f) * (2 * hash01(i, 33) - 1));
    add_sphere(load, spot, radius, 16, 10);
  }
  place(scene, "melons", m.leaf, load, at);
}

Mesh crate() {
  Mesh mesh;
  const float half = 0.3f, board = 0.02f;
  for (int i = 0; i < 4; ++i) {
    const float y0 = 0.01f + 0.115f * float(i), y1 = y0 + 0.1f;
    for (const float s : {-1.0f, 1.0f}) {
      const float low = s < 0 ? -half : half - board;
      add_chamfered_box(mesh, {-half, y0, low}, {half, y1, low + board}, 0.003f);
      add_chamfered_box(mesh, {low, y0, -half + board}, {low + board, y1, half - board}, 0.003f);
    }
    const float x = -half + board + 0.142f * float(i);
    add_chamfered_box(mesh, {x, 0, -half + board}, {x + 0.13f, board, half - board}, 0.003f);
  }
  for (const float x : {-half + board, half - 2 * board - 0.01f}) {
    for (const float z : {-half + board, half - 2 * board - 0.01f}) {
      add_box(mesh, {x, board, z}, {x + 0.03f, 0.47f, z + 0.03f});
    }
  }
  return mesh;
}

void add_barrel(Scene& scene, const Materials& m, vec3 at) {
  add_lathe(add_mesh(scene, "barrel", m.wood), at,
            {{0, 0.03f},
             {0.25f, 0.03f},
             {0.25f, 0.03f},
             {0.25f, 0},
             {0.27f, 0},
             {0.27f, 0},
             {0.31f, 0.2f},
             {0.33f, 0.42f},
             {0.31f, 0.64f},
             {0.27f, 0.84f},
             {0.27f, 0.84f},
             {0.25f, 0.84f},
             {0.25f, 0.84f},
             {0.25f, 0.8f},
             {0.25f, 0.8f},
             {0, 0.8f}},
            32);
  Mesh& hoops = add_mesh(scene, "barrel hoops", m.iron);
  for (const vec2 hoop : {vec2(0.276f, 0.05f), vec2(0.315f, 0.25f), vec2(0.315f, 0.56f), vec2(0.276f, 0.76f)}) {
    add_lathe(hoops, at + vec3(0, hoop.y, 0),
              {{hoop.x, 0}, {hoop.x + 0.008f, 0}, {hoop.x + 0.008f, 0.04f}, {hoop.x, 0.04f}}, 32);
  }
}

void add_goods(Scene& scene, const Materials& m) {
  const Mesh box = crate();
  const vec3 places[] = {{-7.3f, 0, -5.6f}, {-6.6f, 0, -5.9f}, {-7.25f, 0.47f, -5.65f}, {-6.9f, 0, -5.0f},
                         {6.9f, 0, 5.9f},   {3.0f, 0, -5.9f},  {3.1f, 0.47f, -5.95f},   {2.3f, 0, -6.1f}};
  uint32_t id = 50;
  for (const vec3 at : places) place(scene, "crate", m.wood, box, moved(at) * turned_y(0.7f * (hash01(++id) - 0.5f)));
  add_barrel(scene, m, {-5.8f, 0, -6.4f});
  add_barrel(scene, m, {-5.05f, 0, -6.5f});
  add_barrel(scene, m, {7.3f, 0, -2.2f});
  Mesh coil;
  for (int i = 0; i < 5; ++i)
    add_torus(coil, {0, 0.02f + 0.035f * float(i), 0}, {0, 1, 0}, 0.2f + 0.01f * float(i % 2), 0.02f);
  place(scene, "rope coil", m.rope, coil, moved({-5.9f, 0, -5.3f}));
}

void add_lantern(Scene& scene, const Materials& m, vec3 hook) {
  const vec3 base = hook - vec3(0, 0.34f, 0);
  Mesh& metal = add_mesh(scene, "lantern", m.iron);
  add_lathe(metal, base, {{0, -0.02f}, {0.07f, -0.02f}, {0.08f, 0}, {0.08f, 0}, {0, 0}}, 16);
  add_lathe(metal, base + vec3(0, 0.2f, 0), {{0.1f, 0}, {0.1f, 0.015f}, {0.03f, 0.08f}, {0.02f, 0.12f}, {0, 0.13f}},
            16);
  for (int i = 0; i < 6; ++i) {
    const float angle = pi / 3 * float(i);
    const vec3 out = 0.072f * vec3(std::sin(angle), 0, std::cos(angle));
    add_cylinder(metal, base + out, base + out + vec3(0, 0.2f, 0), 0.005f, 0.005f, 6);
  }
  add_lathe(metal, base + vec3(0, 0.2f, 0), {{0, 0}, {0.1f, 0}}, 16);
  add_cylinder(metal, hook - vec3(0, 0.02f, 0), hook, 0.006f, 0.006f, 6);
  add_lathe(add_mesh(scene, "lantern light", m.lamp), base,
            {{0, 0.01f}, {0.045f, 0.01f}, {0.06f, 0.08f}, {0.045f, 0.17f}, {0, 0.18f}}, 16);
}

void add_ropes(Scene& scene, const Materials& m) {
  const vec3 ends[][2] = {{{-half_width, 4.0f, 4.5f}, {half_width, 4.3f, -2.5f}},
                          {{-half_width, 4.0f, -3.0f}, {half_width, 4.2f, 2.0f}}};
  for (const auto& [from, to] : ends) {
    const std::vector<vec3> path = hanging_rope(from, to, 0.7f, 33);
    add_tube(add_mesh(scene, "rope", m.rope), path, 0.012f, 8);
    for (size_t i = 4; i < 32; i += 4) add_lantern(scene, m, path[i]);
  }
  // Washing on a line across the far end.
  const std::vector<vec3> line = hanging_rope({-half_width, 4.9f, -4.6f}, {-1.0f, 4.9f, -half_depth}, 0.25f, 25);
  add_tube(add_mesh(scene, "washing line", m.rope), line, 0.006f, 6);
  for (uint32_t i = 0; i < 5; ++i) {
    const size_t start = 3 + 4 * i;
    const float length = 0.7f + 0.5f * hash01(i, 60);
    const auto sheet = [&](float u, float v) {
      const float k = 3 * u;
      const size_t piece = std::min(size_t(k), size_t(2));
      const vec3 top = glm::mix(line[start + piece], line[start + piece + 1], k - float(piece));
      const float sway = (1 - v) * (0.06f * std::sin(9 * u + float(i)) + 0.03f * std::sin(23 * u));
      return top + vec3(0.35f * sway, -length * (1 - v), 0.9f * sway);
    };
    add_surface(add_mesh(scene, "washing", i % 2 ? m.cloth : m.clay), sheet, 24, 16);
  }
}

Scene make(const ParameterValues&) {
  Scene scene;
  const Materials m = add_materials(scene);
  add_paving(scene, m);
  add_houses(scene, m);
  add_arcade(scene, m);
  add_fountain(scene, m, {-0.6f, 0, -0.8f});
  add_tables(scene, m);
  add_pots(scene, m);
  add_stairs(scene, m);
  add_cart(scene, m, moved({-4.4f, 0, -2.9f}) * turned_y(0.5f));
  add_goods(scene, m);
  add_ropes(scene, m);
  scene.cameras = {looking_at("main", {5.6f, 1.75f, 6.2f}, {-1.6f, 1.75f, -3.0f}, 72),
                   looking_at("table", {3.5f, 1.35f, 4.3f}, {1.9f, 0.65f, 3.0f}, 55),
                   looking_at("arcade", {-5.3f, 1.65f, -8.9f}, {7.0f, 1.9f, 2.0f}, 78)};
  scene.light.to_sun = {0.5f, 1.0f, 0.55f};
  scene.light.sun = {2.5f, 2.25f, 1.8f};
  scene.light.zenith = {0.25f, 0.36f, 0.58f};
  scene.light.horizon = {0.42f, 0.45f, 0.48f};
  scene.ao_radius = 0.6;
  return scene;
}

}  // namespace

std::vector<SceneRecipe> courtyard() {
  return {{.name = "courtyard",
           .summary = "a town courtyard with an arcade, a fountain, stairs, tables and tiled roofs",
           .kind = "architecture",
           .make = make}};
}

}  // namespace gloam::scenes
