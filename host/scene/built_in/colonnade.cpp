// A nave between two storeys of arches, open to the sky, with vaulted aisles, hanging cloth, vases, ropes with lamps.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "scene/built_in/mesh_builder.h"

namespace gloam::scenes {
namespace {

using glm::mat4;
constexpr float pi = glm::pi<float>();

// The nave runs along -z from z = 3 in bays of 3 m; the aisles lie behind the columns at x = +-3.2.
constexpr int bays = 8;
constexpr float bay = 3, front = 3, back = front - bay * bays, column_x = 3.2f, wall_x = 6.4f, wall_half = 0.32f;
constexpr float spring = 2.75f, upper_floor = 4.6f, upper_spring = upper_floor + 2.0f, parapet = 8.2f;

struct Materials {
  int brick, stone, pale, dark, floor_light, floor_dark, red, green, blue, wood, iron, gold, lamp, clay, leaf, earth,
      rope;
};

Materials add_materials(Scene& scene) {
  Materials m;
  m.brick = add_material(scene, "ochre brick", {0.56f, 0.42f, 0.29f}, 0.9f);
  m.stone = add_material(scene, "sandstone", {0.60f, 0.54f, 0.44f}, 0.8f);
  m.pale = add_material(scene, "pale stone", {0.68f, 0.65f, 0.58f}, 0.7f);
  m.dark = add_material(scene, "dark stone", {0.28f, 0.25f, 0.23f}, 0.5f);
  m.floor_light = add_material(scene, "light slab", {0.52f, 0.47f, 0.39f}, 0.45f);
  m.floor_dark = add_material(scene, "dark slab", {0.26f, 0.21f, 0.18f}, 0.4f);
  m.red = add_material(scene, "red cloth", {0.50f, 0.07f, 0.06f}, 0.95f);
  m.green = add_material(scene, "green cloth", {0.10f, 0.28f, 0.13f}, 0.95f);
  m.blue = add_material(scene, "blue cloth", {0.09f, 0.15f, 0.38f}, 0.95f);
  m.wood = add_material(scene, "cedar", {0.30f, 0.18f, 0.10f}, 0.6f);
  m.iron = add_material(scene, "painted iron", {0.10f, 0.10f, 0.10f}, 0.45f);
  m.gold = add_material(scene, "gilt", {0.90f, 0.68f, 0.30f}, 0.35f, 0.3f);
  m.lamp = add_material(scene, "flame glass", {0.9f, 0.7f, 0.4f}, 0.4f);
  m.clay = add_material(scene, "terracotta", {0.58f, 0.30f, 0.19f}, 0.75f);
  m.leaf = add_material(scene, "leaf", {0.13f, 0.29f, 0.08f}, 0.55f);
  m.earth = add_material(scene, "soil", {0.14f, 0.10f, 0.07f}, 1);
  m.rope = add_material(scene, "rope", {0.40f, 0.32f, 0.20f}, 0.95f);
  scene.materials[size_t(m.lamp)].emission = {0.98f, 0.62f, 0.25f};
  return m;
}

/// From a frame whose x runs along the nave (0 at the front), y up and z towards the nave, to one side of it.
mat4 on_side(float side, float x) {
  // Mirrored on the left, so that both sides are counted from the front.
  return moved({side * x, 0, front}) * turned_y(-pi / 2) * (side > 0 ? scaled({-1, 1, 1}) : scaled({-1, 1, -1}));
}

void add_floor(Scene& scene, const Materials& m) {
  Mesh slabs[2];
  const float slab = 0.75f;
  const int columns = 17, rows = int((front - back) / slab) + 2;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const float x = slab * (float(column) - 0.5f * float(columns)), z = back - 0.4f + slab * float(row);
      const float top = -0.006f * hash01(uint32_t(row), uint32_t(column));
      add_chamfered_box(slabs[(row + column) % 2], {x + 0.004f, -0.1f, z + 0.004f},
                        {x + slab - 0.004f, top, z + slab - 0.004f}, 0.008f);
    }
  }
  place(scene, "floor slabs", m.floor_light, slabs[0], mat4(1));
  place(scene, "floor slabs", m.floor_dark, slabs[1], mat4(1));
  add_box(add_mesh(scene, "ground", m.dark), {-9, -0.4f, back - 3}, {9, -0.1f, front + 3});
}

/// A round column with base and leafed capital, `height` to the top of its abacus; `leaves` in each of two rows.
Mesh column(float radius, float height, int leaves, int segments) {
  Mesh mesh;
  const float r = radius, base = 1.3f * r, neck = height - 1.9f * r;
  add_chamfered_box(mesh, {-1.45f * r, 0, -1.45f * r}, {1.45f * r, 0.45f * r, 1.45f * r}, 0.05f * r);
  std::vector<vec2> profile = {{0, 0.45f * r}, {base, 0.45f * r}, {base, 0.45f * r}};
  for (int i = 0; i <= 4; ++i) {  // the lower roll
    const float angle = pi * (float(i) / 4 - 0.5f);
    profile.push_back({base + 0.12f * r * std::cos(angle), 0.6f * r + 0.14f * r * std::sin(angle)});
  }
  profile.insert(profile.end(), {{1.16f * r, 0.8f * r}, {1.12f * r, 0.9f * r}});
  for (int i = 0; i <= 4; ++i) {  // the upper roll
    const float angle = pi * (float(i) / 4 - 0.5f);
    profile.push_back({1.1f * r + 0.09f * r * std::cos(angle), 1.0f * r + 0.1f * r * std::sin(angle)});
  }
  profile.insert(profile.end(), {{1.03f * r, 1.15f * r}, {r, 1.3f * r}});
  for (int i = 1; i <= 6; ++i)
    profile.push_back({r * (1 - 0.14f * std::pow(float(i) / 6, 2.0f)), glm::mix(1.3f * r, neck, float(i) / 6)});
  profile.insert(profile.end(), {{0.95f * r, neck + 0.02f},
                                 {0.98f * r, neck + 0.06f},
                                 {0.9f * r, neck + 0.1f},
                                 {0.95f * r, neck + 0.6f * r},
                                 {1.1f * r, neck + 1.1f * r},
                                 {1.4f * r, height - 0.4f * r},
                                 {1.4f * r, height - 0.4f * r},
                                 {0, height - 0.4f * r}});
  add_lathe(mesh, vec3(0), profile, segments);
  Mesh leaf, curl;
  add_sphere(leaf, vec3(0), 1, 8, 5);
  add_sphere(curl, vec3(0), 1, 6, 4);
  for (int row = 0; row < 2; ++row) {
    for (int i = 0; i < leaves; ++i) {
      const float angle = 2 * pi * (float(i) + 0.5f * float(row)) / float(leaves);
      const mat4 at = turned_y(angle) * moved({0, neck + (row ? 1.0f : 0.55f) * r, (row ? 1.13f : 1.0f) * r}) *
                      turned(0.35f, {1, 0, 0});
      append(mesh, leaf, at * scaled({0.26f * r, 0.45f * r, 0.13f * r}));
      append(mesh, curl, at * moved({0, 0.42f * r, 0.1f * r}) * scaled({0.15f * r, 0.1f * r, 0.14f * r}));
    }
  }
  add_chamfered_box(mesh, {-1.5f * r, height - 0.4f * r, -1.5f * r}, {1.5f * r, height, 1.5f * r}, 0.06f * r);
  return mesh;
}

/// Wedge stones about an arch whose feet are at (-radius, 0) and (radius, 0), proud of a wall with its face at z = 0.
Mesh arch_ring(float radius, float width, int count, float proud) {
  Mesh mesh;
  for (int k = 0; k < count; ++k) {
    const float a = pi * (float(k) + 0.03f) / float(count), b = pi * (float(k) + 0.97f) / float(count);
    const bool is_key = k == count / 2;
    const float inner = radius + 0.005f, outer = inner + width * (is_key ? 1.35f : 1.0f);
    const vec2 ca(std::cos(a), std::sin(a)), cb(std::cos(b), std::sin(b));
    add_extrusion(mesh, {inner * ca, outer * ca, outer * cb, inner * cb}, -0.03f, is_key ? 1.8f * proud : proud);
  }
  return mesh;
}

/// Both storeys of one side.
void add_arcades(Scene& scene, const Materials& m, float side) {
  const mat4 at = on_side(side, column_x);
  const float length = bay * bays, opening = 2.3f, small = 1.06f;
  std::vector<std::vector<vec2>> arches, small_arches;
  for (int i = 0; i < bays; ++i) {
    arches.push_back(arch({bay * (float(i) + 0.5f) - 0.5f * opening, spring}, opening, spring + 0.02f, 24));
    for (const float share : {0.25f, 0.75f}) {
      small_arches.push_back(
          arch({bay * (float(i) + share) - 0.5f * small, upper_spring}, small, upper_spring + 0.02f, 16));
    }
  }
  Mesh lower, upper;
  add_extrusion(lower, wall({0, spring}, {length, upper_floor - 0.1f}, arches), -wall_half, wall_half);
  add_extrusion(upper, wall({0, upper_spring}, {length, parapet}, small_arches), -0.22f, 0.22f);
  place(scene, "lower arcade", m.brick, lower, at);
  place(scene, "upper arcade", m.brick, upper, at);
  const Mesh ring = arch_ring(0.5f * opening, 0.26f, 15, 0.05f), small_ring = arch_ring(0.5f * small, 0.15f, 9, 0.035f);
  const Mesh post = column(0.29f, spring, 8, 26), slim = column(0.13f, 1.9f, 5, 14);
  for (int i = 0; i <= bays; ++i)
    place(scene, "column", i % 2 ? m.stone : m.pale, post, at * moved({bay * float(i), 0, 0}));
  for (int i = 0; i <= 2 * bays; ++i) {
    place(scene, "upper column", m.pale, slim, at * moved({0.5f * bay * float(i), upper_floor + 0.1f, 0}));
  }
  for (int i = 0; i < bays; ++i) {
    place(scene, "arch stones", m.stone, ring, at * moved({bay * (float(i) + 0.5f), spring + 0.02f, wall_half}));
    for (const float share : {0.25f, 0.75f}) {
      place(scene, "arch stones", m.stone, small_ring,
            at * moved({bay * (float(i) + share), upper_spring + 0.02f, 0.22f}));
    }
    Mesh medallion;  // between two arches: a lion's head in a ring
    const vec3 c(bay * float(i + 1), spring + 1.0f, wall_half);
    if (i == bays - 1) continue;
    add_cylinder(medallion, c - vec3(0, 0, 0.02f), c + vec3(0, 0, 0.03f), 0.23f, 0.22f, 28);
    add_torus(medallion, c + vec3(0, 0, 0.03f), {0, 0, 1}, 0.22f, 0.03f, 28, 6);
    for (int k = 0; k < 12; ++k) {
      const float angle = 2 * pi * float(k) / 12;
      add_sphere(medallion, c + vec3(0.12f * std::cos(angle), 0.12f * std::sin(angle), 0.05f), 0.045f, 7, 4);
    }
    add_sphere(medallion, c + vec3(0, 0, 0.07f), 0.09f, 16, 10);
    add_sphere(medallion, c + vec3(0, -0.03f, 0.14f), 0.05f, 12, 8);
    for (const float x : {-0.035f, 0.035f}) add_sphere(medallion, c + vec3(x, 0.03f, 0.145f), 0.016f, 8, 6);
    place(scene, "medallion", m.gold, medallion, at);
  }
  // Floor edge, balustrade and cornice.
  Mesh bands, rail;
  add_chamfered_box(bands, {0, upper_floor - 0.14f, -0.4f}, {length, upper_floor - 0.02f, wall_half + 0.1f}, 0.02f);
  add_chamfered_box(bands, {0, upper_floor - 0.02f, -0.45f}, {length, upper_floor + 0.1f, wall_half + 0.18f}, 0.02f);
  add_chamfered_box(bands, {0, parapet, -0.35f}, {length, parapet + 0.14f, 0.34f}, 0.02f);
  add_chamfered_box(bands, {0, parapet + 0.14f, -0.45f}, {length, parapet + 0.26f, 0.46f}, 0.02f);
  for (int i = 0; i < 2 * int(length); ++i) {  // dentils
    const float x = 0.5f * float(i) + 0.12f;
    add_box(bands, {x, upper_floor - 0.22f, wall_half}, {x + 0.24f, upper_floor - 0.13f, wall_half + 0.07f});
    add_box(bands, {x, parapet - 0.1f, 0.2f}, {x + 0.24f, parapet + 0.01f, 0.29f});
  }
  const float floor = upper_floor + 0.1f;
  add_chamfered_box(rail, {0, floor, 0.24f}, {length, floor + 0.08f, 0.42f}, 0.01f);
  add_chamfered_box(rail, {0, floor + 0.82f, 0.22f}, {length, floor + 0.94f, 0.44f}, 0.015f);
  Mesh baluster;
  add_lathe(baluster, vec3(0),
            {{0.05f, 0},
             {0.055f, 0.03f},
             {0.03f, 0.07f},
             {0.035f, 0.1f},
             {0.065f, 0.22f},
             {0.06f, 0.32f},
             {0.028f, 0.52f},
             {0.03f, 0.62f},
             {0.05f, 0.66f},
             {0.03f, 0.69f},
             {0.05f, 0.74f}},
            8);
  for (float x = 0.15f; x < length; x += 0.23f) append(rail, baluster, moved({x, floor + 0.08f, 0.33f}));
  place(scene, "bands", m.pale, bands, at);
  place(scene, "balustrade", m.pale, rail, at);
}

/// What lies behind the columns of one side: vaults, outer wall with niches, the upper gallery.
void add_aisle(Scene& scene, const Materials& m, float side) {
  const mat4 at = on_side(side, wall_x);  // z = 0 is the outer wall's face
  const float length = bay * bays, depth = wall_x - column_x;
  std::vector<std::vector<vec2>> niches, doors;
  for (int i = 0; i < bays; ++i) {
    const float x = bay * (float(i) + 0.5f);
    niches.push_back(arch({x - 0.6f, 0}, 1.2f, 1.9f, 16));
    doors.push_back(arch({x - 0.45f, upper_floor + 0.1f}, 0.9f, upper_floor + 1.9f, 12));
  }
  Mesh lower, upper, behind, slab, beams;
  add_extrusion(lower, wall({0, 0}, {length, upper_floor - 0.2f}, niches), -0.4f, 0);
  add_extrusion(upper, wall({0, upper_floor + 0.1f}, {length, parapet}, doors), -0.4f, 0);
  add_box(behind, {-0.5f, -0.1f, -0.7f}, {length + 0.5f, parapet + 0.2f, -0.4f});
  add_box(slab, {0, upper_floor - 0.2f, -0.4f}, {length, upper_floor + 0.1f, depth - 0.45f});
  add_box(slab, {-0.5f, parapet, -0.7f}, {length + 0.5f, parapet + 0.2f, depth - 0.35f});
  for (float x = 0.3f; x < length; x += 0.6f) {
    add_chamfered_box(beams, {x - 0.06f, parapet - 0.2f, 0}, {x + 0.06f, parapet, depth - 0.22f}, 0.01f);
  }
  place(scene, "aisle wall", m.brick, lower, at);
  place(scene, "gallery wall", m.brick, upper, at);
  place(scene, "outer wall", m.stone, behind, at);
  place(scene, "gallery floor", m.stone, slab, at);
  place(scene, "gallery beams", m.wood, beams, at);
  Mesh plinth;
  add_chamfered_box(plinth, {0, upper_floor + 0.9f, -0.02f}, {length, upper_floor + 0.98f, 0.03f}, 0.01f);
  for (int i = 0; i <= bays; ++i) {  // pilasters
    const float x = bay * float(i);
    add_chamfered_box(plinth, {x - 0.28f, 0, -0.05f}, {x + 0.28f, 0.4f, 0.18f}, 0.02f);
    add_chamfered_box(plinth, {x - 0.22f, 0.4f, -0.05f}, {x + 0.22f, spring - 0.25f, 0.12f}, 0.015f);
    add_chamfered_box(plinth, {x - 0.3f, spring - 0.25f, -0.05f}, {x + 0.3f, spring, 0.2f}, 0.025f);
  }
  place(scene, "pilasters", m.stone, plinth, at);
  for (int i = 0; i < bays; ++i) {
    // Two crossing barrels, seen from below.
    const auto vault = [&](float u, float v) {
      const float x = 2 * u - 1, z = 2 * v - 1;
      const float rise = std::sqrt(std::max(0.0f, 1 - std::min(x * x, z * z)));
      return vec3(bay * (float(i) + u), spring + 1.5f * rise, depth * v);
    };
    Mesh shape;
    add_surface(shape, vault, 16, 16);
    // u along x, v along z: the front of the surface already points down.
    place(scene, "vault", m.pale, shape, at);
    place(scene, "niche stones", m.pale, arch_ring(0.6f, 0.2f, 11, 0.04f),
          at * moved({bay * (float(i) + 0.5f), 1.9f, 0}));
  }
}

void add_ends(Scene& scene, const Materials& m) {
  Mesh far_wall, door;
  const float half = wall_x + 0.7f;
  add_extrusion(
      far_wall, wall({-half, -0.1f}, {half, parapet + 0.2f}, {arch({-1.2f, -0.1f}, 2.4f, 2.4f, 24)}),
      {arch({-0.9f, 5.0f}, 1.8f, 6.2f, 20), arch({-4.9f, 5.2f}, 0.9f, 6.4f, 14), arch({4.0f, 5.2f}, 0.9f, 6.4f, 14)},
      -0.6f, 0);
  const mat4 at = moved({0, 0, back});
  place(scene, "end wall", m.brick, far_wall, at);
  place(scene, "arch stones", m.stone, arch_ring(1.2f, 0.3f, 17, 0.06f), at * moved({0, 2.4f, 0}));
  place(scene, "arch stones", m.stone, arch_ring(0.9f, 0.2f, 13, 0.05f), at * moved({0, 6.2f, 0}));
  for (int i = 0; i < 12; ++i) {
    const float x = -1.2f + 0.2f * float(i);
    const float top =
        2.4f + std::sqrt(std::max(0.0f, 1.44f - std::pow(std::max(std::abs(x), std::abs(x + 0.2f)), 2.0f)));
    add_chamfered_box(door, {x, 0, -0.45f}, {x + 0.198f, top, -0.37f}, 0.01f);
    for (int k = 0; k < 9; ++k) add_sphere(door, {x + 0.1f, 0.3f + 0.26f * float(k), -0.37f}, 0.022f, 8, 6);
  }
  add_box(door, {-1.2f, 0, -0.55f}, {1.2f, 2.4f, -0.46f});
  place(scene, "gate", m.wood, door, at);
  Mesh near_wall;
  add_extrusion(near_wall, wall({-half, -0.1f}, {half, parapet + 0.2f}, {arch({-1.5f, -0.1f}, 3.0f, 2.4f, 24)}), 0,
                0.6f);
  place(scene, "end wall", m.brick, near_wall, moved({0, 0, front + 0.35f}));
}

/// Thin sheets, one layer each, with folds.
void add_cloths(Scene& scene, const Materials& m) {
  const int colours[] = {m.red, m.green, m.blue};
  uint32_t id = 0;
  for (const float side : {-1.0f, 1.0f}) {
    const mat4 at = on_side(side, column_x);
    for (int i = 0; i < bays; ++i) {
      ++id;
      // Banners over the balustrade of every second bay.
      if (i % 2 == (side > 0 ? 0 : 1)) {
        const float x0 = bay * float(i) + 0.75f, top = upper_floor + 1.07f;
        const auto banner = [&](float u, float v) {
          const float drop = 1 - v, fold = 0.035f * std::sin(21 * u + float(id)) * (0.25f + drop);
          const float over = 0.12f * std::exp(-30 * drop);
          return vec3(x0 + 1.5f * u, top - 2.5f * drop - 0.12f * drop * std::sin(pi * u),
                      0.62f - over + fold + 0.06f * drop * std::sin(2.5f * drop + float(id)));
        };
        Mesh sheet;
        add_surface(sheet, banner, 36, 28);
        place(scene, "banner", colours[id % 3], sheet, at);
        Mesh pole;
        add_cylinder(pole, {x0 - 0.1f, top, 0.5f}, {x0 + 1.6f, top, 0.5f}, 0.018f, 0.018f, 10);
        for (const float x : {x0 - 0.1f, x0 + 1.6f}) add_sphere(pole, {x, top, 0.5f}, 0.04f, 12, 8);
        for (const float x : {x0 + 0.05f, x0 + 1.45f})
          add_cylinder(pole, {x, top, 0.5f}, {x, top - 0.06f, 0.33f}, 0.014f, 0.014f, 8);
        place(scene, "banner pole", m.gold, pole, at);
      }
      // Curtains in some arches, drawn together to one side.
      if (hash01(id, 40) < 0.45f) continue;
      const float rod = spring + 0.1f, wide = 0.9f + 1.2f * hash01(id, 41), left = bay * (float(i) + 0.5f) - 1.13f;
      const auto curtain = [&](float u, float v) {
        const float gather = 1 - 0.45f * std::exp(-std::pow((v - 0.45f) / 0.16f, 2.0f));
        const float fold = (0.05f + 0.03f * v) * std::sin(2 * pi * 9 * u + 1.5f * std::sin(5 * v));
        return vec3(left + wide * gather * u, 0.05f + (rod - 0.05f) * v, fold * gather);
      };
      Mesh shape;
      add_surface(shape, curtain, 80, 20);
      place(scene, "curtain", colours[(id + 1) % 3], shape, at);
      Mesh bar;
      add_cylinder(bar, {left - 0.02f, rod, 0}, {left + 2.3f, rod, 0}, 0.016f, 0.016f, 10);
      for (int k = 0; k < 10; ++k)
        add_torus(bar, {left + wide * float(k) / 9.5f + 0.02f, rod, 0}, {1, 0, 0}, 0.026f, 0.005f, 10, 4);
      place(scene, "curtain rod", m.iron, bar, at);
    }
  }
}

void add_lantern(Scene& scene, const Materials& m, vec3 hook, float chain) {
  Mesh metal, glass;
  const vec3 base = hook - vec3(0, chain + 0.42f, 0);
  for (int k = 0; k < int(chain / 0.06f); ++k) {
    add_torus(metal, hook - vec3(0, 0.03f + 0.06f * float(k), 0), k % 2 ? vec3(1, 0, 0) : vec3(0, 0, 1), 0.028f, 0.006f,
              8, 4);
  }
  add_lathe(metal, base, {{0, -0.06f}, {0.03f, -0.05f}, {0.1f, 0}, {0.1f, 0.02f}, {0.1f, 0.02f}, {0, 0.02f}}, 18);
  add_lathe(metal, base + vec3(0, 0.28f, 0),
            {{0, 0}, {0.12f, 0}, {0.12f, 0}, {0.12f, 0.02f}, {0.05f, 0.09f}, {0.02f, 0.14f}, {0, 0.15f}}, 18);
  for (int k = 0; k < 6; ++k) {
    const float angle = pi / 3 * float(k);
    const vec3 out = 0.09f * vec3(std::sin(angle), 0, std::cos(angle));
    add_cylinder(metal, base + out, base + out + vec3(0, 0.3f, 0), 0.007f, 0.007f, 6);
  }
  add_lathe(glass, base + vec3(0, 0.02f, 0), {{0, 0}, {0.05f, 0.01f}, {0.07f, 0.1f}, {0.04f, 0.2f}, {0, 0.24f}}, 16);
  place(scene, "lantern", m.gold, metal, mat4(1));
  place(scene, "lantern glass", m.lamp, glass, mat4(1));
}

void add_lamps(Scene& scene, const Materials& m) {
  for (int i = 1; i < bays; i += 2) {
    const float z = front - bay * float(i), y = upper_floor + 0.2f;
    const std::vector<vec3> rope =
        hanging_rope({-column_x + 0.3f, y, z}, {column_x - 0.3f, y, z - 0.5f * bay * float(i % 3 - 1)}, 0.55f, 25);
    add_tube(add_mesh(scene, "rope", m.rope), rope, 0.014f, 8);
    for (size_t k = 4; k < 24; k += 4) add_lantern(scene, m, rope[k], 0.1f + 0.2f * hash01(uint32_t(i), uint32_t(k)));
  }
  for (const float side : {-1.0f, 1.0f}) {
    for (int i = 0; i < bays; ++i) {
      add_lantern(scene, m, {side * 0.5f * (wall_x + column_x), spring + 1.5f, front - bay * (float(i) + 0.5f)}, 0.9f);
    }
  }
}

Mesh plant(uint32_t seed) {
  Mesh mesh;
  for (uint32_t i = 0; i < 50; ++i) {
    const float tall = 0.5f + 0.5f * hash01(seed, i, 1), reach = 0.3f + 0.35f * hash01(seed, i, 2), wide = 0.035f;
    const auto blade = [&](float u, float v) {
      const float half = wide * std::sin(pi * (0.08f + 0.9f * v)), side = 2 * u - 1;
      return vec3(reach * v * v + 0.03f, tall * std::sin(2.1f * v) + 0.4f * half * side * side, -half * side);
    };
    Mesh leaf;
    add_surface(leaf, blade, 2, 6);
    append(mesh, leaf, turned_y(2 * pi * hash01(seed, i, 3)));
  }
  return mesh;
}

void add_vases(Scene& scene, const Materials& m) {
  uint32_t id = 0;
  for (const float side : {-1.0f, 1.0f}) {
    for (int i = 0; i < bays; ++i) {
      ++id;
      const vec3 niche(side * (wall_x + 0.15f), 0, front - bay * (float(i) + 0.5f));
      Mesh urn;
      add_chamfered_box(urn, {-0.2f, 0, -0.2f}, {0.2f, 0.5f, 0.2f}, 0.02f);
      add_chamfered_box(urn, {-0.24f, 0.5f, -0.24f}, {0.24f, 0.56f, 0.24f}, 0.015f);
      add_lathe(urn, {0, 0.56f, 0},
                {{0, 0},
                 {0.12f, 0},
                 {0.12f, 0.03f},
                 {0.05f, 0.08f},
                 {0.06f, 0.12f},
                 {0.19f, 0.3f},
                 {0.22f, 0.45f},
                 {0.16f, 0.6f},
                 {0.1f, 0.66f},
                 {0.1f, 0.72f},
                 {0.15f, 0.78f},
                 {0.14f, 0.79f},
                 {0.08f, 0.72f},
                 {0, 0.68f}},
                32);
      place(scene, "urn", i % 3 ? m.stone : m.dark, urn, moved(niche));
      if (i % 2) {  // upstairs, by the wall
        place(scene, "urn", m.clay, urn, moved({side * (wall_x - 0.3f), upper_floor + 0.1f, niche.z - 0.5f * bay}));
      }
      if (hash01(id, 50) < 0.35f) continue;
      const float size = 0.8f + 0.4f * hash01(id, 51);
      const mat4 at = moved({side * (column_x - 0.75f), 0, front - bay * float(i) - 0.15f}) * scaled(vec3(size));
      Mesh pot, soil;
      add_lathe(pot, vec3(0),
                {{0, 0},
                 {0.2f, 0},
                 {0.2f, 0},
                 {0.22f, 0.05f},
                 {0.19f, 0.09f},
                 {0.3f, 0.34f},
                 {0.32f, 0.46f},
                 {0.29f, 0.52f},
                 {0.32f, 0.56f},
                 {0.33f, 0.6f},
                 {0.28f, 0.6f},
                 {0.26f, 0.52f},
                 {0, 0.5f}},
                28);
      for (int k = 0; k < 10; ++k) {
        const float angle = 2 * pi * float(k) / 10;
        add_sphere(pot, {0.3f * std::sin(angle), 0.4f, 0.3f * std::cos(angle)}, 0.045f, 10, 6);
      }
      add_lathe(soil, vec3(0), {{0.275f, 0.545f}, {0, 0.56f}}, 24);
      place(scene, "vase", m.clay, pot, at);
      place(scene, "soil", m.earth, soil, at);
      place(scene, "leaves", m.leaf, plant(id), at * moved({0, 0.54f, 0}));
    }
  }
  // A basin in the middle and benches by it.
  const vec3 middle(0, 0, front - bay * 5.5f);
  add_lathe(add_mesh(scene, "basin", m.pale), middle,
            {{0, 0},        {0.8f, 0},     {0.8f, 0},      {0.8f, 0.12f}, {0.8f, 0.12f},  {0.5f, 0.14f}, {0.25f, 0.2f},
             {0.18f, 0.5f}, {0.3f, 0.7f},  {0.75f, 0.85f}, {0.95f, 1.0f}, {0.98f, 1.05f}, {0.9f, 1.06f}, {0.7f, 0.95f},
             {0.3f, 0.88f}, {0.12f, 0.9f}, {0.08f, 1.2f},  {0.12f, 1.3f}, {0.05f, 1.4f},  {0, 1.42f}},
            48);
  for (const float x : {-1.55f, 1.55f}) {
    for (int k = 0; k < 3; ++k) {
      Mesh bench;
      add_chamfered_box(bench, {-0.22f, 0.4f, -0.8f}, {0.22f, 0.48f, 0.8f}, 0.015f);
      for (const float z : {-0.6f, 0.6f}) {
        add_chamfered_box(bench, {-0.16f, 0.06f, z - 0.07f}, {0.16f, 0.4f, z + 0.07f}, 0.02f);
        add_chamfered_box(bench, {-0.2f, 0, z - 0.11f}, {0.2f, 0.06f, z + 0.11f}, 0.015f);
      }
      place(scene, "bench", m.pale, bench, moved({x, 0, front - bay * (1.6f + 2 * float(k))}));
    }
  }
}

Scene make(const ParameterValues&) {
  Scene scene;
  const Materials m = add_materials(scene);
  add_floor(scene, m);
  for (const float side : {-1.0f, 1.0f}) {
    add_arcades(scene, m, side);
    add_aisle(scene, m, side);
  }
  add_ends(scene, m);
  add_cloths(scene, m);
  add_lamps(scene, m);
  add_vases(scene, m);
  scene.cameras = {looking_at("main", {1.5f, 1.75f, 2.6f}, {-0.9f, 2.5f, -9.0f}, 76),
                   looking_at("capital", {-1.4f, 2.0f, -1.2f}, {-3.2f, 2.7f, -3.2f}, 62),
                   looking_at("gallery", {5.2f, 6.2f, 1.6f}, {-2.6f, 4.6f, -9.5f}, 76)};
  scene.light.to_sun = {0.28f, 1.0f, 0.22f};
  scene.light.sun = {2.7f, 2.4f, 1.9f};
  scene.light.zenith = {0.28f, 0.38f, 0.56f};
  scene.light.horizon = {0.42f, 0.43f, 0.45f};
  scene.ao_radius = 0.6;
  return scene;
}

}  // namespace

std::vector<SceneRecipe> colonnade() {
  return {{.name = "colonnade",
           .summary = "a nave between two storeys of arches and columns, with vaulted aisles, curtains and banners",
           .kind = "architecture",
           .make = make}};
}

}  // namespace gloam::scenes
