// A museum: two rooms under skylights, framed pictures, sculptures on pedestals, a polished floor, ropes and benches.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "scene/built_in/mesh_builder.h"

namespace gloam::scenes {
namespace {

using glm::mat4;
constexpr float pi = glm::pi<float>();

// The front room is 12 m wide and 14 m deep (z from 3 to -11), the one behind it 8 m deep.
constexpr float half_width = 6, front = 3, middle = -11, back = -19, height = 5, thick = 0.4f;

struct Materials {
  int wall, red_wall, ceiling, floor, skirting, gilt, dark_wood, oak, leather, brass, chrome, bronze, marble, slate,
      clay, rope, lamp, black, white;
  std::vector<int> pictures;
};

vec3 hue(float t) {
  return 0.5f + 0.45f * vec3(std::cos(2 * pi * t), std::cos(2 * pi * (t - 0.33f)), std::cos(2 * pi * (t - 0.67f)));
}

/// Hills under an evening sky.
vec3 landscape(float x, float y, uint32_t seed) {
  vec3 colour =
      glm::mix(vec3(0.35f, 0.45f, 0.65f), vec3(0.92f, 0.7f, 0.45f), y) + 0.12f * (noise(6 * x, 14 * y, seed) - 0.5f);
  if (glm::length(vec2(x - 0.3f - 0.4f * hash01(seed), 0.7f * (y - 0.35f))) < 0.06f) colour = {0.98f, 0.9f, 0.7f};
  for (int ridge = 0; ridge < 4; ++ridge) {
    const float line =
        0.4f + 0.14f * float(ridge) - 0.25f * (noise(2.5f * x + 7 * float(ridge), 0.5f, seed + 1) - 0.4f);
    if (y > line)
      colour = glm::mix(vec3(0.45f, 0.48f, 0.5f), vec3(0.14f, 0.22f, 0.08f), float(ridge) / 3) *
               (0.8f + 0.4f * noise(30 * x, 30 * y, seed));
  }
  return colour;
}

/// Coloured fields between black lines.
vec3 fields(float x, float y, uint32_t seed) {
  vec2 low(0), high(1);
  uint32_t path = seed;
  for (int cut = 0; cut < 5; ++cut) {
    const int axis = cut % 2;
    const float at = glm::mix(low[axis], high[axis], 0.25f + 0.5f * hash01(path, uint32_t(cut)));
    const bool upper = (axis ? y : x) > at;
    (upper ? low : high)[axis] = at;
    path = path * 2 + (upper ? 1 : 0) + 11;
  }
  const float edge = std::min(std::min(x - low.x, high.x - x), std::min(y - low.y, high.y - y));
  if (edge < 0.012f) return vec3(0.06f);
  const vec3 inks[] = {{0.8f, 0.12f, 0.08f}, {0.1f, 0.2f, 0.6f}, {0.9f, 0.75f, 0.1f},
                       vec3(0.88f),          vec3(0.85f),        vec3(0.9f)};
  return inks[size_t(6 * hash01(path, 99))];
}

/// Overlapping discs.
vec3 discs(float x, float y, uint32_t seed) {
  vec3 colour = 0.3f * hue(hash01(seed, 50)) + 0.05f;
  for (uint32_t i = 0; i < 14; ++i) {
    const float r = 0.05f + 0.2f * hash01(seed, i, 1),
                d = glm::length(vec2(x - hash01(seed, i, 2), y - hash01(seed, i, 3)));
    if (d < r) colour = glm::mix(colour, hue(hash01(seed, i, 4)), d > 0.8f * r ? 0.9f : 0.55f);
  }
  return colour;
}

/// Head and shoulders before a dark ground.
vec3 portrait(float x, float y, uint32_t seed) {
  vec3 colour = vec3(0.16f, 0.11f, 0.07f) * (0.6f + 0.9f * noise(4 * x, 4 * y, seed));
  const float shoulders = 0.72f + 1.6f * (x - 0.5f) * (x - 0.5f);
  if (y > shoulders) colour = 0.45f * hue(hash01(seed, 7)) * (0.6f + 0.5f * noise(9 * x, 3 * y, seed));
  const vec2 head((x - 0.5f) / 0.15f, (y - 0.45f) / 0.21f);
  if (std::abs(x - 0.5f) < 0.07f && y > 0.5f && y < shoulders + 0.03f) colour = {0.58f, 0.40f, 0.29f};
  if (glm::length(head - vec2(0, -0.15f)) < 1.12f && head.y < 0.1f) colour = {0.12f, 0.08f, 0.05f};
  if (glm::length(head) < 1) colour = vec3(0.72f, 0.52f, 0.39f) * (0.85f + 0.25f * head.x);
  for (const float eye : {-0.38f, 0.38f}) {
    if (glm::length((head - vec2(eye, -0.1f)) * vec2(1, 2)) < 0.14f) colour = {0.1f, 0.07f, 0.05f};
  }
  if (std::abs(head.y - 0.5f) < 0.05f && std::abs(head.x) < 0.3f) colour = {0.55f, 0.2f, 0.17f};
  return colour;
}

int add_picture(Scene& scene, uint32_t seed) {
  const auto paint = std::array{landscape, fields, discs, portrait}[seed % 4];
  const std::string name = "picture " + std::to_string(seed);
  const int material = add_material(scene, name, vec3(1), seed % 4 == 3 ? 0.25f : 0.6f);
  scene.materials.back().albedo_texture =
      add_texture(scene, name, 160, 128, [=](float x, float y) { return paint(x, y, seed); });
  return material;
}

Materials add_materials(Scene& scene) {
  Materials m;
  m.wall = add_material(scene, "grey wall", {0.58f, 0.57f, 0.54f}, 0.9f);
  m.red_wall = add_material(scene, "red wall", {0.36f, 0.11f, 0.10f}, 0.9f);
  m.ceiling = add_material(scene, "ceiling", {0.72f, 0.71f, 0.68f}, 0.95f);
  m.floor = add_material(scene, "polished stone", {0.34f, 0.30f, 0.26f}, 0.08f);
  m.skirting = add_material(scene, "dark skirting", {0.12f, 0.11f, 0.10f}, 0.3f);
  m.gilt = add_material(scene, "gilt", {0.85f, 0.64f, 0.28f}, 0.35f, 1);
  m.dark_wood = add_material(scene, "ebony", {0.09f, 0.06f, 0.05f}, 0.3f);
  m.oak = add_material(scene, "oak", {0.42f, 0.28f, 0.15f}, 0.45f);
  m.leather = add_material(scene, "leather", {0.20f, 0.09f, 0.05f}, 0.5f);
  m.brass = add_material(scene, "polished brass", {0.88f, 0.70f, 0.34f}, 0.12f, 1);
  m.chrome = add_material(scene, "polished steel", {0.77f, 0.78f, 0.80f}, 0.1f, 1);
  m.bronze = add_material(scene, "patinated bronze", {0.40f, 0.33f, 0.22f}, 0.3f, 1);
  m.marble = add_material(scene, "marble", {0.72f, 0.70f, 0.66f}, 0.25f);
  m.slate = add_material(scene, "slate", {0.18f, 0.19f, 0.21f}, 0.5f);
  m.clay = add_material(scene, "terracotta", {0.55f, 0.29f, 0.19f}, 0.8f);
  m.rope = add_material(scene, "velvet rope", {0.35f, 0.03f, 0.05f}, 1);
  m.black = add_material(scene, "black enamel", {0.03f, 0.03f, 0.03f}, 0.3f);
  m.white = add_material(scene, "white paint", {0.75f, 0.75f, 0.73f}, 0.5f);
  m.lamp = add_material(scene, "lamp", {0.9f, 0.9f, 0.9f}, 0.4f);
  scene.materials[size_t(m.lamp)].emission = {0.98f, 0.92f, 0.8f};
  for (uint32_t i = 0; i < 12; ++i) m.pictures.push_back(add_picture(scene, i));
  return m;
}

/// Frame whose x runs along a wall, y up, z out of it; `turn` as turned_y: 0 faces +z.
mat4 on_wall(vec3 foot, float turn) { return moved(foot) * turned_y(turn); }

void add_building(Scene& scene, const Materials& m) {
  Mesh& floor = add_mesh(scene, "floor", m.floor);
  for (int row = 0; row < 23; ++row) {
    for (int column = 0; column < 12; ++column) {
      const float x = -half_width + float(column), z = back - 1 + float(row);
      add_chamfered_box(floor, {x + 0.001f, -0.05f, z + 0.001f}, {x + 0.999f, 0, z + 0.999f}, 0.0015f);
    }
  }
  add_box(add_mesh(scene, "ground", m.slate), {-10, -0.3f, back - 4}, {10, -0.05f, front + 4});
  // Side walls; the one on the right has tall windows in the back room.
  const float length = front - back;
  Mesh left, right, divider, near_wall, far_wall;
  add_extrusion(left, rectangle({0, -0.05f}, {length, height}), -thick, 0);
  place(scene, "left wall", m.wall, left, on_wall({-half_width, 0, front}, pi / 2));
  add_extrusion(right, rectangle({0, -0.05f}, {length, height}),
                {rectangle({1.4f, 0.9f}, {2.8f, 3.9f}), rectangle({4.2f, 0.9f}, {5.6f, 3.9f})}, -thick, 0);
  place(scene, "right wall", m.wall, right, on_wall({half_width, 0, back}, -pi / 2));
  const auto doors = [](float at) { return rectangle({at, -0.05f}, {at + 2.2f, 3.2f}); };
  add_extrusion(divider, wall({-half_width, -0.05f}, {half_width, height}, {doors(-4.4f), doors(2.2f)}), -thick, 0);
  place(scene, "divider", m.red_wall, divider, moved({0, 0, middle}));
  add_extrusion(near_wall, wall({-half_width, -0.05f}, {half_width, height}, {doors(-1.1f)}), 0, thick);
  place(scene, "near wall", m.wall, near_wall, moved({0, 0, front}));
  add_extrusion(far_wall, rectangle({-half_width, -0.05f}, {half_width, height}), -thick, 0);
  place(scene, "far wall", m.wall, far_wall, moved({0, 0, back}));
  Mesh frames;
  for (const float x : {-4.4f, 2.2f}) {
    for (const float z : {middle - thick - 0.03f, middle - 0.03f}) {
      add_chamfered_box(frames, {x - 0.18f, 0, z}, {x, 3.4f, z + 0.06f}, 0.012f);
      add_chamfered_box(frames, {x + 2.2f, 0, z}, {x + 2.38f, 3.4f, z + 0.06f}, 0.012f);
      add_chamfered_box(frames, {x, 3.2f, z}, {x + 2.2f, 3.4f, z + 0.06f}, 0.012f);
      add_chamfered_box(frames, {x - 0.25f, 3.4f, z - 0.03f}, {x + 2.45f, 3.52f, z + 0.09f}, 0.02f);
    }
  }
  for (int i = 0; i < 2; ++i) {  // window bars
    const float z = back + 1.4f + 2.8f * float(i);
    for (int k = 0; k <= 3; ++k) {
      const float at = z + 0.03f + 1.34f * float(k) / 3;
      add_box(frames, {half_width + 0.2f, 0.9f, at - 0.03f}, {half_width + 0.26f, 3.9f, at + 0.03f});
    }
    for (int k = 0; k <= 5; ++k) {
      const float y = 0.93f + 2.94f * float(k) / 5;
      add_box(frames, {half_width + 0.205f, y - 0.03f, z}, {half_width + 0.255f, y + 0.03f, z + 1.4f});
    }
  }
  place(scene, "frames", m.white, frames, mat4(1));
}

/// A plate with three skylights over the front room and one over the back room, with curbs, bars and coffers between.
void add_ceiling(Scene& scene, const Materials& m) {
  const float centres[] = {0.0f, -4.0f, -8.0f, -15.0f};
  std::vector<std::vector<vec2>> holes;
  Mesh plate, curbs, bars, beams;
  for (const float z : centres) holes.push_back(rectangle({-2.6f, -z - 1.2f}, {2.6f, -z + 1.2f}));
  // Drawn in (x, -z), then laid down.
  add_extrusion(plate, rectangle({-half_width - thick, -front - thick}, {half_width + thick, -back + thick}), holes,
                height, height + 0.3f);
  place(scene, "ceiling", m.ceiling, plate, turned(-pi / 2, {1, 0, 0}));
  for (const float z : centres) {
    const float x = 2.6f, half = 1.2f, low = height - 0.12f, high = height + 0.7f;
    add_box(curbs, {-x - 0.12f, low, z - half - 0.12f}, {-x, high, z + half + 0.12f});
    add_box(curbs, {x, low, z - half - 0.12f}, {x + 0.12f, high, z + half + 0.12f});
    add_box(curbs, {-x, low, z - half - 0.12f}, {x, high, z - half});
    add_box(curbs, {-x, low, z + half}, {x, high, z + half + 0.12f});
    for (int k = 1; k < 8; ++k) {
      const float at = -x + 2 * x * float(k) / 8;
      add_box(bars, {at - 0.025f, high - 0.12f, z - half}, {at + 0.025f, high - 0.02f, z + half});
    }
    for (const float at : {z - 0.4f, z + 0.4f})
      add_box(bars, {-x, high - 0.1f, at - 0.02f}, {x, high - 0.04f, at + 0.02f});
  }
  place(scene, "skylight curb", m.white, curbs, mat4(1));
  place(scene, "skylight bars", m.skirting, bars, mat4(1));
  for (const float z : {2.0f, -2.0f, -6.0f, -10.0f, -12.6f, -17.4f}) {
    add_chamfered_box(beams, {-half_width, height - 0.28f, z - 0.14f}, {half_width, height, z + 0.14f}, 0.02f);
  }
  for (const float x : {-4.2f, 4.2f}) {
    add_chamfered_box(beams, {x - 0.12f, height - 0.22f, middle}, {x + 0.12f, height, front}, 0.02f);
  }
  place(scene, "ceiling beams", m.white, beams, mat4(1));
  for (const float side : {-1.0f, 1.0f}) {  // lamps on rails
    Mesh rail, heads, lamps;
    add_box(rail, {side * 3.4f - 0.02f, height - 0.5f, middle + 0.5f},
            {side * 3.4f + 0.02f, height - 0.46f, front - 0.4f});
    for (float z = front - 0.6f; z > middle + 0.5f; z -= 3.1f)
      add_cylinder(rail, {side * 3.4f, height - 0.47f, z}, {side * 3.4f, height, z}, 0.008f, 0.008f, 8);
    for (int i = 0; i < 10; ++i) {
      const vec3 at(side * 3.4f, height - 0.58f, front - 1.0f - 1.25f * float(i));
      const vec3 aim = glm::normalize(vec3(side * 2.4f, -1.8f, 0.4f * (hash01(uint32_t(i), 5) - 0.5f)));
      add_cylinder(heads, at + vec3(0, 0.1f, 0), at, 0.012f, 0.012f, 8);
      add_cylinder(heads, at - 0.1f * aim, at + 0.12f * aim, 0.045f, 0.06f, 20);
      add_cylinder(lamps, at + 0.115f * aim, at + 0.128f * aim, 0.05f, 0.05f, 20);
    }
    place(scene, "lamp rail", m.black, rail, mat4(1));
    place(scene, "spotlights", m.black, heads, mat4(1));
    place(scene, "spotlight lenses", m.lamp, lamps, mat4(1));
  }
}

void add_mouldings(Scene& scene, const Materials& m) {
  Mesh skirting, cornice;
  const auto along = [&](const mat4& at, float x0, float x1, bool with_skirting) {
    Mesh low, high;
    add_chamfered_box(low, {x0, 0, -0.01f}, {x1, 0.2f, 0.025f}, 0.008f);
    add_chamfered_box(low, {x0, 0, -0.01f}, {x1, 0.05f, 0.045f}, 0.008f);
    add_chamfered_box(high, {x0, height - 0.16f, -0.01f}, {x1, height, 0.1f}, 0.02f);
    add_chamfered_box(high, {x0, height - 0.26f, -0.01f}, {x1, height - 0.16f, 0.05f}, 0.012f);
    add_chamfered_box(high, {x0, 3.68f, -0.01f}, {x1, 3.73f, 0.03f}, 0.008f);
    if (with_skirting) append(skirting, low, at);
    append(cornice, high, at);
  };
  along(on_wall({-half_width, 0, front}, pi / 2), 0, front - middle, true);
  along(on_wall({half_width, 0, middle}, -pi / 2), 0, front - middle, true);
  along(on_wall({-half_width, 0, middle - thick}, pi / 2), 0, middle - thick - back, true);
  along(moved({0, 0, back}), -half_width, half_width, true);
  along(moved({0, 0, middle}), -half_width, -4.65f, true);
  along(moved({0, 0, middle}), -1.95f, 1.95f, true);
  along(moved({0, 0, middle}), 4.65f, half_width, true);
  along(moved({0, 0, middle}), -4.65f, -1.95f, false);
  along(moved({0, 0, middle}), 1.95f, 4.65f, false);
  place(scene, "skirting", m.skirting, skirting, mat4(1));
  place(scene, "cornice", m.white, cornice, mat4(1));
}

/// A picture with a moulded frame; the middle of its lower edge at the origin of `at`. It hangs from the rail or not.
void add_framed(Scene& scene, const Materials& m, const mat4& at, float w, float h, uint32_t id, bool hangs = true) {
  const float bar = 0.07f + 0.06f * hash01(id, 1);
  // The frame's profile runs round the picture: four mitred bars, each a strip of the profile between two corners.
  const vec2 profile[] = {{0, 0.02f},     {0.1f, 0.035f}, {0.25f, 0.03f}, {0.4f, 0.06f},
                          {0.7f, 0.075f}, {0.9f, 0.055f}, {1, 0.05f},     {1, 0}};
  Mesh frame;
  const vec2 corners[] = {{-0.5f * w, 0}, {0.5f * w, 0}, {0.5f * w, h}, {-0.5f * w, h}},
             outward[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (int side = 0; side < 4; ++side) {
    const int next = (side + 1) % 4;
    for (size_t i = 0; i + 1 < std::size(profile); ++i) {
      const auto point = [&](int corner, vec2 p) { return vec3(corners[corner] + bar * p.x * outward[corner], p.y); };
      add_quad(frame, point(side, profile[i + 1]), point(next, profile[i + 1]), point(next, profile[i]),
               point(side, profile[i]));
    }
  }
  const int frames[] = {m.gilt, m.dark_wood, m.gilt, m.oak};
  place(scene, "picture frame", frames[id % 4], frame, at);
  Mesh canvas;
  add_textured_quad(canvas, {-0.5f * w, 0, 0.022f}, {0.5f * w, 0, 0.022f}, {0.5f * w, h, 0.022f},
                    {-0.5f * w, h, 0.022f});
  place(scene, "picture", m.pictures[id % m.pictures.size()], canvas, at);
  Mesh label;
  add_chamfered_box(label, {0.5f * w + bar + 0.1f, 0, 0}, {0.5f * w + bar + 0.24f, 0.09f, 0.008f}, 0.002f);
  place(scene, "label", m.white, label, at);
  if (!hangs) return;
  Mesh wires;
  for (const float x : {-0.3f * w, 0.3f * w})
    add_cylinder(wires, {x, h + 0.5f * bar, 0.015f}, {x, std::max(3.68f - 1.1f, h + 0.3f), 0.015f}, 0.003f, 0.003f, 6);
  place(scene, "wires", m.brass, wires, at);
}

void add_pictures(Scene& scene, const Materials& m) {
  uint32_t id = 0;
  for (int i = 0; i < 6; ++i) {  // the long walls of the front room
    const float along = 1.6f + 2.25f * float(i);
    for (const bool left : {true, false}) {
      ++id;
      const mat4 at = left ? on_wall({-half_width, 1.1f, front - along}, pi / 2)
                           : on_wall({half_width, 1.1f, front - along}, -pi / 2);
      const float w = 1.0f + 0.6f * hash01(id, 2), h = 0.9f + 0.7f * hash01(id, 3);
      if (hash01(id, 4) < 0.25f) {  // two small ones, one above the other
        add_framed(scene, m, at, 0.7f * w, 0.65f, id, false);
        add_framed(scene, m, at * moved({0, 1.15f, 0}), 0.7f * w, 0.6f, id + 5, false);
      } else {
        add_framed(scene, m, at, w, h, id);
      }
    }
  }
  add_framed(scene, m, on_wall({0, 1.1f, middle}, 0), 2.6f, 1.8f, 12);
  add_framed(scene, m, on_wall({-5.25f, 1.3f, middle}, 0), 0.6f, 0.8f, 7);
  add_framed(scene, m, on_wall({5.25f, 1.3f, middle}, 0), 0.6f, 0.8f, 3);
  for (int i = 0; i < 5; ++i)
    add_framed(scene, m, on_wall({-4.6f + 2.3f * float(i), 1.1f, back}, 0), 1.2f, 1.0f + 0.5f * hash01(uint32_t(i), 6),
               20 + uint32_t(i));
  for (int i = 0; i < 3; ++i)
    add_framed(scene, m, on_wall({-half_width, 1.1f, middle - 1.8f - 2.2f * float(i)}, pi / 2), 1.3f, 1.2f,
               30 + uint32_t(i));
  // A free-standing screen with pictures on both sides.
  Mesh screen, feet;
  add_chamfered_box(screen, {-1.6f, 0.12f, -0.08f}, {1.6f, 2.7f, 0.08f}, 0.01f);
  for (const float x : {-1.2f, 1.2f})
    add_chamfered_box(feet, {x - 0.06f, 0, -0.35f}, {x + 0.06f, 0.12f, 0.35f}, 0.015f);
  const mat4 at = moved({3.0f, 0, -6.9f}) * turned_y(-0.5f);
  place(scene, "screen", m.white, screen, at);
  place(scene, "screen feet", m.black, feet, at);
  for (const float x : {-0.8f, 0.75f}) {
    add_framed(scene, m, at * moved({x, 1.1f, 0.08f}), 0.9f, 0.75f, x < 0 ? 40 : 45, false);
    add_framed(scene, m, at * turned_y(pi) * moved({x, 1.1f, 0.08f}), 0.9f, 0.75f, x < 0 ? 50 : 55, false);
  }
}

float add_pedestal(Scene& scene, int material, vec3 at, float half, float tall) {
  Mesh& mesh = add_mesh(scene, "pedestal", material);
  add_chamfered_box(mesh, at + vec3(-half - 0.05f, 0, -half - 0.05f), at + vec3(half + 0.05f, 0.1f, half + 0.05f),
                    0.012f);
  add_chamfered_box(mesh, at + vec3(-half, 0.1f, -half), at + vec3(half, tall - 0.06f, half), 0.01f);
  add_chamfered_box(mesh, at + vec3(-half - 0.03f, tall - 0.06f, -half - 0.03f),
                    at + vec3(half + 0.03f, tall, half + 0.03f), 0.012f);
  return tall;
}

/// A knot of thick tube, its lowest point at y = 0.
Mesh knot() {
  Mesh mesh;
  const auto centre = [](float t) {
    const float r = 0.24f + 0.09f * std::cos(3 * t);
    return vec3(r * std::cos(2 * t), 0.405f + r * std::sin(2 * t), 0.11f * std::sin(3 * t));
  };
  const auto surface = [&](float u, float v) {
    const float t = 2 * pi * (u < 1 ? u : 0), angle = 2 * pi * (v < 1 ? v : 0);
    const vec3 along = glm::normalize(centre(t + 0.01f) - centre(t - 0.01f));
    const vec3 x = glm::normalize(glm::cross(along, vec3(0, 0, 1))), y = glm::cross(along, x);
    return centre(t) - 0.075f * (std::cos(angle) * x - std::sin(angle) * y);
  };
  add_surface(mesh, surface, 240, 20);
  return mesh;
}

/// A standing twisted bar with a rounded square section.
Mesh twist() {
  Mesh mesh;
  const auto surface = [](float u, float v) {
    const float angle = 2 * pi * (u < 1 ? u : 0), turn = 3.5f * v;
    const float c = std::cos(angle), s = std::sin(angle), round = std::pow(c * c * c * c + s * s * s * s, -0.25f);
    const float r = 0.17f * round * (1 - 0.35f * std::sin(pi * v)) * (v >= 1 ? 0.0f : 1.0f);
    return vec3(r * std::sin(angle + turn), 1.1f * v, r * std::cos(angle + turn));
  };
  add_surface(mesh, surface, 64, 70);
  return mesh;
}

Mesh bust() {
  Mesh mesh, head;
  add_lathe(mesh, vec3(0),
            {{0, 0}, {0.12f, 0}, {0.12f, 0}, {0.13f, 0.03f}, {0.08f, 0.06f}, {0.07f, 0.12f}, {0.1f, 0.14f}, {0, 0.15f}},
            32);
  const auto shoulders = [](float u, float v) {
    const float angle = 2 * pi * (u < 1 ? u : 0);
    const float r = v < 0.5f ? 0.1f + 0.14f * std::sin(pi * v)
                             : 0.05f + 0.19f * std::pow(std::max(0.0f, std::cos(pi * (v - 0.5f))), 1.5f);
    return vec3(1.05f * r * std::sin(angle), 0.13f + 0.34f * v, 0.62f * r * std::cos(angle));
  };
  add_surface(mesh, shoulders, 48, 24);
  const auto face = [](float u, float v) {
    const float angle = 2 * pi * (u < 1 ? u : 0), polar = pi * (1 - v);
    vec3 d(std::sin(polar) * std::sin(angle), std::cos(polar), std::sin(polar) * std::cos(angle));
    const float nose = 0.035f * std::exp(-60 * d.x * d.x - 14 * (d.y + 0.1f) * (d.y + 0.1f)) * (d.z > 0 ? 1.0f : 0.0f);
    const float brow = 0.012f * std::exp(-50 * (d.y - 0.22f) * (d.y - 0.22f)) * std::max(d.z, 0.0f);
    const float eyes =
        -0.014f *
        std::exp(-70 * (std::abs(d.x) - 0.36f) * (std::abs(d.x) - 0.36f) - 90 * (d.y - 0.06f) * (d.y - 0.06f)) *
        std::max(d.z, 0.0f);
    const float curls = d.y > 0.35f || d.z < -0.1f ? 0.006f * std::sin(26 * d.x) * std::sin(24 * d.y) : 0.0f;
    return vec3(0, 0.61f, 0.01f) + d * (vec3(0.105f, 0.15f, 0.13f) * (1 + 4 * curls)) + vec3(0, 0, nose + brow + eyes);
  };
  add_surface(head, face, 64, 48);
  append(mesh, head, turned_y(0.3f));
  return mesh;
}

void add_sculptures(Scene& scene, const Materials& m) {
  const auto stand = [&](vec3 at, int material, float half, float tall) {
    return moved(at + vec3(0, add_pedestal(scene, material, at, half, tall), 0));
  };
  place(scene, "knot", m.chrome, knot(),
        stand({-1.3f, 0, -2.2f}, m.white, 0.3f, 1.0f) * turned_y(0.5f) * moved({0, -0.01f, 0}));
  place(scene, "twist", m.bronze, twist(), stand({2.4f, 0, -3.3f}, m.slate, 0.3f, 0.6f));
  place(scene, "bust", m.marble, bust(), stand({-4.3f, 0, -4.6f}, m.marble, 0.2f, 1.15f) * turned_y(0.9f));
  place(scene, "bust", m.bronze, bust(), stand({0, 0, -9.9f}, m.white, 0.22f, 0.7f) * scaled(vec3(1.0f)));
  place(scene, "bust", m.marble, bust(), stand({4.6f, 0, -9.6f}, m.slate, 0.2f, 1.1f) * turned_y(-0.8f));
  place(
      scene, "vase", m.clay,
      [] {
        Mesh vase;
        add_lathe(vase, vec3(0),
                  {{0, 0},
                   {0.1f, 0},
                   {0.11f, 0.02f},
                   {0.07f, 0.06f},
                   {0.2f, 0.3f},
                   {0.24f, 0.48f},
                   {0.2f, 0.64f},
                   {0.08f, 0.76f},
                   {0.075f, 0.84f},
                   {0.13f, 0.9f},
                   {0.12f, 0.905f},
                   {0.06f, 0.84f},
                   {0, 0.8f}},
                  56);
        for (const float s : {-1.0f, 1.0f})
          add_tube(vase, {{s * 0.075f, 0.8f, 0}, {s * 0.19f, 0.84f, 0}, {s * 0.25f, 0.74f, 0}, {s * 0.21f, 0.6f, 0}},
                   0.018f, 10);
        return vase;
      }(),
      stand({4.4f, 0, -1.0f}, m.white, 0.25f, 0.95f) * turned_y(1.0f));
  // Rings leaning into each other, and a heap of spheres.
  Mesh rings, heap;
  const float r = 0.32f, t = 0.035f;
  add_torus(rings, {0, r + t, 0}, {0, 0, 1}, r, t, 72, 18);
  add_torus(rings, {0.1f, r + t, 0}, {1, 0, 0}, r, t, 72, 18);
  add_torus(rings, {0, t, 0}, {0, 1, 0}, r, t, 72, 18);
  place(scene, "rings", m.brass, rings, stand({-3.2f, 0, -8.2f}, m.slate, 0.4f, 0.8f));
  const float ball = 0.17f;
  for (int layer = 0; layer < 3; ++layer) {
    for (int i = 0; i < 3 - layer; ++i) {
      for (int k = 0; k < 3 - layer; ++k) {
        const float offset = -ball * float(2 - layer);
        add_sphere(
            heap,
            {offset + 2 * ball * float(i), ball + std::sqrt(2.0f) * ball * float(layer), offset + 2 * ball * float(k)},
            ball, 36, 20);
      }
    }
  }
  place(scene, "heap of spheres", m.marble, heap, stand({0.6f, 0, -6.2f}, m.dark_wood, 0.55f, 0.35f));
  place(scene, "twist", m.marble, twist(), stand({-2.0f, 0, -15.5f}, m.white, 0.3f, 0.8f));
  place(scene, "knot", m.bronze, knot(), stand({3.2f, 0, -15.0f}, m.white, 0.3f, 1.1f));
}

void add_bench(Scene& scene, const Materials& m, const mat4& at) {
  Mesh frame, pads;
  for (const float x : {-0.8f, 0.8f}) {
    for (const float z : {-0.22f, 0.22f})
      add_chamfered_box(frame, {x - 0.025f, 0, z - 0.025f}, {x + 0.025f, 0.36f, z + 0.025f}, 0.004f);
  }
  add_chamfered_box(frame, {-0.9f, 0.34f, -0.28f}, {0.9f, 0.38f, 0.28f}, 0.006f);
  for (int i = 0; i < 3; ++i) {
    const float x = -0.6f + 0.6f * float(i);
    const auto cushion = [&](float u, float v) {
      const float a = 2 * u - 1, b = 2 * v - 1, puff = (1 - a * a * a * a) * (1 - b * b * b * b);
      const float button = 0.02f * std::exp(-90 * (a * a + b * b));
      return vec3(x + 0.295f * a, 0.42f + 0.045f * puff - button, -0.275f * b);
    };
    add_box(pads, {x - 0.295f, 0.38f, -0.275f}, {x + 0.295f, 0.42f, 0.275f});
    add_surface(pads, cushion, 24, 24);
  }
  place(scene, "bench frame", m.chrome, frame, at);
  place(scene, "bench cushions", m.leather, pads, at);
}

void add_barrier(Scene& scene, const Materials& m, const std::vector<vec3>& posts) {
  for (const vec3 at : posts) {
    add_lathe(add_mesh(scene, "barrier post", m.brass), at,
              {{0, 0},
               {0.16f, 0},
               {0.16f, 0},
               {0.16f, 0.015f},
               {0.12f, 0.03f},
               {0.03f, 0.05f},
               {0.022f, 0.08f},
               {0.022f, 0.86f},
               {0.035f, 0.87f},
               {0.035f, 0.92f},
               {0.022f, 0.93f},
               {0.04f, 0.96f},
               {0.03f, 0.99f},
               {0, 1.0f}},
              28);
  }
  for (size_t i = 0; i + 1 < posts.size(); ++i) {
    const vec3 along = 0.035f * glm::normalize(posts[i + 1] - posts[i]), up(0, 0.895f, 0);
    add_tube(add_mesh(scene, "barrier rope", m.rope),
             hanging_rope(posts[i] + along + up, posts[i + 1] - along + up, 0.22f, 24), 0.02f, 12);
  }
}

void add_showcase(Scene& scene, const Materials& m, const mat4& at) {
  Mesh body, things;
  for (const float x : {-0.7f, 0.7f}) {
    for (const float z : {-0.25f, 0.25f})
      add_lathe(body, {x, 0, z}, {{0, 0}, {0.02f, 0}, {0.035f, 0.3f}, {0.025f, 0.4f}, {0.035f, 0.72f}}, 14);
  }
  add_chamfered_box(body, {-0.78f, 0.7f, -0.33f}, {0.78f, 0.8f, 0.33f}, 0.01f);
  for (const float x : {-0.78f, 0.75f}) add_box(body, {x, 0.8f, -0.33f}, {x + 0.03f, 0.86f, 0.33f});
  for (const float z : {-0.33f, 0.3f}) add_box(body, {-0.75f, 0.8f, z}, {0.75f, 0.86f, z + 0.03f});
  place(scene, "showcase", m.oak, body, at);
  for (uint32_t i = 0; i < 24; ++i) {
    const vec3 p(-0.62f + 0.177f * float(i % 8), 0.8f, -0.2f + 0.2f * float(i / 8));
    if (i % 3 == 0) add_torus(things, p + vec3(0, 0.012f, 0), {0, 1, 0}, 0.035f, 0.012f, 24, 8);
    if (i % 3 == 1)
      add_lathe(things, p,
                {{0, 0}, {0.02f, 0}, {0.035f, 0.02f}, {0.03f, 0.05f}, {0.012f, 0.06f}, {0.02f, 0.075f}, {0, 0.08f}},
                18);
    if (i % 3 == 2) add_cylinder(things, p, p + vec3(0, 0.012f, 0), 0.045f, 0.04f, 24);
  }
  place(scene, "finds", m.bronze, things, at);
}

Scene make(const ParameterValues&) {
  Scene scene;
  const Materials m = add_materials(scene);
  add_building(scene, m);
  add_ceiling(scene, m);
  add_mouldings(scene, m);
  add_pictures(scene, m);
  add_sculptures(scene, m);
  add_bench(scene, m, moved({-0.2f, 0, -4.1f}));
  add_bench(scene, m, moved({2.2f, 0, -0.7f}) * turned_y(pi / 2));
  add_bench(scene, m, moved({0.5f, 0, -14.6f}));
  add_barrier(scene, m, {{-4.9f, 0, 1.4f}, {-4.9f, 0, -0.4f}, {-4.9f, 0, -2.2f}, {-4.9f, 0, -3.7f}});
  add_barrier(scene, m, {{-1.6f, 0, -9.0f}, {0, 0, -8.9f}, {1.6f, 0, -9.0f}});
  add_barrier(scene, m,
              {{-2.2f, 0, -1.3f}, {-0.4f, 0, -1.3f}, {-0.4f, 0, -3.1f}, {-2.2f, 0, -3.1f}, {-2.2f, 0, -1.3f}});
  add_showcase(scene, m, moved({-3.4f, 0, 0.2f}) * turned_y(0.3f));
  add_showcase(scene, m, moved({0.6f, 0, -17.2f}));
  add_barrier(scene, m, {{-3.0f, 0, -18.0f}, {-1.2f, 0, -18.0f}, {0.6f, 0, -18.2f}});
  add_showcase(scene, m, moved({4.2f, 0, -4.6f}) * turned_y(pi / 2));
  scene.cameras = {looking_at("main", {1.6f, 1.65f, 2.5f}, {-0.7f, 1.35f, -6.0f}, 74),
                   looking_at("knot", {-0.2f, 1.7f, -0.9f}, {-1.3f, 1.25f, -2.3f}, 50),
                   looking_at("back", {-3.7f, 1.65f, -11.1f}, {0.6f, 1.3f, -17.0f}, 76)};
  scene.light.to_sun = {0.35f, 1.0f, 0.15f};
  scene.light.sun = {2.4f, 2.2f, 1.9f};
  scene.light.zenith = {0.42f, 0.46f, 0.52f};
  scene.light.horizon = {0.48f, 0.48f, 0.48f};
  scene.light.ground = {0.30f, 0.28f, 0.26f};
  scene.ao_radius = 0.5;
  return scene;
}

}  // namespace

std::vector<SceneRecipe> gallery() {
  return {{.name = "gallery",
           .summary = "a museum with skylights, a polished floor, framed pictures, sculptures and rope barriers",
           .kind = "architecture",
           .make = make}};
}

}  // namespace gloam::scenes
