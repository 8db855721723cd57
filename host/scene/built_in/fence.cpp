// Fences and railings one behind the other in front of a wall: many thin layers with large steps in depth.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <glm/gtc/constants.hpp>

#include "scene/built_in/mesh_builder.h"
#include "scene/built_in/tube.h"

namespace gloam::scenes {
namespace {

constexpr float pi = glm::pi<float>();
constexpr float reach = 9;  ///< every row goes from -reach to reach along x

struct Materials {
  int soil, paving, iron, rust, zinc, white_paint, old_wood, larch, brick, mortar, coping, grass, dry_grass, clay,
      brass;
};

Materials add_materials(Scene& scene) {
  Materials m;
  m.soil = add_material(scene, "soil", {0.3f, 0.24f, 0.17f}, 1);
  m.paving = add_material(scene, "paving", {0.48f, 0.46f, 0.43f}, 0.85f);
  m.iron = add_material(scene, "painted iron", {0.07f, 0.09f, 0.08f}, 0.4f);
  m.rust = add_material(scene, "rust", {0.36f, 0.16f, 0.08f}, 0.9f);
  m.zinc = add_material(scene, "zinc", {0.55f, 0.56f, 0.58f}, 0.5f, 0.25f);
  m.white_paint = add_material(scene, "white paint", {0.75f, 0.74f, 0.7f}, 0.5f);
  m.old_wood = add_material(scene, "weathered wood", {0.4f, 0.36f, 0.31f}, 0.9f);
  m.larch = add_material(scene, "larch", {0.52f, 0.33f, 0.18f}, 0.7f);
  m.brick = add_material(scene, "brick", {0.5f, 0.23f, 0.16f}, 0.9f);
  m.mortar = add_material(scene, "mortar", {0.6f, 0.57f, 0.52f}, 1);
  m.coping = add_material(scene, "coping", {0.55f, 0.53f, 0.48f}, 0.8f);
  m.grass = add_material(scene, "grass", {0.2f, 0.36f, 0.1f}, 0.7f);
  m.dry_grass = add_material(scene, "dry grass", {0.5f, 0.46f, 0.22f}, 0.8f);
  m.clay = add_material(scene, "clay", {0.6f, 0.32f, 0.2f}, 0.7f);
  m.brass = add_material(scene, "brass", {0.8f, 0.6f, 0.3f}, 0.3f, 0.6f);
  return m;
}

/// A box given by its centre and its size.
void add_block(Mesh& mesh, vec3 centre, vec3 size) { add_box(mesh, centre - 0.5f * size, centre + 0.5f * size); }

/// A wooden board in the plane of z, pointed at both corners of its top, from the ground up.
void add_picket(Mesh& mesh, vec3 foot, float width, float height, float thickness) {
  const float w = width / 2;
  const std::vector<vec2> outline = {{-w, 0}, {w, 0}, {w, height - w}, {0, height}, {-w, height - w}};
  Mesh board;
  add_extrusion(board, outline, -thickness / 2, thickness / 2);
  append(mesh, board, moved(foot));
}

/// A flat bar between two points of the plane of z, standing on edge `width` wide and `thickness` deep.
void add_slat(Mesh& mesh, vec3 from, vec3 to, float width, float thickness) {
  const float length = glm::length(to - from);
  Mesh bar;
  add_box(bar, {0, -width / 2, -thickness / 2}, {length, width / 2, thickness / 2});
  append(mesh, bar, moved(from) * turned(std::atan2(to.y - from.y, to.x - from.x), {0, 0, 1}));
}

/// One post with a cap.
void add_post(Mesh& mesh, vec3 foot, float width, float height) {
  add_block(mesh, foot + vec3(0, height / 2, 0), {width, height, width});
  add_block(mesh, foot + vec3(0, height + 0.015f, 0), {width + 0.04f, 0.03f, width + 0.04f});
}

/// `panel(mesh, x0, x1)` between posts, one mesh each, from -reach to reach; `open` is the panel left out, -1 for none.
void add_panels(Scene& scene, const std::string& name, int material, int panels, int open,
                const std::function<void(Mesh&, float, float)>& panel) {
  for (int i = 0; i < panels; ++i) {
    if (i == open) continue;
    const float width = 2 * reach / float(panels), x = -reach + width * float(i);
    panel(add_mesh(scene, fmt::format("{} {}", name, i), material), x, x + width);
  }
}

/// The posts between `panels` panels, one mesh each.
void add_posts(Scene& scene, const std::string& name, int material, int panels, float z, float width, float height) {
  for (int i = 0; i <= panels; ++i) {
    const float x = -reach + 2 * reach * float(i) / float(panels);
    add_post(add_mesh(scene, fmt::format("{} post {}", name, i), material), {x, 0, z}, width, height);
  }
}

/// Upright iron bars with spear points between two rails.
void add_railing(Mesh& mesh, float x0, float x1, float z, float low, float height) {
  const int bars = std::max(2, int((x1 - x0) / 0.115f));
  for (int i = 0; i < bars; ++i) {
    const float x = x0 + (x1 - x0) * (float(i) + 0.5f) / float(bars);
    const float top = height - (i % 2 ? 0.09f : 0);
    add_cylinder(mesh, {x, low, z}, {x, top, z}, 0.008f, 0.008f, 8);
    add_lathe(mesh, {x, top, z}, {{0, -0.02f}, {0.017f, -0.01f}, {0.011f, 0.005f}, {0.019f, 0.03f}, {0, 0.11f}}, 10);
  }
  for (const float y : {low + 0.08f, height - 0.16f}) add_block(mesh, {(x0 + x1) / 2, y, z}, {x1 - x0, 0.03f, 0.012f});
  for (int i = 0; i + 1 < bars; i += 2) {  // rings under the upper rail
    const float x = x0 + (x1 - x0) * (float(i) + 1) / float(bars), radius = 0.045f;
    std::vector<vec3> ring;
    for (int k = 0; k <= 16; ++k) {
      const float angle = 2 * pi * float(k) / 16;
      ring.push_back({x + radius * std::sin(angle), height - 0.22f - radius * std::cos(angle), z});
    }
    add_tube(mesh, ring, 0.005f, 5);
  }
}

/// Chain link: wires that go up in zigzag and hook into their neighbours, each bend round the other wire's.
void add_chain_link(Mesh& mesh, float x0, float x1, float z, float low, float height) {
  const float pitch = 0.058f, wire = 0.0016f;
  const int wires = int((x1 - x0) / pitch), bends = int((height - low) / pitch);
  for (int i = 0; i < wires; ++i) {
    std::vector<vec3> points;
    for (int k = 0; k <= bends; ++k) {
      // Odd bends lie on the left, hooked into the wire before, whose right bends are at the same height.
      const bool right = (i + k) % 2;
      const float x = x0 + pitch * (float(i) + 0.5f) + (right ? 0.5f : -0.5f) * (pitch + 2 * wire);
      points.push_back({x, low + pitch * float(k), z + (right ? wire : -wire)});
      if (k < bends) points.push_back({x0 + pitch * (float(i) + 0.5f), low + pitch * (float(k) + 0.5f), z});
    }
    add_tube(mesh, points, wire, 4);
  }
  for (const float y : {low, (low + height) / 2, height}) add_cylinder(mesh, {x0, y, z}, {x1, y, z}, 0.003f, 0.003f, 6);
}

void add_pickets(Mesh& mesh, float x0, float x1, float z, uint32_t seed) {
  const int count = std::max(1, int((x1 - x0) / 0.135f));
  for (int i = 0; i < count; ++i) {
    const float x = x0 + (x1 - x0) * (float(i) + 0.5f) / float(count);
    const float height = 1.05f + 0.1f * std::sin(pi * (float(i) + 0.5f) / float(count));
    add_picket(mesh, {x, 0.06f, z}, 0.078f, height + random_in(-0.012f, 0.012f, uint32_t(i), seed), 0.02f);
  }
  for (const float y : {0.3f, 0.88f}) add_block(mesh, {(x0 + x1) / 2, y, z - 0.03f}, {x1 - x0, 0.07f, 0.035f});
}

/// Slats at 45 degrees in two layers, in a frame.
void add_lattice(Mesh& mesh, float x0, float x1, float z, float low, float height) {
  const float step = 0.16f, tall = height - low;
  for (int layer = 0; layer < 2; ++layer) {
    for (float start = x0 - tall + step / 2; start < x1; start += step) {
      // The part of the diagonal from (start, low) to (start + tall, height) that lies in the panel.
      const float from = std::max(start, x0), to = std::min(start + tall, x1);
      if (to - from < 0.03f) continue;
      const float y0 = low + from - start, y1 = low + to - start;
      if (layer == 0) {
        add_slat(mesh, {from, y0, z}, {to, y1, z}, 0.034f, 0.01f);
      } else {
        add_slat(mesh, {x0 + x1 - to, y1, z - 0.011f}, {x0 + x1 - from, y0, z - 0.011f}, 0.034f, 0.01f);
      }
    }
  }
  for (const float y : {low, height}) add_block(mesh, {(x0 + x1) / 2, y, z - 0.005f}, {x1 - x0, 0.06f, 0.05f});
  for (const float x : {x0 + 0.03f, x1 - 0.03f})
    add_block(mesh, {x, (low + height) / 2, z - 0.005f}, {0.06f, tall - 0.06f, 0.05f});
}

/// Welded wire: straight wires both ways, the level ones in front.
void add_wire_mesh(Mesh& mesh, float x0, float x1, float z, float low, float height) {
  const float wire = 0.0025f;
  for (float x = x0 + 0.05f; x < x1; x += 0.05f) add_tube(mesh, {{x, low, z}, {x, height, z}}, wire, 5);
  for (float y = low + 0.05f; y < height; y += 0.15f)
    add_tube(mesh, {{x0, y, z + 2 * wire}, {x1, y, z + 2 * wire}}, wire, 5);
}

/// Bent rods: uprights with an S of two scrolls between each pair.
void add_scrollwork(Mesh& mesh, float x0, float x1, float z, float height) {
  const int count = std::max(1, int((x1 - x0) / 0.36f));
  const float width = (x1 - x0) / float(count);
  for (int i = 0; i < count; ++i) {
    const float x = x0 + width * (float(i) + 0.5f);
    add_cylinder(mesh, {x - width / 2, 0, z}, {x - width / 2, height, z}, 0.011f, 0.011f, 8);
    for (const float side : {-1.0f, 1.0f}) {
      std::vector<vec3> scroll;
      for (int k = 0; k <= 40; ++k) {  // an S: it winds out of one spiral and into another that is turned by half
        const float t = float(k) / 20 - 1, turn = 1.75f * pi * (1 - std::abs(t));
        const float radius = 0.15f * (0.2f + 0.8f * std::abs(t));
        const float sign = t < 0 ? -1 : 1;
        scroll.push_back({x + sign * side * radius * std::cos(turn) * 0.9f,
                          height * 0.5f + sign * (0.24f + radius * std::sin(turn)), z + side * 0.008f});
      }
      // Both halves end inside their spiral at t = 0: each is a rod of its own.
      add_tube(mesh, {scroll.begin(), scroll.begin() + 20}, 0.006f, 6);
      add_tube(mesh, {scroll.begin() + 21, scroll.end()}, 0.006f, 6);
    }
  }
  for (const float y : {0.1f, height * 0.5f, height - 0.03f})
    add_block(mesh, {(x0 + x1) / 2, y, z}, {x1 - x0, 0.022f, 0.022f});
  add_tube(mesh, {{x0, height + 0.01f, z}, {x1, height + 0.01f, z}}, 0.02f, 10);
}

/// Round rails, one above the other.
void add_rails(Mesh& mesh, float x0, float x1, float z, uint32_t seed) {
  for (int i = 0; i < 4; ++i) {
    const float y = 0.35f + 0.38f * float(i);
    std::vector<vec3> points;
    for (int k = 0; k <= 6; ++k) {
      const uint32_t at = seed + uint32_t(i * 16 + k);
      points.push_back({x0 - 0.1f + (x1 - x0 + 0.2f) * float(k) / 6, y + random_in(-0.02f, 0.02f, at, 71), z});
    }
    add_tube(mesh, points, random_in(0.035f, 0.05f, seed, uint32_t(i), 72), 10);
  }
}

/// Split chestnut paling: rough upright stakes held by two twisted wires.
void add_paling(Mesh& mesh, float x0, float x1, float z, uint32_t seed) {
  const int count = int((x1 - x0) / 0.09f);
  for (int i = 0; i < count; ++i) {
    const uint32_t at = seed + uint32_t(i);
    const float x = x0 + (x1 - x0) * (float(i) + 0.5f) / float(count), lean = random_in(-0.03f, 0.03f, at, 81);
    const float top = random_in(1.45f, 1.7f, at, 82), radius = random_in(0.013f, 0.02f, at, 83);
    add_tube(mesh, {{x - lean, 0, z}, {x, 0.8f, z + 0.2f * lean}, {x + lean, top, z}}, {radius, radius, radius * 0.7f},
             6);
  }
  for (const float y : {0.35f, 1.2f}) {
    for (const float side : {-1.0f, 1.0f}) {
      std::vector<vec3> wire;
      for (int k = 0; k <= 2 * count; ++k) {
        const float bulge = side * (k % 2 ? 0.024f : 0.003f) * (k % 4 == 1 ? 1.0f : -1.0f);
        wire.push_back({x0 + (x1 - x0) * float(k) / float(2 * count), y, z + bulge});
      }
      add_tube(mesh, wire, 0.0018f, 4);
    }
  }
}

/// The wing of the gate, ajar: a railing in a frame, hinged at (x, z).
void add_gate(Scene& scene, const Materials& m, float x, float z, float width, float angle) {
  const glm::mat4 place = moved({x, 0, z}) * turned_y(angle);
  Mesh wing, knob;
  add_railing(wing, 0.04f, width - 0.04f, 0, 0.1f, 1.45f);
  for (const float at : {0.02f, width - 0.02f}) add_block(wing, {at, 0.8f, 0}, {0.04f, 1.5f, 0.03f});
  for (const float y : {0.08f, 0.75f, 1.5f}) add_block(wing, {width / 2, y, 0}, {width, 0.04f, 0.03f});
  add_slat(wing, {0.04f, 0.12f, 0.012f}, {width - 0.04f, 0.73f, 0.012f}, 0.03f, 0.008f);
  append(add_mesh(scene, "gate", m.iron), wing, place);
  add_sphere(knob, {width - 0.02f, 0.95f, 0.045f}, 0.03f, 20, 12);
  add_cylinder(knob, {width - 0.02f, 0.95f, 0}, {width - 0.02f, 0.95f, 0.03f}, 0.012f, 0.012f, 12);
  append(add_mesh(scene, "gate knob", m.brass), knob, place);
}

/// A brick wall that faces +z, bricks a little in front of the mortar, with piers and coping.
void add_wall(Scene& scene, const Materials& m, float z) {
  const float brick_length = 0.25f, course = 0.085f, joint = 0.012f;
  const int courses = 32, per_course = int(2 * (reach + 3) / brick_length);
  const float tall = course * float(courses);
  add_box(add_mesh(scene, "wall core", m.mortar), {-reach - 3, 0, z - 0.3f}, {reach + 3, tall, z});
  Mesh& bricks = add_mesh(scene, "bricks", m.brick);
  for (int row = 0; row < courses; ++row) {
    for (int i = 0; i < per_course; ++i) {
      const float x = -reach - 3 + brick_length * (float(i) + (row % 2 ? 0.5f : 0)), y = course * float(row);
      const float out = random_in(0.006f, 0.018f, uint32_t(row), uint32_t(i), 91);
      add_box(bricks, {x + joint / 2, y + joint / 2, z - 0.05f},
              {x + brick_length - joint / 2, y + course - joint / 2, z + out});
    }
  }
  Mesh& coping = add_mesh(scene, "coping", m.coping);
  for (int i = 0; i < 24; ++i) {
    const float x = -reach - 3 + float(i);
    add_box(coping, {x + 0.005f, tall, z - 0.36f}, {x + 0.995f, tall + 0.08f, z + 0.06f});
  }
  for (int i = 0; i < 7; ++i) {
    Mesh& pier = add_mesh(scene, fmt::format("pier {}", i), m.coping);
    const float x = -reach + 3 * float(i);
    add_box(pier, {x - 0.22f, 0, z}, {x + 0.22f, tall, z + 0.14f});
    add_box(pier, {x - 0.27f, tall, z - 0.4f}, {x + 0.27f, tall + 0.12f, z + 0.2f});
    add_sphere(pier, {x, tall + 0.27f, z - 0.1f}, 0.17f, 28, 16);
  }
}

/// Tufts along a row, every third of dry grass.
void add_tufts(Scene& scene, const Materials& m, int row, float z) {
  Mesh green{.name = fmt::format("grass {}", row), .material = m.grass};
  Mesh dry{.name = fmt::format("dry grass {}", row), .material = m.dry_grass};
  for (uint32_t tuft = 0; tuft < 150; ++tuft) {
    const uint32_t seed = uint32_t(row) * 1000 + tuft;
    const vec3 root(random_in(-reach, reach, seed, 1), 0, z + random_in(-0.12f, 0.12f, seed, 2));
    const float size = random_in(0.14f, 0.5f, seed, 3);
    Mesh& mesh = tuft % 3 == 2 ? dry : green;
    for (uint32_t blade = 0; blade < 22; ++blade) {
      const float angle = random_in(0, 2 * pi, seed, blade, 4), lean = size * random_in(0.15f, 0.7f, seed, blade, 5);
      const vec3 out(std::cos(angle), 0, std::sin(angle));
      add_blade(mesh, root + random_in(0, 0.05f, seed, blade, 6) * out, lean * out,
                size * random_in(0.6f, 1, seed, blade, 7), 0.008f, 4);
    }
  }
  scene.meshes.push_back(std::move(green));
  scene.meshes.push_back(std::move(dry));
}

void add_ground(Scene& scene, const Materials& m) {
  add_surface(
      add_mesh(scene, "ground", m.soil),
      [](float u, float v) {
        const float x = -20 + 40 * u, z = 8 - 26 * v;
        const float path = std::abs(x - 1.5f) < 1.2f ? 0.0f : 1.0f;
        return vec3(x, path * 0.012f * (std::sin(3.1f * x + 1.3f * z) + std::sin(2.3f * z - 1.7f * x)) - 0.025f, z);
      },
      200, 130);
  uint32_t stone = 0;
  for (float z = 5; z > -9; z -= 0.55f) {
    for (float x = 0.6f; x < 2.3f; x += 0.6f, ++stone) {
      Mesh& slab = add_mesh(scene, fmt::format("slab {}", stone), m.paving);
      const float top = random_in(0.005f, 0.02f, stone, 61);
      Mesh flat;
      add_box(flat, {-0.28f, -0.05f, -0.255f}, {0.28f, top, 0.255f});
      append(slab, flat, moved({x + 0.28f, 0, z}) * turned_y(random_in(-0.04f, 0.04f, stone, 62)));
    }
  }
}

void add_pots(Scene& scene, const Materials& m) {
  const vec3 places[] = {{-1.2f, 0, -0.55f}, {3.2f, 0, -1.7f}, {-3.1f, 0, -2.8f}, {0.1f, 0, -4.1f}, {4.4f, 0, -5.4f}};
  for (uint32_t i = 0; i < 5; ++i) {
    add_lathe(add_mesh(scene, fmt::format("pot {}", i), m.clay), places[i],
              {{0, 0.01f},
               {0.11f, 0.01f},
               {0.11f, 0.01f},
               {0.17f, 0.3f},
               {0.17f, 0.3f},
               {0.19f, 0.3f},
               {0.19f, 0.3f},
               {0.19f, 0.35f},
               {0.19f, 0.35f},
               {0.165f, 0.35f},
               {0.165f, 0.35f},
               {0.15f, 0.27f},
               {0, 0.27f}},
              36);
    Mesh& plant = add_mesh(scene, fmt::format("plant {}", i), m.grass);
    for (uint32_t blade = 0; blade < 60; ++blade) {
      const float angle = random_in(0, 2 * pi, i, blade, 51), lean = random_in(0.05f, 0.35f, i, blade, 52);
      const vec3 out(std::cos(angle), 0, std::sin(angle));
      add_blade(plant, places[i] + vec3(0, 0.26f, 0) + 0.08f * out, lean * out, random_in(0.25f, 0.55f, i, blade, 53),
                0.022f, 6);
    }
  }
}

Scene make(const ParameterValues&) {
  Scene scene;
  const Materials m = add_materials(scene);
  add_ground(scene, m);
  const float rows[] = {0, -1.15f, -2.3f, -3.45f, -4.6f, -5.75f, -6.9f, -8};
  add_panels(scene, "railing", m.iron, 12, 6,
             [&](Mesh& mesh, float x0, float x1) { add_railing(mesh, x0 + 0.05f, x1 - 0.05f, rows[0], 0.02f, 1.4f); });
  add_posts(scene, "railing", m.iron, 12, rows[0], 0.09f, 1.5f);
  add_gate(scene, m, 0.06f, rows[0], 1.36f, 0.85f);
  add_panels(scene, "chain link", m.zinc, 9, -1, [&](Mesh& mesh, float x0, float x1) {
    add_chain_link(mesh, x0 + 0.04f, x1 - 0.04f, rows[1], 0.06f, 1.86f);
  });
  add_posts(scene, "chain link", m.rust, 9, rows[1], 0.05f, 1.9f);
  add_panels(scene, "pickets", m.white_paint, 9, -1, [&](Mesh& mesh, float x0, float x1) {
    add_pickets(mesh, x0 + 0.05f, x1 - 0.05f, rows[2], uint32_t(1000 + x0));
  });
  add_posts(scene, "pickets", m.white_paint, 9, rows[2], 0.1f, 1.2f);
  add_panels(scene, "lattice", m.larch, 10, 5,
             [&](Mesh& mesh, float x0, float x1) { add_lattice(mesh, x0 + 0.06f, x1 - 0.06f, rows[3], 0.12f, 1.7f); });
  add_posts(scene, "lattice", m.larch, 10, rows[3], 0.11f, 1.85f);
  add_panels(scene, "wire mesh", m.zinc, 8, -1, [&](Mesh& mesh, float x0, float x1) {
    add_wire_mesh(mesh, x0 + 0.03f, x1 - 0.03f, rows[4], 0.05f, 2.0f);
  });
  add_posts(scene, "wire mesh", m.iron, 8, rows[4], 0.06f, 2.05f);
  add_panels(scene, "scrollwork", m.rust, 9, -1,
             [&](Mesh& mesh, float x0, float x1) { add_scrollwork(mesh, x0 + 0.05f, x1 - 0.05f, rows[5], 1.5f); });
  add_posts(scene, "scrollwork", m.rust, 9, rows[5], 0.08f, 1.65f);
  add_panels(scene, "paling", m.old_wood, 9, -1, [&](Mesh& mesh, float x0, float x1) {
    add_paling(mesh, x0 + 0.04f, x1 - 0.04f, rows[6], uint32_t(5000 + 100 * (x0 + reach)));
  });
  add_panels(scene, "rails", m.old_wood, 6, -1, [&](Mesh& mesh, float x0, float x1) {
    add_rails(mesh, x0, x1, rows[7], uint32_t(9000 + 100 * (x0 + reach)));
  });
  add_posts(scene, "rails", m.old_wood, 6, rows[7] - 0.1f, 0.14f, 1.75f);
  add_wall(scene, m, -9.3f);
  for (int row = 0; row < 8; ++row) add_tufts(scene, m, row, rows[row]);
  add_tufts(scene, m, 8, -9);
  add_pots(scene, m);
  scene.cameras = {looking_at("main", {-1.6, 1.45, 2.6}, {0.6, 0.85, -3}, 66),
                   looking_at("close", {-0.55, 1.25, 0.75}, {-1.1, 1.05, -2}, 55),
                   looking_at("along", {-5.4, 1.7, -0.55}, {3, 0.6, -2.6}, 70)};
  scene.ao_radius = 0.5;
  scene.light.to_sun = {-0.5f, 0.75f, 0.6f};
  return scene;
}

}  // namespace

std::vector<SceneRecipe> fence() {
  return {{.name = "fence",
           .summary = "railings, chain link, pickets and lattices one behind the other, and a wall: many thin layers",
           .kind = "thin",
           .parameters = {},
           .make = make}};
}

}  // namespace gloam::scenes
