// A Doric temple, partly fallen: fluted columns, entablature with triglyphs, pediment, cella, drums in the grass.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "scene/built_in/mesh_builder.h"

namespace gloam::scenes {
namespace {

using glm::mat4;
constexpr float pi = glm::pi<float>();

// Columns stand `bay` apart: 6 along x at the front, 9 along -z. The front row is at z = 0.
constexpr int across = 6, along = 9, flutes = 20;
constexpr float bay = 2.4f, lower_radius = 0.52f, upper_radius = 0.41f, floor_y = 0.9f, shaft_height = 4.9f;
constexpr float column_height = 5.4f, half_width = 0.5f * bay * (across - 1), length = bay * (along - 1);
constexpr float architrave_y = floor_y + column_height, frieze_y = architrave_y + 0.72f, cornice_y = frieze_y + 0.78f;

struct Materials {
  int marble, weathered, stone, ground, grass, rock, bark, needles, bronze, embers, clay, wood;
};

Materials add_materials(Scene& scene) {
  Materials m;
  m.marble = add_material(scene, "marble", {0.68f, 0.63f, 0.53f}, 0.55f);
  m.weathered = add_material(scene, "weathered marble", {0.56f, 0.51f, 0.42f}, 0.85f);
  m.stone = add_material(scene, "limestone", {0.50f, 0.46f, 0.38f}, 0.9f);
  m.ground = add_material(scene, "dry soil", {0.36f, 0.29f, 0.18f}, 1);
  m.grass = add_material(scene, "grass", {0.30f, 0.31f, 0.10f}, 0.8f);
  m.rock = add_material(scene, "rock", {0.40f, 0.37f, 0.33f}, 0.95f);
  m.bark = add_material(scene, "bark", {0.20f, 0.14f, 0.09f}, 1);
  m.needles = add_material(scene, "cypress", {0.08f, 0.16f, 0.06f}, 0.7f);
  m.bronze = add_material(scene, "bronze", {0.62f, 0.42f, 0.22f}, 0.35f, 1);
  m.clay = add_material(scene, "fired clay", {0.55f, 0.27f, 0.15f}, 0.6f);
  m.wood = add_material(scene, "timber", {0.34f, 0.23f, 0.13f}, 0.8f);
  m.embers = add_material(scene, "embers", {0.2f, 0.1f, 0.05f}, 1);
  scene.materials[size_t(m.embers)].emission = {0.95f, 0.35f, 0.08f};
  return m;
}

/// Smooth noise in [0, 1].
float noise(float x, float y, uint32_t seed) {
  const float fx = std::floor(x), fy = std::floor(y);
  const auto at = [&](int dx, int dy) { return hash01(uint32_t(int(fx) + dx), uint32_t(int(fy) + dy), seed); };
  const float u = x - fx, v = y - fy, su = u * u * (3 - 2 * u), sv = v * v * (3 - 2 * v);
  return glm::mix(glm::mix(at(0, 0), at(1, 0), su), glm::mix(at(0, 1), at(1, 1), su), sv);
}

/// Height of the ground: level about the temple, hills around.
float ground_at(float x, float z) {
  const float dx = std::max(std::abs(x) - 9, 0.0f), dz = std::max(std::abs(z + 0.5f * length) - 13, 0.0f);
  const float away = std::min(std::hypot(dx, dz) / 40, 1.0f);
  const float bumps = 0.10f * noise(0.5f * x, 0.5f * z, 1) + 0.04f * noise(2 * x, 2 * z, 2);
  return bumps - 0.1f + 14 * away * away * noise(0.05f * x, 0.05f * z, 3) + 0.5f * away * noise(0.3f * x, 0.3f * z, 4);
}

/// A fluted shaft from y = 0: each flute is a hollow between sharp edges. `ragged` metres of its top are broken off.
Mesh shaft(float radius_low, float radius_high, float height, int rows, float ragged, uint32_t seed) {
  Mesh mesh;
  const int columns = 5;
  const auto point = [&](float turn, float v) {  // `turn` in flutes
    const float angle = 2 * pi * turn / flutes;
    const float broken = ragged * noise(2 * std::cos(angle) + 5, 2 * std::sin(angle) + 5, seed);
    const float swelling = 0.012f * std::sin(pi * v) * height / shaft_height;
    const float radius =
        (glm::mix(radius_low, radius_high, v) + swelling) * (1 - 0.075f * std::abs(std::sin(pi * turn)));
    return vec3(radius * std::sin(angle), v * (height - broken), radius * std::cos(angle));
  };
  std::vector<vec3> low, high;
  for (int flute = 0; flute < flutes; ++flute) {
    const auto hollow = [&](float u, float v) { return point(float(flute) + u, v); };
    add_surface(mesh, hollow, columns, rows);
    for (int i = 0; i < columns; ++i) {
      low.push_back(hollow(float(i) / columns, 0));
      high.push_back(hollow(float(i) / columns, 1));
    }
  }
  const vec3 top(0, height - 0.6f * ragged, 0);
  for (size_t i = 0; i < low.size(); ++i) {
    const size_t next = (i + 1) % low.size();
    add_triangle(mesh, top, high[i], high[next]);
    add_triangle(mesh, vec3(0), low[next], low[i]);
  }
  return mesh;
}

/// Necking rings, echinus and abacus, from y = 0.
Mesh capital() {
  Mesh mesh;
  const float r = upper_radius;
  add_lathe(mesh, vec3(0),
            {{0, -0.02f},
             {r + 0.005f, -0.02f},
             {r + 0.005f, -0.02f},
             {r + 0.005f, 0.05f},
             {r + 0.005f, 0.05f},
             {r + 0.025f, 0.06f},
             {r + 0.01f, 0.08f},
             {r + 0.035f, 0.09f},
             {r + 0.02f, 0.11f},
             {r + 0.05f, 0.125f},
             {r + 0.14f, 0.2f},
             {r + 0.21f, 0.265f},
             {r + 0.215f, 0.29f},
             {r + 0.19f, 0.3f},
             {r + 0.19f, 0.3f},
             {0, 0.3f}},
            60);
  add_chamfered_box(mesh, {-r - 0.24f, 0.3f, -r - 0.24f}, {r + 0.24f, 0.5f, r + 0.24f}, 0.012f);
  return mesh;
}

bool is_standing(int i, int k) {
  if (k == along - 1) return i < 2;
  if (i == across - 1) return k < 5;
  return true;
}

vec3 column_place(int i, int k) { return {bay * float(i) - half_width, floor_y, -bay * float(k)}; }

void add_columns(Scene& scene, const Materials& m) {
  const Mesh whole = shaft(lower_radius, upper_radius, shaft_height, 14, 0, 1), top = capital();
  for (int i = 0; i < across; ++i) {
    for (int k = 0; k < along; ++k) {
      const bool is_outer = i == 0 || i == across - 1 || k == 0 || k == along - 1;
      if (!is_outer) continue;
      const uint32_t seed = uint32_t(i * along + k);
      const mat4 at = moved(column_place(i, k)) * turned_y(pi / 10 * std::floor(20 * hash01(seed, 5)));
      if (is_standing(i, k)) {
        Mesh column = whole;
        append(column, top, moved({0, shaft_height, 0}));
        place(scene, "column", m.marble, column, moved(column_place(i, k)));
        continue;
      }
      const float height = 0.7f + 2.4f * hash01(seed, 6);
      const float high = glm::mix(lower_radius, upper_radius, height / shaft_height);
      place(scene, "column stump", m.weathered, shaft(lower_radius, high, height, 8, 0.4f, seed), at);
    }
  }
  for (const float x : {-1.2f, 1.2f}) {  // between the ends of the cella's walls
    Mesh column = whole;
    append(column, top, moved({0, shaft_height, 0}));
    place(scene, "column", m.marble, column, moved({x, floor_y, -1.6f * bay}));
  }
}

/// Blocks of one course between two corners, with narrow joints.
void add_blocks(Mesh& mesh, vec3 low, vec3 high, int axis, float block, uint32_t seed) {
  const int count = std::max(1, int(std::round((high[axis] - low[axis]) / block)));
  const float step = (high[axis] - low[axis]) / float(count);
  for (int i = 0; i < count; ++i) {
    vec3 a = low, b = high;
    a[axis] = low[axis] + step * float(i) + 0.003f;
    b[axis] = low[axis] + step * float(i + 1) - 0.003f;
    const float sunk = 0.012f * hash01(seed, uint32_t(i), 8);
    const int side = axis == 0 ? 2 : 0;
    a[side] += sunk, b[side] -= sunk;
    add_chamfered_box(mesh, a, b, 0.012f + 0.012f * hash01(seed, uint32_t(i), 9));
  }
}

void add_steps(Scene& scene, const Materials& m) {
  Mesh& mesh = add_mesh(scene, "steps", m.weathered);
  for (int step = 0; step < 3; ++step) {
    const float out = 0.85f + 0.36f * float(2 - step), y0 = 0.3f * float(step) - (step ? 0 : 0.3f),
                y1 = 0.3f * float(step + 1);
    const float x = half_width + out, front = out, back = -length - out, deep = 1.25f;
    const uint32_t seed = uint32_t(step) * 4 + 60;
    add_blocks(mesh, {-x, y0, front - deep}, {x, y1, front}, 0, 1.2f, seed);
    add_blocks(mesh, {-x, y0, back}, {x, y1, back + deep}, 0, 1.2f, seed + 1);
    add_blocks(mesh, {-x, y0, back + deep}, {-x + deep, y1, front - deep}, 2, 1.2f, seed + 2);
    add_blocks(mesh, {x - deep, y0, back + deep}, {x, y1, front - deep}, 2, 1.2f, seed + 3);
  }
  Mesh& floor = add_mesh(scene, "floor", m.stone);
  const float x = half_width - 0.4f;
  for (int row = 0; row < 24; ++row) {
    const float z0 = -length + 0.4f + (length - 0.8f) * float(row) / 24, z1 = z0 + (length - 0.8f) / 24 - 0.006f;
    add_blocks(floor, {-x, 0.3f, z0}, {x, floor_y - 0.012f * hash01(uint32_t(row), 70), z1}, 0, 1.2f,
               uint32_t(row) + 71);
  }
}

/// A triglyph centred on x = 0, its face towards +z at z = 0.06, from y = 0; with the regula and its drops below.
Mesh triglyph() {
  Mesh mesh;
  const float w = 0.26f, groove = 0.05f;
  std::vector<vec2> plan = {{-w, -0.1f}, {w, -0.1f}, {w, 0.06f - groove}};
  const float faces[] = {0.21f, 0.11f, 0.05f, -0.05f, -0.11f, -0.21f};
  for (int i = 0; i < 6; ++i) {
    plan.push_back({faces[i], 0.06f});
    if (i == 1 || i == 3) plan.push_back({0.5f * (faces[i] + faces[i + 1]), 0.06f - groove});
  }
  plan.push_back({-w, 0.06f - groove});
  Mesh prism;
  add_extrusion(prism, plan, 0, 0.64f);  // plan's y is the world's z, its depth the world's -y
  append(mesh, prism, moved({0, 0.64f, 0}) * turned(pi / 2, {1, 0, 0}));
  add_chamfered_box(mesh, {-w - 0.01f, 0.64f, -0.1f}, {w + 0.01f, 0.76f, 0.075f}, 0.008f);
  add_chamfered_box(mesh, {-w, -0.15f, -0.05f}, {w, -0.075f, 0.075f}, 0.006f);
  for (int i = 0; i < 6; ++i) {
    const float x = -w + 0.045f + (2 * w - 0.09f) * float(i) / 5;
    add_cylinder(mesh, {x, -0.2f, 0.035f}, {x, -0.15f, 0.035f}, 0.03f, 0.022f, 10);
  }
  return mesh;
}

/// Beam, frieze and cornice over `bays` columns' distances along +x from the origin of `at` (a column's axis), facing +z.
void add_entablature(Scene& scene, const Materials& m, const mat4& at, int bays, float start, float end,
                     uint32_t seed) {
  const float half = 0.42f, x0 = -start, x1 = bay * float(bays) + end;
  Mesh beam, frieze, ornament, cornice;
  for (int i = 0; i < bays; ++i) {
    const float a = i == 0 ? x0 : bay * float(i), b = i == bays - 1 ? x1 : bay * float(i + 1);
    const float sunk = 0.01f * hash01(seed, uint32_t(i));
    add_chamfered_box(beam, {a + 0.004f, architrave_y, 0.01f}, {b - 0.004f, frieze_y - 0.08f, half - sunk}, 0.015f);
    add_chamfered_box(beam, {a + 0.004f, architrave_y, -half}, {b - 0.004f, frieze_y - 0.08f, 0}, 0.015f);
  }
  add_chamfered_box(beam, {x0, frieze_y - 0.08f, -half}, {x1, frieze_y, half + 0.06f}, 0.01f);
  add_box(frieze, {x0, frieze_y, -half + 0.02f}, {x1, cornice_y, half - 0.06f});
  const Mesh three = triglyph();
  for (int i = 0; i <= 2 * bays; ++i) {
    const float x = 0.5f * bay * float(i);
    append(ornament, three, moved({x, frieze_y, half - 0.05f}));
    if (i == 2 * bays) break;
    // Metopes carry a shield each, some are lost.
    if (hash01(seed, uint32_t(i), 11) < 0.3f) continue;
    const vec3 centre(x + 0.25f * bay, frieze_y + 0.36f, half - 0.06f);
    add_cylinder(ornament, centre - vec3(0, 0, 0.02f), centre + vec3(0, 0, 0.02f), 0.27f, 0.25f, 32);
    add_torus(ornament, centre + vec3(0, 0, 0.02f), {0, 0, 1}, 0.19f, 0.02f, 32, 8);
    add_sphere(ornament, centre, 0.09f, 20, 12);
  }
  const float out = 0.4f;
  add_chamfered_box(cornice, {x0, cornice_y, -half}, {x1, cornice_y + 0.1f, half + 0.04f}, 0.01f);
  add_chamfered_box(cornice, {x0 - 0.2f, cornice_y + 0.16f, -half}, {x1 + 0.2f, cornice_y + 0.4f, half + out}, 0.02f);
  add_box(cornice, {x0, cornice_y + 0.1f, -half}, {x1, cornice_y + 0.16f, half + 0.02f});
  for (int i = 0; i <= 4 * bays; ++i) {  // mutules with their pegs
    const float x = 0.25f * bay * float(i);
    if (x - 0.24f < x0 || x + 0.24f > x1) continue;
    add_box(cornice, {x - 0.24f, cornice_y + 0.11f, half}, {x + 0.24f, cornice_y + 0.165f, half + out - 0.05f});
    for (int peg = 0; peg < 6; ++peg) {
      const vec3 top(x - 0.2f + 0.08f * float(peg), cornice_y + 0.11f, half + 0.5f * out + 0.08f);
      add_cylinder(cornice, top - vec3(0, 0.025f, 0), top, 0.025f, 0.02f, 8);
    }
  }
  place(scene, "architrave", m.marble, beam, at);
  place(scene, "frieze", m.stone, frieze, at);
  place(scene, "triglyphs", m.marble, ornament, at);
  place(scene, "cornice", m.weathered, cornice, at);
}

void add_pediment(Scene& scene, const Materials& m) {
  const float y = cornice_y + 0.4f, half = half_width + 0.8f, rise = 0.25f * half, slope = std::atan2(rise, half);
  Mesh back, raking, figures;
  add_extrusion(back, {{-half + 0.4f, y}, {half - 0.4f, y}, {0, y + rise - 0.1f}}, -0.3f, 0.1f);
  place(scene, "tympanum", m.stone, back, mat4(1));
  const float run = std::hypot(half, rise);
  Mesh bar;
  add_chamfered_box(bar, {-0.1f, 0, -0.42f}, {run, 0.16f, 0.72f}, 0.015f);
  add_chamfered_box(bar, {-0.15f, 0.16f, -0.42f}, {run, 0.3f, 0.84f}, 0.02f);
  append(raking, bar, moved({-half, y - 0.02f, 0}) * turned(slope, {0, 0, 1}));
  append(raking, bar, moved({half, y - 0.02f, 0}) * scaled({-1, 1, 1}) * turned(slope, {0, 0, 1}));
  place(scene, "raking cornice", m.weathered, raking, mat4(1));
  // What is left of the sculpture: robed figures, smaller towards the corners.
  for (const float x : {-3.6f, -2.3f, -1.1f, 0.0f, 1.2f, 3.3f}) {
    const float tall = 0.8f * (rise - 0.12f) * (1 - std::abs(x) / half) / 1.0f;
    Mesh body;
    add_lathe(body, vec3(0),
              {{0, 0},
               {0.24f, 0},
               {0.24f, 0},
               {0.22f, 0.2f},
               {0.14f, 0.5f},
               {0.18f, 0.68f},
               {0.17f, 0.76f},
               {0.06f, 0.82f},
               {0.05f, 0.86f},
               {0.09f, 0.9f},
               {0.09f, 0.96f},
               {0, 1.0f}},
              20);
    append(figures, body, moved({x, y, 0.36f}) * scaled({tall, tall, tall * 0.8f}));
  }
  place(scene, "pediment figures", m.weathered, figures, mat4(1));
}

/// What is left of the roof, over the front: flat tiles with covers over their joints, on timber.
void add_roof(Scene& scene, const Materials& m) {
  const float y = cornice_y + 0.4f, half = half_width + 0.8f, rise = 0.25f * half, slope = std::atan2(rise, half);
  const float run = std::hypot(half, rise), low = -7.4f;
  std::vector<vec2> cover = {{-0.09f, 0}, {0.09f, 0}, {0.09f, 0.05f}, {0, 0.1f}, {-0.09f, 0.05f}};
  Mesh tile;
  add_extrusion(tile, cover, -0.62f, 0);
  Mesh one_side, timber;
  for (int row = 0; row < 11; ++row) {
    const float s = 0.62f * float(row), end = std::min(s + 0.64f, run);
    for (int column = 0; column < 13; ++column) {
      const float z1 = -0.45f - 0.6f * float(column);
      if (z1 - 0.6f < low + 3 * hash01(uint32_t(row), 90)) continue;
      add_chamfered_box(one_side, {s, 0.16f, z1 - 0.6f}, {end, 0.21f + 0.01f * float(row % 2), z1}, 0.008f);
      append(one_side, tile, moved({s, 0.2f, z1 - 0.6f}) * turned_y(-pi / 2));
    }
  }
  for (int i = 0; i < 9; ++i) {
    const float z = -0.9f - 0.85f * float(i);
    add_chamfered_box(timber, {0.2f, -0.02f, z - 0.08f}, {run, 0.16f, z + 0.08f}, 0.01f);
  }
  for (const float sign : {1.0f, -1.0f}) {
    const mat4 at = moved({-sign * half, y - 0.02f, 0}) * scaled({sign, 1, 1}) * turned(slope, {0, 0, 1});
    place(scene, "roof tiles", m.clay, one_side, at);
    place(scene, "rafters", m.wood, timber, at);
  }
  Mesh beams;
  for (int i = 0; i < 4; ++i) {
    const float z = -1.2f - 2.0f * float(i);
    add_chamfered_box(beams, {-half_width - 0.2f, y - 0.3f, z - 0.14f}, {half_width + 0.2f, y, z + 0.14f}, 0.015f);
    add_chamfered_box(beams, {-0.12f, y, z - 0.12f}, {0.12f, y + rise - 0.05f, z + 0.12f}, 0.015f);
  }
  place(scene, "roof beams", m.wood, beams, mat4(1));
}

void add_cella(Scene& scene, const Materials& m) {
  const float x = 3.4f, front = -2.6f * bay, back = -6.9f * bay, thick = 0.55f, course = 0.5f;
  Mesh& mesh = add_mesh(scene, "cella wall", m.stone);
  for (int row = 0; row < 11; ++row) {
    const float y0 = floor_y - (row ? 0 : 0.02f) + course * float(row), y1 = floor_y + course * float(row + 1);
    const uint32_t seed = 200 + uint32_t(row) * 8;
    // Higher courses end sooner: the back has fallen.
    const float lost = std::max(0.0f, 0.85f * (float(row) - 3)), end = back + lost * (1 + 0.5f * hash01(seed));
    for (const float side : {-1.0f, 1.0f}) {
      const float a = side < 0 ? -x : x - thick;
      add_blocks(mesh, {a, y0, end + 0.4f * hash01(seed, uint32_t(side + 2))}, {a + thick, y1, front + 1.6f}, 2, 1.2f,
                 seed + uint32_t(side + 2));
    }
    if (row < 8) {
      add_blocks(mesh, {-x + thick, y0, front - thick}, {-1.0f, y1, front}, 0, 1.2f, seed + 4);
      add_blocks(mesh, {1.0f, y0, front - thick}, {x - thick, y1, front}, 0, 1.2f, seed + 5);
    } else {
      add_blocks(mesh, {-x + thick, y0, front - thick}, {x - thick, y1, front}, 0, 2.0f, seed + 4);
    }
    if (row < 4) add_blocks(mesh, {-x + thick, y0, back}, {x - thick, y1, back + thick}, 0, 1.2f, seed + 6);
  }
  Mesh& frame = add_mesh(scene, "door frame", m.marble);
  for (const float side : {-1.2f, 1.0f}) {
    add_chamfered_box(frame, {side, floor_y - 0.01f, front - 0.05f}, {side + 0.2f, floor_y + 3.8f, front + 0.1f},
                      0.015f);
  }
  add_chamfered_box(frame, {-1.35f, floor_y + 3.8f, front - 0.05f}, {1.35f, floor_y + 4.05f, front + 0.14f}, 0.02f);
  // The pedestal of the lost statue, with a tripod in its place.
  Mesh& pedestal = add_mesh(scene, "pedestal", m.marble);
  const vec3 p(0, floor_y - 0.02f, -5.6f * bay);
  add_chamfered_box(pedestal, p + vec3(-1.0f, 0, -1.0f), p + vec3(1.0f, 0.25f, 1.0f), 0.02f);
  add_chamfered_box(pedestal, p + vec3(-0.8f, 0.25f, -0.8f), p + vec3(0.8f, 1.15f, 0.8f), 0.02f);
  add_chamfered_box(pedestal, p + vec3(-0.92f, 1.15f, -0.92f), p + vec3(0.92f, 1.32f, 0.92f), 0.03f);
}

void add_tripod(Scene& scene, const Materials& m, vec3 at, float size) {
  Mesh metal, embers;
  add_lathe(metal, vec3(0),
            {{0, 0.78f},
             {0.12f, 0.79f},
             {0.26f, 0.86f},
             {0.34f, 1.0f},
             {0.36f, 1.06f},
             {0.37f, 1.06f},
             {0.37f, 1.08f},
             {0.33f, 1.08f},
             {0.31f, 1.0f},
             {0.22f, 0.89f},
             {0, 0.84f}},
            36);
  add_torus(metal, {0, 0.3f, 0}, {0, 1, 0}, 0.3f, 0.014f, 36, 8);
  for (int i = 0; i < 3; ++i) {
    const float angle = 2 * pi * float(i) / 3 + 0.4f;
    const vec3 out(std::sin(angle), 0, std::cos(angle));
    add_tube(
        metal,
        {0.38f * out, 0.3f * out + vec3(0, 0.3f, 0), 0.28f * out + vec3(0, 0.6f, 0), 0.34f * out + vec3(0, 0.95f, 0)},
        0.022f, 10);
    add_lathe(metal, 0.38f * out, {{0, 0}, {0.05f, 0}, {0.055f, 0.03f}, {0.02f, 0.06f}, {0, 0.06f}}, 12);
    add_torus(metal, 0.35f * out + vec3(0, 1.12f, 0), out, 0.05f, 0.01f, 20, 8);
  }
  for (uint32_t i = 0; i < 50; ++i) {
    const float r = 0.26f * std::sqrt(hash01(i, 95)), angle = 2 * pi * hash01(i, 96);
    add_sphere(embers, {r * std::sin(angle), 0.9f + 0.3f * r + 0.06f * hash01(i, 97), r * std::cos(angle)},
               0.035f + 0.02f * hash01(i, 98), 8, 6);
  }
  place(scene, "tripod", m.bronze, metal, moved(at) * scaled(vec3(size)));
  place(scene, "embers", m.embers, embers, moved(at) * scaled(vec3(size)));
}

void add_offerings(Scene& scene, const Materials& m) {
  add_tripod(scene, m, {-1.2f, floor_y, 0.35f}, 1);
  add_tripod(scene, m, {1.2f, floor_y, 0.35f}, 1);
  add_tripod(scene, m, {0, floor_y + 1.3f, -5.6f * bay}, 1.4f);
  const vec3 places[] = {
      {3.9f, 0.9f, 0.5f}, {4.25f, 0.9f, 0.2f}, {-3.3f, 0.9f, 0.4f}, {-3.7f, 0.9f, 0.55f}, {5.1f, 0.6f, 1.0f}};
  uint32_t id = 0;
  for (const vec3 at : places) {
    ++id;
    Mesh jar;
    add_lathe(jar, vec3(0),
              {{0, 0},
               {0.08f, 0},
               {0.09f, 0.02f},
               {0.07f, 0.04f},
               {0.16f, 0.2f},
               {0.2f, 0.36f},
               {0.17f, 0.48f},
               {0.07f, 0.56f},
               {0.06f, 0.64f},
               {0.09f, 0.69f},
               {0.085f, 0.7f},
               {0.05f, 0.66f},
               {0.05f, 0.58f},
               {0, 0.5f}},
              28);
    for (const float s : {-1.0f, 1.0f}) {
      add_tube(jar, {{s * 0.055f, 0.64f, 0}, {s * 0.12f, 0.66f, 0}, {s * 0.17f, 0.6f, 0}, {s * 0.175f, 0.47f, 0}},
               0.014f, 8);
    }
    place(scene, "amphora", m.clay, jar,
          moved(at) * turned_y(6 * hash01(id, 99)) * scaled(vec3(0.9f + 0.3f * hash01(id, 100))));
  }
}

/// Drums and blocks that fell, resting in the grass.
void add_fallen(Scene& scene, const Materials& m) {
  struct Fallen {
    float x, z, yaw, height;
    bool lies;
  };
  const Fallen drums[] = {
      {8.6f, 3.4f, 0.5f, 0.9f, true},    {9.3f, 1.6f, 1.3f, 1.0f, true},   {8.9f, -1.4f, 2.0f, 0.7f, false},
      {9.6f, -6.0f, 0.9f, 1.1f, true},   {8.6f, -9.2f, 0.2f, 0.9f, true},  {10.4f, -11.0f, 1.9f, 1.0f, true},
      {9.0f, -13.5f, 0.6f, 0.8f, false}, {4.4f, 4.4f, 0.2f, 0.8f, true},   {-5.2f, 5.2f, 1.1f, 1.0f, true},
      {11.0f, -3.2f, 2.6f, 0.9f, true},  {-8.9f, 3.1f, 0.8f, 0.8f, false}, {2.2f, 6.1f, 2.2f, 0.6f, false}};
  uint32_t id = 300;
  for (const Fallen& f : drums) {
    const float radius = 0.44f + 0.08f * hash01(++id), ground = ground_at(f.x, f.z);
    const Mesh drum = shaft(radius, radius - 0.02f, f.height, 4, f.lies ? 0.06f : 0.1f, id);
    const mat4 pose = f.lies ? moved({0, 0.9f * radius, -0.5f * f.height}) * turned(pi / 2, {1, 0, 0}) : mat4(1);
    place(scene, "drum", m.weathered, drum, moved({f.x, ground - 0.05f, f.z}) * turned_y(f.yaw) * pose);
  }
  for (uint32_t i = 0; i < 46; ++i) {
    const float x = i % 3 ? half_width + 2.2f + 4.5f * hash01(i, 301) : -9 + 19 * hash01(i, 302);
    const float z = i % 3 ? 2 - 22 * hash01(i, 303) : 2.6f + 4.5f * hash01(i, 304);
    const vec3 half =
        vec3(0.18f + 0.35f * hash01(i, 305), 0.12f + 0.16f * hash01(i, 306), 0.15f + 0.25f * hash01(i, 307));
    Mesh block;
    add_chamfered_box(block, -half, half, 0.02f + 0.03f * hash01(i, 308));
    place(scene, "block", i % 2 ? m.stone : m.weathered, block,
          moved({x, ground_at(x, z) + 0.7f * half.y, z}) * turned_y(6 * hash01(i, 309)) *
              turned(0.35f * (hash01(i, 310) - 0.5f), {1, 0, 0.5f}));
  }
  // A capital that landed on its side, and a stretch of frieze.
  place(scene, "fallen capital", m.marble, capital(),
        moved({6.3f, ground_at(6.3f, 4.9f) + 0.5f, 4.9f}) * turned_y(3.4f) * turned(1.9f, {1, 0, 0.2f}));
  Mesh piece;
  add_chamfered_box(piece, {-1.0f, 0, -0.4f}, {1.0f, 0.76f, 0.02f}, 0.02f);
  for (const float x : {-0.6f, 0.6f}) append(piece, triglyph(), moved({x, 0, 0}));
  place(scene, "fallen frieze", m.weathered, piece,
        moved({-2.6f, ground_at(-2.6f, 4.6f) + 0.12f, 4.6f}) * turned_y(0.35f) * turned(-0.25f, {1, 0, 0}));
}

void add_landscape(Scene& scene, const Materials& m) {
  const float reach = 90;
  // Finer about the temple: the parameter is bent.
  const auto bent = [&](float t) { return reach * (2 * t - 1) * (0.25f + 0.75f * (2 * t - 1) * (2 * t - 1)); };
  const auto ground = [&](float u, float v) {
    const float x = bent(u), z = -0.5f * length - bent(v);
    return vec3(x, ground_at(x, z), z);
  };
  add_surface(add_mesh(scene, "ground", m.ground), ground, 180, 180);
  Mesh& grass = add_mesh(scene, "grass", m.grass);
  for (uint32_t i = 0; i < 2600; ++i) {
    const float angle = 2 * pi * hash01(i, 400), far = i % 2 ? 3.5f : 12;
    const float x = 7 + far * std::sqrt(hash01(i, 401)) * std::cos(angle) - (i % 3) * 5;
    const float z = 5 + far * std::sqrt(hash01(i, 402)) * std::sin(angle);
    if (std::abs(x) < half_width + 1.7f && z < 1.7f) continue;
    const float y = ground_at(x, z) - 0.02f;
    for (uint32_t blade = 0; blade < 5; ++blade) {
      const float turn = 2 * pi * hash01(i, blade, 403), tall = 0.1f + 0.22f * hash01(i, blade, 404);
      const vec3 lean(std::sin(turn), 0, std::cos(turn)), wide(0.008f * lean.z, 0, -0.008f * lean.x);
      const vec3 root = vec3(x, y, z) + 0.05f * lean, middle = root + vec3(0, 0.6f * tall, 0) + 0.15f * tall * lean;
      add_quad(grass, root - wide, root + wide, middle + 0.7f * wide, middle - 0.7f * wide);
      add_triangle(grass, middle - 0.7f * wide, middle + 0.7f * wide, root + vec3(0, tall, 0) + 0.5f * tall * lean);
    }
  }
  for (uint32_t i = 0; i < 70; ++i) {
    const float angle = 2 * pi * hash01(i, 410), far = 11 + 30 * hash01(i, 411);
    const float x = far * std::cos(angle), z = -0.5f * length + 1.3f * far * std::sin(angle),
                size = 0.1f + 0.5f * hash01(i, 412);
    const auto boulder = [&](float u, float v) {
      const float polar = pi * (1 - v), turn = 2 * pi * (u < 1 ? u : 0);
      const vec3 d(std::sin(polar) * std::sin(turn), std::cos(polar), std::sin(polar) * std::cos(turn));
      const float r = 0.7f + 0.6f * noise(1.7f * d.x + 9 + d.y, 1.7f * d.z + 9 - d.y, i + 413);
      return size * r * d * vec3(1.2f, 0.8f, 1);
    };
    Mesh rock;
    add_surface(rock, boulder, 20, 12);
    place(scene, "rock", m.rock, rock, moved({x, ground_at(x, z) + 0.15f * size, z}));
  }
}

void add_cypresses(Scene& scene, const Materials& m) {
  for (uint32_t i = 0; i < 16; ++i) {
    const float side = i % 2 ? 1.0f : -1.0f, x = side * (13 + 14 * hash01(i, 500)), z = -4 - 34 * hash01(i, 501);
    const float tall = 6 + 4 * hash01(i, 502), y = ground_at(x, z);
    Mesh trunk, crown;
    add_cylinder(trunk, {0, -0.3f, 0}, {0, 0.6f * tall, 0}, 0.2f, 0.05f, 10);
    for (uint32_t k = 0; k < 1500; ++k) {
      const float v = hash01(i, k, 503), turn = 2 * pi * hash01(i, k, 504);
      const float wide = 0.16f * tall * std::pow(std::sin(pi * (0.08f + 0.88f * v)), 0.7f) * (1 - 0.55f * v);
      const vec3 out(std::sin(turn), 0, std::cos(turn)), side_way(out.z, 0, -out.x);
      const vec3 root = wide * (0.45f + 0.45f * hash01(i, k, 505)) * out + vec3(0, tall * (0.07f + 0.86f * v), 0);
      const vec3 tip = root + 0.16f * out + vec3(0, 0.42f, 0);
      add_triangle(crown, root - 0.09f * side_way, root + 0.09f * side_way, tip);
    }
    place(scene, "cypress trunk", m.bark, trunk, moved({x, y, z}));
    place(scene, "cypress needles", m.needles, crown, moved({x, y, z}));
  }
}

Scene make(const ParameterValues&) {
  Scene scene;
  const Materials m = add_materials(scene);
  add_landscape(scene, m);
  add_steps(scene, m);
  add_columns(scene, m);
  add_entablature(scene, m, moved({-half_width, 0, 0}), across - 1, 0.42f, 0.42f, 20);
  add_entablature(scene, m, moved({-half_width, 0, -length}) * turned_y(-pi / 2), along - 1, 0.42f, -0.42f, 21);
  add_entablature(scene, m, moved({half_width, 0, 0}) * turned_y(pi / 2), 4, -0.42f, 0.3f, 22);
  add_pediment(scene, m);
  add_roof(scene, m);
  add_cella(scene, m);
  add_offerings(scene, m);
  add_fallen(scene, m);
  add_cypresses(scene, m);
  scene.cameras = {looking_at("main", {13.2f, 1.8f, 10.6f}, {1.6f, 3.7f, -5.0f}, 68),
                   looking_at("drums", {7.6f, 1.3f, 6.2f}, {8.6f, 0.5f, 2.0f}, 60),
                   looking_at("peristyle", {4.7f, 2.6f, -1.2f}, {4.6f, 2.9f, -14.0f}, 74)};
  scene.light.to_sun = {0.75f, 0.8f, 0.55f};
  scene.light.sun = {2.6f, 2.3f, 1.85f};
  scene.light.zenith = {0.22f, 0.34f, 0.6f};
  scene.light.horizon = {0.5f, 0.55f, 0.6f};
  scene.ao_radius = 0.8;
  return scene;
}

}  // namespace

std::vector<SceneRecipe> temple() {
  return {{.name = "temple",
           .summary = "a half-fallen Doric temple with fluted columns, entablature, cella and drums in the grass",
           .kind = "architecture",
           .make = make}};
}

}  // namespace gloam::scenes
