// The lounge of a hotel at dusk: stone, lacquer and mirrors that reflect lamps, a fire, a bar and tall windows.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "scene/built_in/mesh_builder.h"

namespace gloam::scenes {
namespace {

using glm::mat4;
using Outline = std::vector<vec2>;
constexpr float pi = glm::pi<float>();

// 9 m wide and 12 m deep: the windows of the far wall are at z = -9, the doors behind the main camera at z = 3.
constexpr float half_width = 4.5f, front = 3, back = -9, height = 3.6f, thick = 0.35f;

struct Materials {
  int plaster, ceiling, frame_paint, soot, terrace, rug, curtain, paper, silk, coffer, dusk, shade, lamp, glow, flame;
  int black_marble, brown_marble, red_marble, parquet, granite, white_marble, green_marble;
  int mirror, chrome, silver, brass, copper, old_brass, gilt, steel;
  int black_lacquer, red_lacquer, green_lacquer, mahogany, walnut, oak, ivory, ebony, spruce;
  int porcelain, celadon, cobalt, stoneware, terracotta;
  int brown_leather, green_leather, red_velvet, blue_velvet, leaf, bark, petal, lemon, wax;
  std::vector<int> books, bottles, pictures, towers;
};

// --- Textures.

/// Noise of four sizes, in [0, 1].
float clouds(float x, float y, uint32_t seed) {
  float sum = 0;
  for (uint32_t octave = 0; octave < 4; ++octave) {
    const float scale = float(1u << octave);
    sum += noise(scale * x, scale * y, seed + octave) / scale;
  }
  return sum / 1.875f;
}

/// A stone tile: veins where a bent noise passes one half, and a dark joint round it.
vec3 stone(float x, float y, vec3 ground, vec3 vein, uint32_t seed) {
  const float bend = 1.6f * clouds(2 * x, 2 * y, seed);
  float line = 0;
  for (uint32_t i = 0; i < 3; ++i) {
    const float scale = 1.5f + 1.2f * float(i);
    const float off = std::abs(clouds(scale * x + bend, scale * y - bend, seed + 10 * i) - 0.5f);
    line = std::max(line, std::exp(-70 * off) / (1 + 0.6f * float(i)));
  }
  const vec3 colour = glm::mix(ground * (0.75f + 0.5f * clouds(5 * x, 5 * y, seed + 40)), vein, line);
  return std::min(std::min(x, 1 - x), std::min(y, 1 - y)) < 0.005f ? 0.45f * colour : colour;
}

/// Grain along x.
vec3 wood(float x, float y, uint32_t seed) {
  const float rings = clouds(3 * x, 14 * y + 2 * clouds(2 * x, 3 * y, seed), seed);
  const vec3 colour = glm::mix(vec3(0.25f, 0.14f, 0.08f), vec3(0.47f, 0.29f, 0.17f), rings);
  const float joint = std::min(std::min(x, 1 - x) * 8, std::min(y, 1 - y));
  return colour * (joint < 0.02f ? 0.45f : 0.85f + 0.3f * noise(40 * x, 160 * y, seed + 5));
}

/// Woven silk: rows of pointed ovals, shifted by half a step from row to row.
vec3 damask(float x, float y) {
  const float across = 8 * x, up = 12 * y, shift = std::fmod(std::floor(up), 2.0f) > 0.5f ? 0.5f : 0.0f;
  const vec2 p(std::abs(across + shift - std::floor(across + shift) - 0.5f), std::abs(up - std::floor(up) - 0.5f));
  const float oval = p.x * 2 + p.y * p.y * 3.2f;
  const bool figure = oval < 0.75f && (oval > 0.55f || oval < 0.3f);
  return figure ? vec3(0.50f, 0.36f, 0.20f) : vec3(0.36f, 0.12f, 0.12f);
}

/// The sky after sunset, with long clouds lit from below.
vec3 evening_sky(float x, float y) {
  vec3 colour = glm::mix(vec3(0.27f, 0.42f, 0.68f), vec3(0.98f, 0.72f, 0.45f), std::pow(y, 1.4f));
  const float cloud = std::clamp(2.6f * clouds(9 * x, 22 * y, 3) - 1.25f, 0.0f, 1.0f);
  colour = glm::mix(colour, glm::mix(vec3(0.55f, 0.45f, 0.55f), vec3(1.0f, 0.55f, 0.35f), y), 0.8f * cloud);
  return colour;
}

/// Windows of a house seen from afar; about four in ten are lit.
vec3 lit_windows(float x, float y, uint32_t seed) {
  const float column = std::floor(10 * x), row = std::floor(16 * y);
  const vec2 p(10 * x - column, 16 * y - row);
  if (p.x < 0.25f || p.x > 0.75f || p.y < 0.2f || p.y > 0.8f) return vec3(0);
  const float chance = hash01(uint32_t(column), uint32_t(row), seed);
  return chance < 0.4f ? vec3(1.0f, 0.78f, 0.45f) * (0.6f + chance) : vec3(0.05f, 0.06f, 0.1f);
}

vec3 hue(float t) {
  return 0.5f + 0.4f * vec3(std::cos(2 * pi * t), std::cos(2 * pi * (t - 0.33f)), std::cos(2 * pi * (t - 0.67f)));
}

/// Boats on a lit sea.
vec3 regatta(float x, float y, uint32_t seed) {
  const vec3 sea = glm::mix(vec3(0.85f, 0.65f, 0.45f), vec3(0.1f, 0.28f, 0.38f), std::clamp(2 * y - 0.9f, 0.0f, 1.0f));
  vec3 colour = y < 0.45f ? glm::mix(vec3(0.45f, 0.6f, 0.75f), vec3(0.95f, 0.8f, 0.55f), 2 * y)
                          : sea * (0.8f + 0.4f * noise(12 * x, 70 * y, seed));
  for (uint32_t boat = 0; boat < 5; ++boat) {
    const float size = 0.08f + 0.05f * float(boat), foot = 0.45f + 0.08f * float(boat);
    const vec2 p((x - hash01(seed, boat, 1)) / size, (foot - y) / size);
    if (p.y > 0.2f && p.y < 2.4f && p.x > 0 && p.x < 0.8f * (1 - p.y / 2.4f)) colour = {0.93f, 0.88f, 0.78f};
    if (p.y > 0.2f && p.y < 2 && p.x < -0.05f && p.x > -0.5f * (1 - p.y / 2)) colour = hue(hash01(seed, boat, 2));
    if (p.y > 0 && p.y < 0.16f && std::abs(p.x) < 0.7f + p.y) colour = {0.2f, 0.1f, 0.07f};
  }
  return colour;
}

/// Rings that cross.
vec3 rings(float x, float y, uint32_t seed) {
  vec3 colour = glm::mix(vec3(0.85f, 0.8f, 0.68f), 0.4f * hue(hash01(seed, 9)), y);
  for (uint32_t i = 0; i < 9; ++i) {
    const float radius = 0.1f + 0.28f * hash01(seed, i, 1);
    const float off = glm::length(vec2(x - hash01(seed, i, 2), y - hash01(seed, i, 3))) - radius;
    if (std::abs(off) < 0.035f) colour = glm::mix(colour, hue(hash01(seed, i, 4)), 0.85f);
  }
  return colour;
}

/// Fruit on a dark table.
vec3 still_life(float x, float y, uint32_t seed) {
  vec3 colour = y < 0.62f ? vec3(0.2f, 0.15f, 0.11f) * (0.7f + 0.7f * noise(3 * x, 3 * y, seed))
                          : vec3(0.42f, 0.27f, 0.16f) * (0.8f + 0.4f * noise(3 * x, 40 * y, seed));
  for (uint32_t i = 0; i < 8; ++i) {
    const float radius = 0.07f + 0.05f * hash01(seed, i, 1);
    const vec2 p = (vec2(x, y) - vec2(0.2f + 0.6f * hash01(seed, i, 2), 0.55f + 0.02f * float(i))) / radius;
    if (glm::length(p) > 1) continue;
    const float light = std::max(0.15f, 0.75f - 0.4f * p.x - 0.45f * p.y);
    colour = light * glm::mix(vec3(0.85f, 0.25f, 0.08f), vec3(0.8f, 0.75f, 0.15f), hash01(seed, i, 3));
  }
  return colour;
}

// --- Materials.

/// Adds a material that shines by itself; what it emits is `radiance` times a texture, where there is one.
int add_light(Scene& scene, const std::string& name, vec3 albedo, vec3 radiance, int texture = -1) {
  const int material = add_material(scene, name, albedo, 0.9f);
  scene.materials.back().emission = radiance;
  scene.materials.back().emission_texture = texture;
  return material;
}

/// Adds a material whose colour is a texture.
int add_painted(Scene& scene, const std::string& name, float roughness, int size, const Painter& painter) {
  const int texture = add_texture(scene, name, size, size, painter);
  const int material = add_material(scene, name, vec3(1), roughness);
  scene.materials.back().albedo_texture = texture;
  return material;
}

void add_plain_materials(Scene& scene, Materials& m) {
  m.plaster = add_material(scene, "plaster", {0.50f, 0.44f, 0.36f}, 0.9f);
  m.ceiling = add_material(scene, "ceiling", {0.62f, 0.58f, 0.50f}, 0.95f);
  m.frame_paint = add_material(scene, "frame paint", {0.13f, 0.11f, 0.09f}, 0.3f);
  m.soot = add_material(scene, "soot", {0.04f, 0.035f, 0.03f}, 0.95f);
  m.terrace = add_material(scene, "terrace stone", {0.45f, 0.42f, 0.38f}, 0.85f);
  m.rug = add_material(scene, "rug", {0.20f, 0.05f, 0.06f}, 1);
  m.curtain = add_material(scene, "velvet curtain", {0.33f, 0.07f, 0.09f}, 0.95f);
  m.paper = add_material(scene, "paper", {0.78f, 0.76f, 0.70f}, 0.9f);
  m.red_velvet = add_material(scene, "red velvet", {0.50f, 0.05f, 0.07f}, 0.9f);
  m.blue_velvet = add_material(scene, "blue velvet", {0.06f, 0.24f, 0.36f}, 0.9f);
  m.brown_leather = add_material(scene, "brown leather", {0.33f, 0.15f, 0.07f}, 0.38f);
  m.green_leather = add_material(scene, "green leather", {0.07f, 0.22f, 0.13f}, 0.44f);
  m.leaf = add_material(scene, "leaf", {0.10f, 0.28f, 0.07f}, 0.5f);
  m.bark = add_material(scene, "bark", {0.25f, 0.18f, 0.10f}, 0.85f);
  m.petal = add_material(scene, "petal", {0.85f, 0.33f, 0.08f}, 0.6f);
  m.lemon = add_material(scene, "lemon", {0.85f, 0.68f, 0.08f}, 0.4f);
  m.wax = add_material(scene, "wax", {0.82f, 0.77f, 0.62f}, 0.5f);
}

void add_polished_materials(Scene& scene, Materials& m) {
  m.mirror = add_material(scene, "mirror", {0.95f, 0.95f, 0.95f}, 0, 1);
  m.chrome = add_material(scene, "chrome", {0.77f, 0.78f, 0.80f}, 0.05f, 1);
  m.silver = add_material(scene, "silver", {0.92f, 0.90f, 0.86f}, 0.1f, 1);
  m.brass = add_material(scene, "polished brass", {0.88f, 0.70f, 0.34f}, 0.14f, 1);
  m.copper = add_material(scene, "copper", {0.92f, 0.58f, 0.42f}, 0.2f, 1);
  m.steel = add_material(scene, "steel wire", {0.62f, 0.62f, 0.62f}, 0.26f, 1);
  m.old_brass = add_material(scene, "old brass", {0.70f, 0.54f, 0.26f}, 0.32f, 1);
  m.gilt = add_material(scene, "gilt", {0.90f, 0.70f, 0.32f}, 0.4f, 1);
  m.granite = add_material(scene, "granite", {0.05f, 0.05f, 0.06f}, 0.03f);
  m.white_marble = add_material(scene, "white marble", {0.70f, 0.67f, 0.62f}, 0.18f);
  m.green_marble = add_material(scene, "green marble", {0.05f, 0.15f, 0.10f}, 0.07f);
  m.black_lacquer = add_material(scene, "black lacquer", {0.012f, 0.011f, 0.012f}, 0.04f);
  m.red_lacquer = add_material(scene, "red lacquer", {0.42f, 0.03f, 0.02f}, 0.08f);
  m.green_lacquer = add_material(scene, "green lacquer", {0.02f, 0.16f, 0.14f}, 0.12f);
  m.mahogany = add_material(scene, "french-polished mahogany", {0.22f, 0.07f, 0.035f}, 0.16f);
  m.walnut = add_material(scene, "waxed walnut", {0.16f, 0.09f, 0.05f}, 0.28f);
  m.oak = add_material(scene, "oiled oak", {0.38f, 0.25f, 0.13f}, 0.48f);
  m.ivory = add_material(scene, "ivory", {0.80f, 0.76f, 0.66f}, 0.2f);
  m.ebony = add_material(scene, "ebony", {0.025f, 0.02f, 0.02f}, 0.24f);
  m.spruce = add_material(scene, "spruce", {0.58f, 0.40f, 0.20f}, 0.34f);
  m.porcelain = add_material(scene, "porcelain", {0.80f, 0.80f, 0.77f}, 0.06f);
  m.celadon = add_material(scene, "celadon glaze", {0.36f, 0.55f, 0.44f}, 0.1f);
  m.cobalt = add_material(scene, "cobalt glaze", {0.04f, 0.11f, 0.42f}, 0.09f);
  m.stoneware = add_material(scene, "stoneware", {0.42f, 0.33f, 0.24f}, 0.55f);
  m.terracotta = add_material(scene, "terracotta", {0.55f, 0.27f, 0.16f}, 0.6f);
}

void add_floor_materials(Scene& scene, Materials& m) {
  m.black_marble = add_painted(scene, "black marble", 0.05f, 192, [](float x, float y) {
    return stone(x, y, {0.14f, 0.13f, 0.13f}, {0.4f, 0.37f, 0.32f}, 100);
  });
  m.brown_marble = add_painted(scene, "brown marble", 0.15f, 192, [](float x, float y) {
    return stone(x, y, {0.41f, 0.31f, 0.24f}, {0.54f, 0.43f, 0.34f}, 200);
  });
  m.red_marble = add_painted(scene, "red marble", 0.24f, 192, [](float x, float y) {
    return stone(x, y, {0.38f, 0.15f, 0.12f}, {0.6f, 0.42f, 0.36f}, 300);
  });
  m.parquet = add_painted(scene, "parquet", 0.36f, 128, [](float x, float y) { return wood(x, y, 7); });
  // Its wax is worn in places.
  scene.materials.back().roughness_texture = add_texture(
      scene, "worn wax", 64, 64, [](float x, float y) { return vec3(0.6f + 0.4f * clouds(3 * x, 3 * y, 21)); });
}

void add_lights(Scene& scene, Materials& m) {
  const auto fading = [&](const std::string& name, vec3 low, vec3 high) {
    return add_texture(scene, name, 4, 64, [=](float, float y) { return glm::mix(high, low, y); });
  };
  m.lamp = add_light(scene, "lamp", vec3(0.8f), {4.5f, 3.6f, 2.4f});
  m.shade = add_light(scene, "lampshade", {0.6f, 0.5f, 0.36f}, {2.6f, 1.75f, 0.95f},
                      fading("shade", {1, 1, 1}, {0.62f, 0.56f, 0.5f}));
  m.flame = add_light(scene, "flame", vec3(0), {4.0f, 2.2f, 0.7f}, fading("fire", {1, 1, 1}, {0.9f, 0.35f, 0.1f}));
  m.glow = add_light(scene, "bar glow", {0.3f, 0.2f, 0.1f}, {1.5f, 0.95f, 0.45f},
                     fading("glow", {1, 1, 1}, {0.55f, 0.5f, 0.5f}));
  m.dusk = add_light(scene, "evening sky", vec3(0), vec3(1.5f), add_texture(scene, "sky", 256, 128, evening_sky));
  m.silk = add_painted(scene, "silk", 0.7f, 192, damask);
  scene.materials.back().emission = {0.55f, 0.33f, 0.15f};
  scene.materials.back().emission_texture = add_texture(scene, "light of a sconce", 64, 64, [](float x, float y) {
    const vec2 p(1.6f * (x - 0.5f), 1.7f * (y - 0.34f));
    return vec3(std::exp(-5 * glm::dot(p, p)));
  });
  m.coffer = add_light(scene, "coffer", {0.6f, 0.55f, 0.45f}, {0.7f, 0.48f, 0.26f},
                       add_texture(scene, "light of a cove", 64, 64, [](float x, float y) {
                         const float edge = std::min(std::min(x, 1 - x), std::min(y, 1 - y));
                         return vec3(0.25f + 0.75f * std::exp(-9 * edge));
                       }));
}

void add_families(Scene& scene, Materials& m) {
  const vec3 cloths[] = {{0.32f, 0.05f, 0.05f}, {0.06f, 0.16f, 0.10f}, {0.07f, 0.10f, 0.26f},
                         {0.36f, 0.23f, 0.10f}, {0.55f, 0.48f, 0.34f}, {0.10f, 0.08f, 0.08f}};
  const vec3 glazes[] = {{0.05f, 0.22f, 0.08f}, {0.45f, 0.18f, 0.03f}, {0.60f, 0.10f, 0.08f},
                         {0.08f, 0.20f, 0.38f}, {0.66f, 0.52f, 0.22f}, {0.62f, 0.62f, 0.58f}};
  for (int i = 0; i < 6; ++i) {
    const std::string number = " " + std::to_string(i);
    m.books.push_back(add_material(scene, "book cloth" + number, cloths[i], 0.4f + 0.04f * float(i)));
    m.bottles.push_back(add_material(scene, "bottle glaze" + number, glazes[i], 0.03f + 0.03f * float(i)));
  }
  using Picture = vec3 (*)(float, float, uint32_t);
  const Picture painters[] = {regatta, rings, still_life};
  for (uint32_t i = 0; i < 9; ++i) {
    const Picture painter = painters[i % 3];
    m.pictures.push_back(add_painted(scene, "picture " + std::to_string(i), 0.12f + 0.05f * float(i), 144,
                                     [=](float x, float y) { return painter(x, y, i); }));
  }
  for (uint32_t i = 0; i < 3; ++i) {
    const int lit = add_texture(scene, "lit windows", 128, 128, [=](float x, float y) { return lit_windows(x, y, i); });
    m.towers.push_back(add_light(scene, "tower", {0.13f, 0.12f, 0.15f}, vec3(1.4f), lit));
  }
}

Materials add_materials(Scene& scene) {
  Materials m;
  add_plain_materials(scene, m);
  add_polished_materials(scene, m);
  add_floor_materials(scene, m);
  add_lights(scene, m);
  add_families(scene, m);
  // Wax and lacquer over stone and paint are denser than common glazes.
  for (const int polished : {m.black_marble, m.brown_marble, m.red_marble, m.green_marble, m.granite, m.black_lacquer,
                             m.red_lacquer, m.green_lacquer})
    scene.materials[size_t(polished)].reflectance = 0.07f;
  return m;
}

// --- Shapes.

/// Frame whose x runs along a wall, y up, z out of it; `turn` as turned_y: 0 faces +z.
mat4 on_wall(vec3 foot, float turn) { return moved(foot) * turned_y(turn); }
mat4 on_left_wall(float z) { return on_wall({-half_width, 0, z}, pi / 2); }
mat4 on_right_wall(float z) { return on_wall({half_width, 0, z}, -pi / 2); }

/// Drawn in (x, -z), then laid down: what was extruded along z rises.
mat4 laid_down() { return turned(-pi / 2, {1, 0, 0}); }

float bent(float x, float power) { return std::copysign(std::pow(std::abs(x), power), x); }

/// A closed shape between an ellipsoid (`power` 1) and a box (small powers).
void add_pillow(Mesh& mesh, vec3 centre, vec3 half, float power = 0.4f, int columns = 32, int rows = 16) {
  const auto surface = [&](float u, float v) {
    const float angle = 2 * pi * (u < 1 ? u : 0), polar = pi * (1 - v);
    const float ring = v <= 0 || v >= 1 ? 0 : bent(std::sin(polar), power);
    return centre + half * vec3(ring * bent(std::sin(angle), power), bent(std::cos(polar), power),
                                ring * bent(std::cos(angle), power));
  };
  add_surface(mesh, surface, columns, rows);
}

/// A padded band along a path of t in [0, 1], closed at its ends: `half` is its thickness and its height.
void add_band(Mesh& mesh, const std::function<vec3(float)>& path, vec2 half, int columns = 24, int rows = 40) {
  const auto surface = [&](float u, float v) {
    const vec3 along = glm::normalize(path(v + 0.01f) - path(v - 0.01f));
    const vec3 x = glm::normalize(glm::cross(vec3(0, 1, 0), along)), y = glm::cross(along, x);
    const float angle = 2 * pi * (u < 1 ? u : 0), end = std::pow(std::abs(2 * v - 1), 16.0f);
    const float size = v <= 0 || v >= 1 ? 0 : std::pow(1 - end, 0.25f);
    return path(v) + size * (half.x * bent(std::cos(angle), 0.6f) * x + half.y * bent(std::sin(angle), 0.6f) * y);
  };
  add_surface(mesh, surface, columns, rows);
}

/// Buttoned upholstery on the face z = high.z of a box: `buttons` across and up.
void add_tufted(Mesh& mesh, vec3 low, vec3 high, int across, int up) {
  add_box(mesh, low, high);
  const auto surface = [&](float u, float v) {
    const float a = 2 * u - 1, b = 2 * v - 1, edge = (1 - std::pow(a, 20.0f)) * (1 - std::pow(b, 12.0f));
    const float s = u * float(across), t = v * float(up);
    const float folds = std::abs(std::sin(pi * (s + t) / 2 + pi / 4) * std::sin(pi * (s - t) / 2 + pi / 4));
    return vec3(glm::mix(low.x, high.x, u), glm::mix(low.y, high.y, v),
                high.z + edge * (0.02f + 0.035f * std::sqrt(folds)));
  };
  add_surface(mesh, surface, 10 * across, 10 * up);
}

/// Four mitred bars round a rectangle of w x h; the middle of its lower edge at the origin, the wall at z = 0.
Mesh frame(float w, float h, float bar) {
  const vec2 profile[] = {{0, 0},        {0, 0.018f},    {0.08f, 0.03f}, {0.2f, 0.026f}, {0.35f, 0.045f},
                          {0.5f, 0.04f}, {0.72f, 0.07f}, {0.9f, 0.06f},  {1, 0.045f},    {1, 0}};
  const vec2 corners[] = {{-0.5f * w, 0}, {0.5f * w, 0}, {0.5f * w, h}, {-0.5f * w, h}};
  const vec2 outward[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  Mesh mesh;
  for (int side = 0; side < 4; ++side) {
    const int next = (side + 1) % 4;
    for (size_t i = 0; i + 1 < std::size(profile); ++i) {
      const auto point = [&](int corner, vec2 p) { return vec3(corners[corner] + bar * p.x * outward[corner], p.y); };
      add_quad(mesh, point(side, profile[i + 1]), point(next, profile[i + 1]), point(next, profile[i]),
               point(side, profile[i]));
    }
  }
  return mesh;
}

/// Texture coordinates by height alone, for textures that fade upwards.
void map_by_height(Mesh& mesh) {
  float low = mesh.positions[0].y, high = low;
  for (const vec3& p : mesh.positions) low = std::min(low, p.y), high = std::max(high, p.y);
  for (const vec3& p : mesh.positions) mesh.uvs.push_back({0.5f, 0.98f - 0.96f * (p.y - low) / (high - low)});
}

/// Profiles below are written as radius, height, radius, height ... from bottom to top.
std::vector<vec2> pairs(const std::vector<float>& numbers) {
  std::vector<vec2> points;
  for (size_t i = 0; i + 1 < numbers.size(); i += 2) points.push_back({numbers[i], numbers[i + 1]});
  return points;
}

void add_turned(Mesh& mesh, vec3 base, const std::vector<float>& profile, int segments) {
  add_lathe(mesh, base, pairs(profile), segments);
}

Mesh lathe(const std::vector<float>& profile, int segments = 32) {
  Mesh mesh;
  add_turned(mesh, vec3(0), profile, segments);
  return mesh;
}

/// A smooth curve through `guides`, `steps` points from one to the next.
std::vector<vec2> smooth(const std::vector<vec2>& guides, int steps) {
  std::vector<vec2> points;
  const auto guide = [&](size_t i) { return guides[std::min(i, guides.size() - 1)]; };
  for (size_t i = 0; i + 1 < guides.size(); ++i) {
    const vec2 a = guides[i], b = guides[i + 1];
    // Tangents are no longer than the piece: where a short one follows a long one, the curve would loop.
    const auto limited = [&](vec2 tangent) {
      return tangent * std::min(1.0f, glm::length(b - a) / glm::length(tangent));
    };
    const vec2 from = limited(0.5f * (b - guides[i > 0 ? i - 1 : 0])), to = limited(0.5f * (guide(i + 2) - a));
    for (int k = 0; k < steps; ++k) {
      const float t = float(k) / float(steps), s = 1 - t;
      points.push_back(s * s * (1 + 2 * t) * a + t * t * (3 - 2 * t) * b + s * t * (s * from - t * to));
    }
  }
  points.push_back(guides.back());
  return points;
}

/// A closed shape: a smooth curve through `guides`, with a foot and a lid.
Mesh turned_shape(const std::vector<float>& guides, int segments = 32, int steps = 4) {
  const std::vector<vec2> curve = smooth(pairs(guides), steps);
  std::vector<vec2> profile = {{0, curve.front().y}, curve.front()};
  profile.insert(profile.end(), curve.begin(), curve.end());
  profile.push_back({0, curve.back().y});
  Mesh mesh;
  add_lathe(mesh, vec3(0), profile, segments);
  return mesh;
}

enum class Pot { jar, flask, urn, bowl };

/// About 1 high and up to 0.7 across, but the bowl, which is 0.45 high.
Mesh pot(Pot kind, int segments = 36, int steps = 4) {
  switch (kind) {
    case Pot::jar:
      return turned_shape({0.16f, 0,    0.18f, 0.08f, 0.33f, 0.5f,  0.3f,  0.72f, 0.14f, 0.82f, 0.13f,
                           0.86f, 0.2f, 0.88f, 0.17f, 0.94f, 0.04f, 0.97f, 0.05f, 1.0f,  0.02f, 1.03f},
                          segments, steps);
    case Pot::flask:
      return turned_shape({0.13f, 0, 0.16f, 0.03f, 0.29f, 0.2f, 0.26f, 0.38f, 0.09f, 0.55f, 0.06f, 0.8f, 0.1f, 0.98f,
                           0.09f, 1.0f, 0.05f, 0.97f},
                          segments, steps);
    case Pot::urn:
      return turned_shape({0.18f, 0,     0.17f, 0.04f, 0.08f, 0.1f, 0.12f, 0.2f, 0.3f,  0.5f,
                           0.33f, 0.75f, 0.2f,  0.9f,  0.24f, 1.0f, 0.22f, 1.0f, 0.17f, 0.9f},
                          segments, steps);
    case Pot::bowl:
      break;
  }
  return turned_shape({0.2f, 0, 0.18f, 0.06f, 0.3f, 0.14f, 0.48f, 0.42f, 0.47f, 0.45f, 0.3f, 0.2f}, segments, steps);
}

void place_pot(Scene& scene, int material, Pot kind, vec3 at, float size) {
  place(scene, "vase", material, pot(kind), moved(at) * scaled(vec3(size)));
}

// --- The building.

/// A square tile; one of four turns of its texture.
void add_tile(Mesh& mesh, vec3 low, vec2 size, uint32_t turn) {
  const vec3 corners[] = {low + vec3(0, 0, size.y), low + vec3(size.x, 0, size.y), low + vec3(size.x, 0, 0), low};
  const auto corner = [&](uint32_t i) { return corners[(turn + i) % 4]; };
  add_textured_quad(mesh, corner(0), corner(1), corner(2), corner(3));
}

/// Planks along x (or along z) that fill a strip.
void add_planks(Mesh& mesh, vec2 low, vec2 high, bool along_z, uint32_t seed) {
  const int axis = along_z ? 1 : 0;
  for (int row = 0; row < 5; ++row) {
    float at = low[axis] - 1.2f * hash01(seed, uint32_t(row));
    for (; at < high[axis]; at += 1.2f) {
      vec2 from = low, to = high;
      from[axis] = std::max(at, low[axis]), to[axis] = std::min(at + 1.2f, high[axis]);
      from[1 - axis] = glm::mix(low[1 - axis], high[1 - axis], float(row) / 5);
      to[1 - axis] = glm::mix(low[1 - axis], high[1 - axis], float(row + 1) / 5);
      if (to[axis] - from[axis] > 0.01f) add_tile(mesh, {from.x, 0, from.y}, to - from, along_z ? 1 : 0);
    }
  }
}

/// Tiles of three stones, each of its own polish, within a border of planks and a line of brass.
void add_floor(Scene& scene, const Materials& m) {
  const float tile = 0.75f, side = half_width - tile, near = front - tile, far = back + tile;
  Mesh stones[3], planks, inlay;
  for (int row = 0; row < 14; ++row) {
    for (int column = 0; column < 10; ++column) {
      const bool border = row == 0 || row == 13 || column == 0 || column == 9;
      const int kind = border ? 2 : (row + column) % 2;
      add_tile(stones[kind], {-side + tile * float(column), 0, far + tile * float(row)}, vec2(tile),
               uint32_t(4 * hash01(uint32_t(row), uint32_t(column), 1)));
    }
  }
  add_planks(planks, {-half_width, back}, {-side, front}, true, 1);
  add_planks(planks, {side, back}, {half_width, front}, true, 2);
  add_planks(planks, {-side, back}, {side, far}, false, 3);
  add_planks(planks, {-side, near}, {side, front}, false, 4);
  const auto lines = [&](float inset) {
    for (const float x : {-side + inset, side - inset})
      add_box(inlay, {x - 0.012f, -0.01f, far + inset}, {x + 0.012f, 0.0004f, near - inset});
    for (const float z : {far + inset, near - inset})
      add_box(inlay, {-side + inset, -0.01f, z - 0.012f}, {side - inset, 0.0004f, z + 0.012f});
  };
  lines(0), lines(tile);
  const int materials[] = {m.black_marble, m.brown_marble, m.red_marble};
  for (int i = 0; i < 3; ++i) place(scene, "floor tiles", materials[i], stones[i], mat4(1));
  place(scene, "parquet", m.parquet, planks, mat4(1));
  place(scene, "brass inlay", m.brass, inlay, mat4(1));
}

constexpr float window_low = 0.12f, window_high = 3.0f;

/// A window's frame: bars across, a wide sill and mouldings round it. Its lower left corner at (x, window_low).
void add_window_frame(Mesh& mesh, float x, float width) {
  const float high = window_high, low = window_low;
  for (int k = 0; k <= 3; ++k) {
    const float at = x + 0.03f + (width - 0.06f) * float(k) / 3;
    add_chamfered_box(mesh, {at - 0.03f, low, -0.2f}, {at + 0.03f, high, -0.14f}, 0.008f);
  }
  for (const float y : {low + 0.03f, 0.85f, 2.3f, high - 0.03f})
    add_chamfered_box(mesh, {x, y - 0.03f, -0.195f}, {x + width, y + 0.03f, -0.145f}, 0.008f);
  for (const float at : {x - 0.14f, x + width})
    add_chamfered_box(mesh, {at, 0, -0.01f}, {at + 0.14f, high, 0.04f}, 0.01f);
  add_chamfered_box(mesh, {x - 0.18f, high, -0.01f}, {x + width + 0.18f, high + 0.15f, 0.06f}, 0.015f);
  add_chamfered_box(mesh, {x - 0.18f, low - 0.03f, -0.3f}, {x + width + 0.18f, low + 0.01f, 0.07f}, 0.008f);
}

/// Half of a pair of curtains, held back at its outer side: x from 0 inwards.
Mesh curtain(float width, uint32_t seed) {
  Mesh mesh;
  const auto surface = [&](float u, float v) {
    const float y = 0.02f + 3.13f * v, tie = std::exp(-4 * (y - 1.1f) * (y - 1.1f)), hem = std::max(0.0f, 1 - y);
    const float wide = width * (1 - 0.62f * tie - 0.12f * hem), fold = 2 * pi * (7 * u + 0.6f * hash01(seed));
    const float deep = 0.045f * (1 - 0.5f * tie) + 0.015f * std::sin(3 * u + 2 * y + float(seed));
    return vec3(wide * u, y, 0.14f + deep * std::sin(fold) + 0.012f * std::sin(2.3f * fold + 3 * y));
  };
  add_surface(mesh, surface, 64, 14);
  return mesh;
}

/// A window's curtains with their rail; x is the middle of the window.
void add_curtains(Scene& scene, const Materials& m, const mat4& at, float x, float width, uint32_t seed) {
  const float half = 0.5f * width + 0.16f;
  place(scene, "curtain", m.curtain, curtain(0.5f, seed), at * moved({x - half, 0, 0}));
  place(scene, "curtain", m.curtain, curtain(0.5f, seed + 1), at * moved({x + half, 0, 0}) * scaled({-1, 1, 1}));
  Mesh rail;
  add_cylinder(rail, {x - half - 0.06f, 3.19f, 0.14f}, {x + half + 0.06f, 3.19f, 0.14f}, 0.018f, 0.018f, 16);
  for (const float side : {-1.0f, 1.0f}) {
    add_sphere(rail, {x + side * (half + 0.08f), 3.19f, 0.14f}, 0.038f, 16, 10);
    add_cylinder(rail, {x + side * half, 3.19f, 0}, {x + side * half, 3.19f, 0.14f}, 0.01f, 0.01f, 10);
    add_torus(rail, {x + side * (half - 0.11f), 1.1f, 0.14f}, {0, 1, 0}, 0.13f, 0.012f, 28, 8);
    for (int i = 0; i < 7; ++i)
      add_torus(rail, {x + side * (half - 0.04f - 0.08f * float(i)), 3.185f, 0.14f}, {1, 0, 0}, 0.027f, 0.005f, 12, 4);
  }
  place(scene, "curtain rail", m.brass, rail, at);
}

/// A wall with windows: `middles` along it, all of one width.
void add_window_wall(Scene& scene, const Materials& m, const mat4& at, float low, float high,
                     const std::vector<float>& middles, float width, uint32_t seed) {
  std::vector<Outline> holes;
  Mesh wall_mesh, frames;
  for (const float x : middles) {
    holes.push_back(rectangle({x - 0.5f * width, window_low}, {x + 0.5f * width, window_high}));
    add_window_frame(frames, x - 0.5f * width, width);
  }
  add_extrusion(wall_mesh, rectangle({low, -0.05f}, {high, height}), holes, -thick, 0);
  place(scene, "wall", m.plaster, wall_mesh, at);
  place(scene, "window frames", m.frame_paint, frames, at);
  for (size_t i = 0; i < middles.size(); ++i) add_curtains(scene, m, at, middles[i], width, seed + 2 * uint32_t(i));
}

/// Panels up to the height of a chair's back, with skirting and rail.
void add_wainscot(Scene& scene, const Materials& m, const mat4& at, float from, float to) {
  Mesh mesh;
  add_chamfered_box(mesh, {from, 0, -0.01f}, {to, 0.16f, 0.04f}, 0.01f);
  add_box(mesh, {from, 0.16f, -0.01f}, {to, 0.92f, 0.014f});
  add_chamfered_box(mesh, {from, 0.92f, -0.01f}, {to, 0.98f, 0.05f}, 0.012f);
  const int count = std::max(1, int(std::lround((to - from) / 0.6f)));
  const float step = (to - from) / float(count);
  for (int i = 0; i < count; ++i) {
    const float x = from + step * float(i);
    add_chamfered_box(mesh, {x + 0.07f, 0.24f, 0}, {x + step - 0.07f, 0.85f, 0.028f}, 0.012f);
    add_chamfered_box(mesh, {x + 0.13f, 0.3f, 0}, {x + step - 0.13f, 0.79f, 0.04f}, 0.014f);
  }
  place(scene, "wainscot", m.mahogany, mesh, at);
}

/// A lamp on the wall in front of a panel of silk that it lights.
void add_sconce_panel(Scene& scene, const Materials& m, const mat4& at, float x, float width) {
  Mesh silk, lamp, shade;
  add_textured_quad(silk, {x - 0.5f * width, 1.05f, 0.012f}, {x + 0.5f * width, 1.05f, 0.012f},
                    {x + 0.5f * width, 3.15f, 0.012f}, {x - 0.5f * width, 3.15f, 0.012f});
  place(scene, "silk panel", m.silk, silk, at);
  place(scene, "panel moulding", m.walnut, frame(width - 0.02f, 2.1f, 0.05f), at * moved({x, 1.05f, 0}));
  add_chamfered_box(lamp, {x - 0.04f, 2.1f, 0.01f}, {x + 0.04f, 2.4f, 0.03f}, 0.008f);
  add_tube(lamp, {{x, 2.2f, 0.02f}, {x, 2.17f, 0.08f}, {x, 2.19f, 0.13f}, {x, 2.26f, 0.15f}, {x, 2.33f, 0.15f}}, 0.011f,
           12);
  place(scene, "sconce", m.brass, lamp, at);
  add_turned(shade, {0, 0, 0}, {0, 0, 0.1f, 0, 0.1f, 0, 0.06f, 0.2f, 0.06f, 0.2f, 0, 0.2f}, 28);
  map_by_height(shade);
  place(scene, "sconce shade", m.shade, shade, at * moved({x, 2.31f, 0.15f}));
}

void add_picture(Scene& scene, const Materials& m, const mat4& at, vec2 size, size_t id) {
  Mesh canvas;
  add_textured_quad(canvas, {-0.5f * size.x, 0, 0.02f}, {0.5f * size.x, 0, 0.02f}, {0.5f * size.x, size.y, 0.02f},
                    {-0.5f * size.x, size.y, 0.02f});
  const int frames[] = {m.oak, m.black_lacquer, m.gilt, m.red_lacquer};
  place(scene, "picture frame", frames[id % 4], frame(size.x, size.y, 0.08f), at);
  place(scene, "picture", m.pictures[id % m.pictures.size()], canvas, at);
}

/// The wall behind the main camera: two leaves of a door between pictures.
void add_door_wall(Scene& scene, const Materials& m) {
  const mat4 at = on_wall({0, 0, front}, pi);
  Mesh wall_mesh, doors, handles;
  add_extrusion(wall_mesh, rectangle({-half_width, -0.05f}, {half_width, height}), -thick, 0);
  place(scene, "wall", m.plaster, wall_mesh, at);
  add_wainscot(scene, m, at, -half_width, -1.2f);
  add_wainscot(scene, m, at, 1.2f, half_width);
  add_chamfered_box(doors, {-1.2f, 2.5f, 0}, {1.2f, 2.75f, 0.08f}, 0.015f);
  for (const float side : {-1.0f, 1.0f}) {
    const auto part = [&](vec3 a, vec3 b, float chamfer) {
      const vec3 factor(side, 1, 1);
      add_chamfered_box(doors, glm::min(a * factor, b * factor), glm::max(a * factor, b * factor), chamfer);
    };
    part({1.0f, 0, 0}, {1.2f, 2.5f, 0.06f}, 0.012f);
    part({0.004f, 0, 0}, {0.995f, 2.5f, 0.03f}, 0.004f);
    for (const vec2 rows : {vec2(0.15f, 0.95f), vec2(1.15f, 2.35f)})
      part({0.15f, rows.x, 0.02f}, {0.85f, rows.y, 0.045f}, 0.01f);
    add_cylinder(handles, {side * 0.07f, 1.05f, 0.02f}, {side * 0.07f, 1.05f, 0.09f}, 0.012f, 0.012f, 16);
    add_sphere(handles, {side * 0.07f, 1.05f, 0.1f}, 0.032f, 24, 14);
  }
  place(scene, "doors", m.mahogany, doors, at);
  place(scene, "door knobs", m.brass, handles, at);
  for (const float x : {-2.0f, 2.0f}) add_sconce_panel(scene, m, at, x, 0.8f);
  add_picture(scene, m, at * moved({-3.4f, 1.4f, 0}), {1.1f, 0.9f}, 3);
  add_picture(scene, m, at * moved({3.4f, 1.4f, 0}), {1.1f, 0.9f}, 7);
}

void add_walls(Scene& scene, const Materials& m) {
  add_window_wall(scene, m, moved({0, 0, back}), -half_width - thick, half_width + thick, {-2.6f, 0, 2.6f}, 2.1f, 10);
  add_window_wall(scene, m, on_right_wall(back), 0, front - back, {1.9f, 4.5f, 7.1f}, 1.8f, 30);
  add_door_wall(scene, m);
  Mesh left;
  add_extrusion(left, rectangle({0, -0.05f}, {front - back, height}), -thick, 0);
  place(scene, "wall", m.plaster, left, on_left_wall(front));
  for (const vec2 part : {vec2(0, 2.1f), vec2(4.0f, 4.4f), vec2(7.0f, 8.3f), vec2(11.8f, 12.0f)})
    add_wainscot(scene, m, on_left_wall(front), part.x, part.y);
  for (const vec2 part : {vec2(0, 0.8f), vec2(3.0f, 3.4f), vec2(5.6f, 6.0f), vec2(8.2f, 12.0f)})
    add_wainscot(scene, m, on_right_wall(back), part.x, part.y);
  add_sconce_panel(scene, m, on_left_wall(front), 7.65f, 0.9f);
  add_sconce_panel(scene, m, on_left_wall(front), 1.1f, 1.2f);
  for (const float x : {8.75f, 11.45f}) add_sconce_panel(scene, m, on_right_wall(back), x, 0.8f);
}

/// Coffers between beams, each lit from its edges, with a lamp in the middle.
void add_ceiling(Scene& scene, const Materials& m) {
  Mesh beams, panels, collars, lamps;
  const auto beam = [&](vec3 low, vec3 high) { add_chamfered_box(beams, low, high, 0.02f); };
  for (int i = 0; i <= 3; ++i) {
    const float x = -half_width + 3 * float(i);
    beam({x - 0.16f, height - 0.26f, back}, {x + 0.16f, height, front});
  }
  for (int i = 0; i <= 4; ++i) {
    const float z = back + 3 * float(i);
    beam({-half_width, height - 0.26f, z - 0.16f}, {half_width, height, z + 0.16f});
  }
  for (int i = 0; i < 12; ++i) {
    const float x = -half_width + 3 * float(i % 3), z = back + 3 * float(i / 3), y = height - 0.01f;
    add_textured_quad(panels, {x, y, z}, {x + 3, y, z}, {x + 3, y, z + 3}, {x, y, z + 3});
    for (const float inset : {0.16f, 0.26f}) {
      const float low = height - (inset < 0.2f ? 0.16f : 0.07f), a = inset, b = 3 - inset;
      beam({x + a, low, z + a}, {x + a + 0.1f, height, z + b});
      beam({x + b - 0.1f, low, z + a}, {x + b, height, z + b});
      beam({x + a, low, z + a}, {x + b, height, z + a + 0.1f});
      beam({x + a, low, z + b - 0.1f}, {x + b, height, z + b});
    }
    for (const vec2 p : {vec2(0.7f, 0.7f), vec2(2.3f, 0.7f), vec2(0.7f, 2.3f), vec2(2.3f, 2.3f)}) {
      const vec3 at(x + p.x, height - 0.01f, z + p.y);
      add_torus(collars, at, {0, 1, 0}, 0.075f, 0.018f, 20, 6);
      add_cylinder(lamps, at, at - vec3(0, 0.012f, 0), 0.06f, 0.06f, 20);
    }
  }
  add_box(add_mesh(scene, "ceiling", m.ceiling), {-half_width - thick, height, back - thick},
          {half_width + thick, height + 0.3f, front + thick});
  place(scene, "ceiling beams", m.ceiling, beams, mat4(1));
  place(scene, "coffers", m.coffer, panels, mat4(1));
  place(scene, "ceiling lamp collars", m.brass, collars, mat4(1));
  place(scene, "ceiling lamps", m.lamp, lamps, mat4(1));
}

void add_columns(Scene& scene, const Materials& m) {
  for (const float x : {-1.3f, 1.3f}) {
    const vec3 at(x, 0, -6.6f);
    Mesh shaft = lathe({0.2f, 0.3f, 0.205f, 0.9f, 0.2f, 1.8f, 0.175f, 2.95f}, 64), metal, base;
    add_chamfered_box(base, {-0.29f, 0, -0.29f}, {0.29f, 0.16f, 0.29f}, 0.012f);
    add_torus(metal, {0, 0.205f, 0}, {0, 1, 0}, 0.225f, 0.045f, 48, 10);
    add_torus(metal, {0, 0.275f, 0}, {0, 1, 0}, 0.225f, 0.028f, 48, 10);
    add_turned(metal, {0, 0, 0},
               {0.17f, 2.9f, 0.2f, 2.92f, 0.2f, 2.97f, 0.18f, 3.0f, 0.2f, 3.15f, 0.28f, 3.25f, 0.28f, 3.3f}, 64);
    add_chamfered_box(base, {-0.3f, 3.28f, -0.3f}, {0.3f, height - 0.1f, 0.3f}, 0.012f);
    place(scene, "column", m.green_marble, shaft, moved(at));
    place(scene, "column rings", m.brass, metal, moved(at));
    place(scene, "column base", m.white_marble, base, moved(at));
  }
}

// --- Outside.

void add_balustrade(Scene& scene, const Materials& m) {
  Mesh slab, balusters;
  add_box(slab, {-14, -0.35f, -13}, {9, -0.06f, front + 1});
  const Mesh one = lathe({0.05f, 0, 0.05f, 0.05f, 0.03f, 0.1f, 0.065f, 0.28f, 0.035f, 0.55f, 0.05f, 0.7f}, 10);
  for (int i = 0; i < 64; ++i) {
    const bool far = i < 40;
    const vec3 at =
        far ? vec3(-13.5f + 0.55f * float(i), 0.04f, -12.5f) : vec3(8.5f, 0.04f, -12 + 0.55f * float(i - 40));
    append(balusters, one, moved(at));
  }
  for (const float y : {-0.06f, 0.72f}) {
    add_chamfered_box(slab, {-14, y, -12.62f}, {8.62f, y + 0.11f, -12.38f}, 0.02f);
    add_chamfered_box(slab, {8.38f, y, -12.4f}, {8.62f, y + 0.11f, front}, 0.02f);
  }
  place(scene, "terrace", m.terrace, slab, mat4(1));
  place(scene, "balusters", m.terrace, balusters, mat4(1));
}

/// Five sides of a block with lit windows.
Mesh tower(vec3 low, vec3 high) {
  Mesh mesh;
  const auto p = [&](int x, int y, int z) { return vec3(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z); };
  add_textured_quad(mesh, p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1));
  add_textured_quad(mesh, p(1, 0, 0), p(0, 0, 0), p(0, 1, 0), p(1, 1, 0));
  add_textured_quad(mesh, p(1, 0, 1), p(1, 0, 0), p(1, 1, 0), p(1, 1, 1));
  add_textured_quad(mesh, p(0, 0, 0), p(0, 0, 1), p(0, 1, 1), p(0, 1, 0));
  add_textured_quad(mesh, p(0, 1, 1), p(1, 1, 1), p(1, 1, 0), p(0, 1, 0));
  return mesh;
}

/// What the windows show: a city before a bright sky. Low enough that the sun looks in above it.
void add_city(Scene& scene, const Materials& m) {
  for (uint32_t i = 0; i < 34; ++i) {
    const bool far = i < 20;
    const float along = -70 + 7.5f * float(far ? i : i - 20) + 3 * hash01(i, 1), away = 45 + 30 * hash01(i, 2);
    const float wide = 4 + 4 * hash01(i, 3), tall = 1.5f + 7 * hash01(i, 4) * hash01(i, 5);
    const vec3 low = far ? vec3(along, -12, -away) : vec3(away, -12, along);
    place(scene, "tower", m.towers[i % 3], tower(low, {low.x + wide, tall, low.z + wide}), mat4(1));
  }
  Mesh sky;
  add_textured_quad(sky, {-130, -12, -95}, {95, -12, -95}, {95, 30, -95}, {-130, 30, -95});
  add_textured_quad(sky, {95, -12, -95}, {95, -12, 60}, {95, 25, 60}, {95, 25, -95});
  place(scene, "evening sky", m.dusk, sky, mat4(1));
}

// --- The left wall: shelves, the fireplace, the bar.

/// Books and things side by side on a board; `low` is the left end of its front edge, x along it.
void fill_board(std::vector<Mesh>& books, Mesh& things, vec3 low, float width, float room, uint32_t seed) {
  uint32_t i = 0;
  for (float x = 0; x < width - 0.06f; ++i) {
    const float chance = hash01(seed, i, 1);
    if (chance < 0.07f && x < width - 0.26f) {  // something else to look at
      const Mesh thing = pot(Pot(int(4 * hash01(seed, i, 2))), 16, 3);
      append(things, thing, moved(low + vec3(x + 0.13f, 0, -0.13f)) * scaled(vec3(0.14f + 0.08f * hash01(seed, i, 3))));
      x += 0.26f;
      continue;
    }
    const float thin = 0.018f + 0.03f * hash01(seed, i, 4), tall = room * (0.6f + 0.3f * hash01(seed, i, 5));
    const float deep = 0.14f + 0.05f * hash01(seed, i, 6), inset = 0.015f + 0.015f * hash01(seed, i, 7);
    // Volumes of one work stand together.
    Mesh& mesh = books[size_t(6 * hash01(seed, i / 4, 8))];
    add_chamfered_box(mesh, low + vec3(x, 0, -inset - deep), low + vec3(x + thin, tall, -inset), 0.0025f);
    x += thin + 0.0015f;
  }
}

void add_bookcase(Scene& scene, const Materials& m, const mat4& at, float width, uint32_t seed) {
  const float deep = 0.36f, tall = 2.9f, half = 0.5f * width;
  Mesh wood_mesh, things;
  std::vector<Mesh> books(6);
  add_box(wood_mesh, {-half, 0, 0}, {half, tall, 0.03f});
  for (const float x : {-half, -0.02f, half - 0.04f})
    add_chamfered_box(wood_mesh, {x, 0, 0}, {x + 0.04f, tall, deep}, 0.005f);
  add_chamfered_box(wood_mesh, {-half - 0.03f, 0, -0.01f}, {half + 0.03f, 0.12f, deep + 0.03f}, 0.012f);
  add_chamfered_box(wood_mesh, {-half - 0.04f, tall, -0.01f}, {half + 0.04f, tall + 0.07f, deep + 0.05f}, 0.015f);
  add_chamfered_box(wood_mesh, {-half - 0.08f, tall + 0.07f, -0.01f}, {half + 0.08f, tall + 0.12f, deep + 0.09f},
                    0.02f);
  const float rows[] = {0.12f, 0.62f, 1.0f, 1.36f, 1.72f, 2.08f, 2.5f, 2.86f};
  for (uint32_t row = 0; row + 1 < std::size(rows); ++row) {
    add_chamfered_box(wood_mesh, {-half + 0.02f, rows[row] - 0.03f, 0.01f}, {half - 0.02f, rows[row], deep - 0.01f},
                      0.004f);
    for (uint32_t side = 0; side < 2; ++side)
      fill_board(books, things, {side ? 0.025f : -half + 0.045f, rows[row], deep - 0.03f}, half - 0.07f,
                 rows[row + 1] - rows[row] - 0.03f, seed + 10 * row + side);
  }
  place(scene, "bookcase", m.walnut, wood_mesh, at);
  for (size_t i = 0; i < books.size(); ++i) {
    if (!books[i].triangles.empty()) place(scene, "books", m.books[i], books[i], at);
  }
  if (!things.triangles.empty()) place(scene, "things on shelves", seed % 2 ? m.celadon : m.porcelain, things, at);
}

/// A tongue of fire that leans; closed.
void add_flame(Mesh& mesh, vec3 foot, float wide, float tall, uint32_t seed) {
  const auto surface = [&](float u, float v) {
    const float angle = 2 * pi * (u < 1 ? u : 0), size = v <= 0 || v >= 1 ? 0 : std::sin(pi * std::pow(v, 0.55f));
    const vec3 lean(0.15f * std::sin(5 * v + 6 * hash01(seed)) * v, v, 0.08f * std::sin(4 * v + float(seed)) * v);
    return foot + tall * lean + wide * size * vec3(std::sin(angle), 0, 0.6f * std::cos(angle));
  };
  add_surface(mesh, surface, 12, 14);
}

void add_fire(Scene& scene, const Materials& m, const mat4& at) {
  Mesh soot, iron, logs, flames;
  add_box(soot, {-0.65f, 0, 0}, {0.65f, 1.0f, 0.03f});
  for (int i = 0; i < 9; ++i) {  // the grate
    const float x = -0.36f + 0.09f * float(i);
    add_tube(iron, {{x, 0.08f, 0.1f}, {x, 0.08f, 0.34f}, {x, 0.2f, 0.4f}}, 0.01f, 8);
  }
  add_cylinder(iron, {-0.42f, 0.08f, 0.2f}, {0.42f, 0.08f, 0.2f}, 0.012f, 0.012f, 10);
  for (uint32_t i = 0; i < 5; ++i) {
    const float y = 0.135f + 0.075f * float(i / 2), z = i < 4 ? 0.14f + 0.12f * float(i % 2) : 0.2f;
    const float turn = 0.06f * (hash01(i, 71) - 0.5f);
    add_cylinder(logs, {-0.34f + turn, y, z - turn}, {0.34f - turn, y + turn, z + turn}, 0.048f, 0.04f, 18);
  }
  for (uint32_t i = 0; i < 11; ++i) {
    const float x = -0.3f + 0.06f * float(i);
    add_flame(flames, {x, 0.17f, 0.13f + 0.12f * hash01(i, 72)}, 0.055f, 0.28f + 0.3f * hash01(i, 73), i);
  }
  map_by_height(flames);
  place(scene, "firebox", m.soot, soot, at);
  place(scene, "grate", m.ebony, iron, at);
  place(scene, "logs", m.bark, logs, at);
  place(scene, "flames", m.flame, flames, at);
}

/// The chimney breast, its mantelpiece, a fender and a fire; the middle of its back at the origin, z into the room.
void add_fireplace(Scene& scene, const Materials& m, const mat4& at) {
  Mesh breast, lining, stones, fender;
  add_extrusion(breast, wall({-1.3f, -0.05f}, {1.3f, height}, {rectangle({-0.6f, -0.05f}, {0.6f, 0.92f})}), 0, 0.42f);
  for (const float side : {-1.0f, 1.0f}) {
    add_box(lining, {side < 0 ? -0.61f : 0.57f, 0, 0}, {side < 0 ? -0.57f : 0.61f, 0.93f, 0.43f});
    const float x = side * 0.78f;
    add_chamfered_box(stones, {x - 0.16f, 0, 0.41f}, {x + 0.16f, 0.14f, 0.54f}, 0.012f);
    add_chamfered_box(stones, {x - 0.13f, 0.14f, 0.41f}, {x + 0.13f, 1.0f, 0.5f}, 0.012f);
    for (const float groove : {-0.07f, 0.0f, 0.07f})
      add_cylinder(stones, {x + groove, 0.17f, 0.5f}, {x + groove, 0.95f, 0.5f}, 0.024f, 0.024f, 20);
    add_chamfered_box(stones, {x - 0.15f, 0.98f, 0.41f}, {x + 0.15f, 1.2f, 0.53f}, 0.014f);
    add_torus(stones, {x, 1.09f, 0.53f}, {0, 0, 1}, 0.06f, 0.02f, 32, 12);
  }
  add_box(lining, {-0.61f, 0.89f, 0}, {0.61f, 0.93f, 0.43f});
  add_box(lining, {-0.6f, 0, 0}, {0.6f, 0.02f, 0.43f});
  add_chamfered_box(stones, {-0.65f, 0.92f, 0.41f}, {0.65f, 1.18f, 0.48f}, 0.012f);
  add_chamfered_box(stones, {-1.0f, 1.2f, 0.4f}, {1.0f, 1.24f, 0.6f}, 0.012f);
  add_chamfered_box(stones, {-1.06f, 1.24f, 0.4f}, {1.06f, 1.29f, 0.66f}, 0.014f);
  add_chamfered_box(lining, {-1.1f, -0.01f, 0.42f}, {1.1f, 0.035f, 0.98f}, 0.01f);
  for (const float y : {0.09f, 0.24f})
    add_tube(fender,
             {{-0.95f, y, 0.56f},
              {-0.95f, y, 0.88f},
              {-0.9f, y, 0.93f},
              {0.9f, y, 0.93f},
              {0.95f, y, 0.88f},
              {0.95f, y, 0.56f}},
             0.014f, 12);
  for (int i = 0; i <= 30; ++i) {
    const float x = -0.9f + 0.06f * float(i);
    add_cylinder(fender, {x, 0.035f, 0.93f}, {x, 0.24f, 0.93f}, 0.006f, 0.006f, 8);
  }
  for (const float x : {-0.93f, 0.93f}) add_sphere(fender, {x, 0.29f, 0.91f}, 0.045f, 28, 16);
  place(scene, "chimney breast", m.plaster, breast, at);
  place(scene, "fire lining", m.granite, lining, at);
  place(scene, "mantelpiece", m.white_marble, stones, at);
  place(scene, "fender", m.brass, fender, at);
  add_fire(scene, m, at);
}

Mesh candlestick() {
  return turned_shape({0.07f, 0, 0.065f, 0.015f, 0.02f, 0.04f, 0.012f, 0.08f, 0.028f, 0.11f, 0.012f, 0.15f, 0.014f,
                       0.24f, 0.04f, 0.27f, 0.02f, 0.28f},
                      18, 3);
}

/// A mirror over the mantelpiece, with a clock, candles and vases before it.
void add_mantel_things(Scene& scene, const Materials& m, const mat4& at) {
  const float top = 1.29f;
  Mesh mirror, sticks, candles, flames, clock, face;
  add_quad(mirror, {-0.75f, 1.5f, 0.44f}, {0.75f, 1.5f, 0.44f}, {0.75f, 2.85f, 0.44f}, {-0.75f, 2.85f, 0.44f});
  place(scene, "mirror", m.mirror, mirror, at);
  place(scene, "mirror frame", m.black_lacquer, frame(1.5f, 1.35f, 0.13f), at * moved({0, 1.5f, 0.42f}));
  for (const float x : {-0.62f, -0.48f, 0.48f, 0.62f}) {
    const vec3 foot(x, top, 0.54f);
    append(sticks, candlestick(), moved(foot));
    add_cylinder(candles, foot + vec3(0, 0.27f, 0), foot + vec3(0, 0.45f, 0), 0.012f, 0.011f, 14);
    add_flame(flames, foot + vec3(0, 0.45f, 0), 0.011f, 0.05f, 3);
  }
  map_by_height(flames);
  place(scene, "candlesticks", m.silver, sticks, at);
  place(scene, "candles", m.wax, candles, at);
  place(scene, "candle flames", m.lamp, flames, at);
  add_chamfered_box(clock, {-0.15f, top, 0.46f}, {0.15f, top + 0.05f, 0.62f}, 0.008f);
  add_extrusion(clock, arch({-0.12f, top + 0.05f}, 0.24f, top + 0.22f, 24), 0.48f, 0.6f);
  place(scene, "clock", m.green_lacquer, clock, at);
  add_cylinder(face, {0, top + 0.2f, 0.59f}, {0, top + 0.2f, 0.606f}, 0.085f, 0.085f, 40);
  place(scene, "clock face", m.ivory, face, at);
  Mesh hands;
  add_torus(hands, {0, top + 0.2f, 0.605f}, {0, 0, 1}, 0.09f, 0.009f, 48, 10);
  add_box(hands, {-0.004f, top + 0.19f, 0.606f}, {0.004f, top + 0.27f, 0.61f});
  add_box(hands, {-0.005f, top + 0.195f, 0.606f}, {0.055f, top + 0.205f, 0.61f});
  place(scene, "clock ring and hands", m.brass, hands, at);
  for (const float x : {-0.88f, 0.88f})
    place(scene, "vase", m.cobalt, pot(Pot::jar), at * moved({x, top, 0.54f}) * scaled({0.26f, 0.34f, 0.26f}));
}

Mesh bottle(uint32_t kind) {
  if (kind == 0)  // slender
    return lathe({0, 0, 0.037f, 0, 0.037f, 0, 0.037f, 0.19f, 0.014f, 0.26f, 0.013f, 0.32f, 0, 0.32f}, 16);
  if (kind == 1)  // broad
    return lathe({0, 0, 0.05f, 0, 0.05f, 0, 0.05f, 0.16f, 0.04f, 0.19f, 0.016f, 0.21f, 0.014f, 0.27f, 0, 0.27f}, 16);
  return lathe({0, 0, 0.03f, 0, 0.03f, 0, 0.045f, 0.1f, 0.03f, 0.18f, 0.013f, 0.24f, 0.016f, 0.3f, 0, 0.3f}, 16);
}

/// Bottles on the boards behind the bar, by kind and glaze in groups.
void add_bottles(Scene& scene, const Materials& m, const mat4& at) {
  std::vector<Mesh> bottles(6);
  for (uint32_t board = 0; board < 3; ++board) {
    for (uint32_t i = 0; i < 25; ++i) {
      if (hash01(board, i, 80) < 0.12f) continue;
      const uint32_t group = uint32_t(6 * hash01(board, i / 3, 81));
      const vec3 p(-1.45f + 0.12f * float(i), 1.03f + 0.5f * float(board), 0.14f + 0.06f * hash01(board, i, 82));
      append(bottles[group], bottle(group % 3), moved(p) * scaled(vec3(0.95f + 0.15f * hash01(board, i, 83))));
    }
  }
  for (size_t i = 0; i < bottles.size(); ++i) {
    if (!bottles[i].triangles.empty()) place(scene, "bottles", m.bottles[i], bottles[i], at);
  }
}

void add_back_bar(Scene& scene, const Materials& m, const mat4& at) {
  Mesh cabinet, glow, posts, boards;
  add_chamfered_box(cabinet, {-1.6f, 0, 0}, {1.6f, 0.94f, 0.42f}, 0.01f);
  for (int i = 0; i < 5; ++i) {
    const float x = -1.55f + 0.63f * float(i);
    add_chamfered_box(cabinet, {x, 0.1f, 0.41f}, {x + 0.58f, 0.88f, 0.44f}, 0.012f);
    add_sphere(posts, {x + 0.52f, 0.55f, 0.455f}, 0.016f, 16, 10);
  }
  for (const float x : {-1.6f, 1.52f}) add_chamfered_box(cabinet, {x, 0.94f, 0}, {x + 0.08f, 2.7f, 0.3f}, 0.008f);
  add_chamfered_box(cabinet, {-1.66f, 2.7f, -0.01f}, {1.66f, 2.86f, 0.36f}, 0.02f);
  add_textured_quad(glow, {-1.52f, 0.98f, 0.02f}, {1.52f, 0.98f, 0.02f}, {1.52f, 2.7f, 0.02f}, {-1.52f, 2.7f, 0.02f});
  for (const float y : {1.03f, 1.53f, 2.03f, 2.45f})
    add_chamfered_box(boards, {-1.52f, y - 0.03f, 0.04f}, {1.52f, y, 0.28f}, 0.004f);
  for (const float x : {-0.5f, 0.5f}) add_cylinder(posts, {x, 0.98f, 0.27f}, {x, 2.7f, 0.27f}, 0.012f, 0.012f, 14);
  add_chamfered_box(boards, {-1.62f, 0.94f, 0}, {1.62f, 0.98f, 0.45f}, 0.008f);
  place(scene, "back bar", m.mahogany, cabinet, at);
  place(scene, "bar glow", m.glow, glow, at);
  place(scene, "bar posts", m.brass, posts, at);
  place(scene, "bar boards", m.granite, boards, at);
  add_bottles(scene, m, at);
}

void add_counter(Scene& scene, const Materials& m, const mat4& at) {
  Mesh body, panels, top, rail;
  add_chamfered_box(body, {-1.6f, 0, 1.2f}, {1.6f, 1.06f, 1.62f}, 0.01f);
  for (int i = 0; i < 5; ++i) {
    const float x = -1.56f + 0.63f * float(i);
    add_chamfered_box(panels, {x, 0.14f, 1.61f}, {x + 0.6f, 1.0f, 1.65f}, 0.016f);
    for (int k = 0; k < 5; ++k)  // reeding
      add_cylinder(panels, {x + 0.1f + 0.1f * float(k), 0.22f, 1.645f}, {x + 0.1f + 0.1f * float(k), 0.92f, 1.645f},
                   0.03f, 0.03f, 18);
  }
  add_chamfered_box(panels, {1.59f, 0.14f, 1.26f}, {1.63f, 1.0f, 1.58f}, 0.016f);
  add_chamfered_box(top, {-1.7f, 1.06f, 1.1f}, {1.7f, 1.11f, 1.82f}, 0.012f);
  add_cylinder(rail, {-1.6f, 0.2f, 1.84f}, {1.6f, 0.2f, 1.84f}, 0.025f, 0.025f, 24);
  for (const float x : {-1.5f, -0.5f, 0.5f, 1.5f}) {
    add_tube(rail, {{x, 0.2f, 1.84f}, {x, 0.16f, 1.76f}, {x, 0.12f, 1.62f}}, 0.014f, 12);
    add_sphere(rail, {x, 0.2f, 1.84f}, 0.036f, 24, 14);
  }
  place(scene, "counter", m.black_lacquer, body, at);
  place(scene, "counter panels", m.red_lacquer, panels, at);
  place(scene, "counter top", m.granite, top, at);
  place(scene, "foot rail", m.brass, rail, at);
}

void add_stool(Scene& scene, const Materials& m, const mat4& at) {
  Mesh stem = turned_shape({0.21f, 0, 0.205f, 0.012f, 0.06f, 0.03f, 0.026f, 0.06f, 0.026f, 0.45f, 0.032f, 0.7f}, 28, 4);
  add_torus(stem, {0, 0.3f, 0}, {0, 1, 0}, 0.16f, 0.012f, 40, 10);
  for (const float turn : {0.0f, pi / 2})
    add_cylinder(stem, {0.16f * std::cos(turn), 0.3f, 0.16f * std::sin(turn)},
                 {-0.16f * std::cos(turn), 0.3f, -0.16f * std::sin(turn)}, 0.008f, 0.008f, 10);
  Mesh seat;
  add_pillow(seat, {0, 0.745f, 0}, {0.19f, 0.055f, 0.19f}, 0.75f);
  place(scene, "stool", m.chrome, stem, at);
  place(scene, "stool seat", m.green_leather, seat, at);
}

void add_bar_things(Scene& scene, const Materials& m, const mat4& at) {
  const float top = 1.11f;
  Mesh goblets, lemons, shakers;
  const Mesh goblet = turned_shape({0.035f, 0, 0.03f, 0.008f, 0.006f, 0.02f, 0.006f, 0.08f, 0.036f, 0.12f, 0.04f, 0.17f,
                                    0.036f, 0.17f, 0.02f, 0.13f},
                                   16, 3);
  for (uint32_t i = 0; i < 9; ++i)
    append(goblets, goblet, moved({-1.3f + 0.1f * float(i % 5), top, 1.3f + 0.1f * float(i / 5)}));
  for (uint32_t i = 0; i < 7; ++i) {
    const float angle = pi / 3 * float(i);
    add_pillow(lemons,
               {0.9f + (i < 6 ? 0.055f * std::cos(angle) : 0), top + (i < 6 ? 0.08f : 0.12f),
                1.5f + (i < 6 ? 0.055f * std::sin(angle) : 0)},
               {0.034f, 0.028f, 0.028f}, 0.9f, 20, 12);
  }
  const Mesh shaker =
      turned_shape({0.035f, 0, 0.045f, 0.14f, 0.043f, 0.16f, 0.025f, 0.2f, 0.024f, 0.23f, 0.015f, 0.245f}, 28, 4);
  for (const float x : {0.1f, 0.25f}) append(shakers, shaker, moved({x, top, 1.4f}));
  place(scene, "goblets", m.silver, goblets, at);
  place(scene, "lemons", m.lemon, lemons, at);
  place(scene, "shakers", m.chrome, shakers, at);
  place(scene, "fruit bowl", m.cobalt, pot(Pot::bowl), at * moved({0.9f, top, 1.5f}) * scaled({0.28f, 0.2f, 0.28f}));
}

/// A lamp on a cord above the counter.
void add_pendant(Scene& scene, const Materials& m, const mat4& at, float x, float z) {
  Mesh shade, lamp;
  add_turned(shade, {x, 2.05f, z}, {0.15f, 0, 0.155f, 0.01f, 0.12f, 0.12f, 0.04f, 0.2f, 0.03f, 0.26f, 0, 0.27f}, 40);
  add_cylinder(shade, {x, 2.3f, z}, {x, height, z}, 0.005f, 0.005f, 8);
  add_turned(lamp, {x, 2.05f, z}, {0, -0.035f, 0.06f, -0.028f, 0.11f, -0.01f, 0.15f, 0, 0.15f, 0, 0, 0.001f}, 40);
  place(scene, "pendant shade", m.copper, shade, at);
  place(scene, "pendant lamp", m.lamp, lamp, at);
}

/// The bar along the left wall; the middle of its back at the origin, z into the room.
void add_bar(Scene& scene, const Materials& m, const mat4& at) {
  add_back_bar(scene, m, at);
  add_counter(scene, m, at);
  add_bar_things(scene, m, at);
  for (int i = 0; i < 4; ++i) {
    add_stool(scene, m, at * moved({-1.2f + 0.8f * float(i), 0, 2.25f}));
    add_pendant(scene, m, at, -1.2f + 0.8f * float(i), 1.46f);
  }
}

// --- Furniture. Each stands at the origin and faces +z.

void add_legs(Mesh& mesh, float x, float z, float tall, float radius = 0.026f) {
  for (const float sx : {-1.0f, 1.0f}) {
    for (const float sz : {-1.0f, 1.0f})
      add_cylinder(mesh, {sx * x, 0, sz * z}, {sx * (x - 0.02f), tall, sz * (z - 0.02f)}, 0.6f * radius, radius, 16);
  }
}

/// A round-backed chair.
void add_tub_chair(Scene& scene, const Materials& m, const mat4& at, int cover) {
  Mesh legs, body;
  add_legs(legs, 0.27f, 0.26f, 0.2f);
  add_chamfered_box(legs, {-0.3f, 0.17f, -0.3f}, {0.3f, 0.21f, 0.3f}, 0.012f);
  add_pillow(body, {0, 0.3f, 0.01f}, {0.33f, 0.1f, 0.33f}, 0.3f);
  add_pillow(body, {0, 0.42f, 0.05f}, {0.27f, 0.07f, 0.29f}, 0.4f);
  const auto path = [](float t) {
    const float angle = (t - 0.5f) * 1.25f * pi, back_rise = 0.5f + 0.5f * std::cos(angle);
    return vec3(0.34f * std::sin(angle), 0.45f + 0.1f * back_rise, -0.32f * std::cos(angle) - 0.03f);
  };
  add_band(body, path, {0.055f, 0.24f}, 20, 36);
  place(scene, "tub chair legs", m.ebony, legs, at);
  place(scene, "tub chair", cover, body, at);
}

void add_sofa(Scene& scene, const Materials& m, const mat4& at, int cover) {
  Mesh legs, body, cushions;
  add_legs(legs, 0.98f, 0.36f, 0.13f, 0.035f);
  add_chamfered_box(body, {-1.05f, 0.12f, -0.42f}, {1.05f, 0.3f, 0.4f}, 0.02f);
  add_tufted(body, {-0.92f, 0.3f, -0.42f}, {0.92f, 0.78f, -0.24f}, 9, 3);
  add_cylinder(body, {-1.05f, 0.78f, -0.34f}, {1.05f, 0.78f, -0.34f}, 0.1f, 0.1f, 32);
  for (const float side : {-1.0f, 1.0f}) {
    add_chamfered_box(body, {side * 0.98f - 0.08f, 0.28f, -0.42f}, {side * 0.98f + 0.08f, 0.6f, 0.38f}, 0.02f);
    add_cylinder(body, {side * 0.99f, 0.62f, -0.42f}, {side * 0.99f, 0.62f, 0.4f}, 0.11f, 0.11f, 32);
  }
  for (int i = 0; i < 3; ++i)
    add_pillow(cushions, {-0.6f + 0.6f * float(i), 0.37f, 0.09f}, {0.298f, 0.09f, 0.32f}, 0.28f);
  place(scene, "sofa legs", m.ebony, legs, at);
  place(scene, "sofa", cover, body, at);
  place(scene, "sofa seat", cover, cushions, at);
  Mesh loose, other;
  add_pillow(loose, vec3(0), {0.21f, 0.2f, 0.07f}, 0.55f);
  place(scene, "cushion", m.silk, loose,
        at * moved({-0.68f, 0.62f, -0.03f}) * turned(-0.3f, {1, 0, 0}) * turned_y(0.25f));
  place(scene, "cushion", m.blue_velvet, loose,
        at * moved({0.7f, 0.62f, -0.03f}) * turned(-0.3f, {1, 0, 0}) * turned_y(-0.3f));
}

/// A low table with a mirror for its top and brass for its legs.
void add_mirror_table(Scene& scene, const Materials& m, const mat4& at, vec2 half) {
  Mesh brass, top, shelf;
  add_box(shelf, {-half.x, 0.1f, -half.y}, {half.x, 0.112f, half.y});
  for (const float x : {-half.x, half.x}) {
    for (const float z : {-half.y, half.y}) {
      add_chamfered_box(brass, {x - 0.018f, 0, z - 0.018f}, {x + 0.018f, 0.4f, z + 0.018f}, 0.004f);
    }
  }
  for (const float y : {0.1f, 0.385f}) {
    for (const float x : {-half.x, half.x})
      add_chamfered_box(brass, {x - 0.016f, y - 0.014f, -half.y}, {x + 0.016f, y + 0.014f, half.y}, 0.003f);
    for (const float z : {-half.y, half.y})
      add_chamfered_box(brass, {-half.x, y - 0.014f, z - 0.016f}, {half.x, y + 0.014f, z + 0.016f}, 0.003f);
  }
  add_chamfered_box(top, {-half.x + 0.01f, 0.385f, -half.y + 0.01f}, {half.x - 0.01f, 0.404f, half.y - 0.01f}, 0.003f);
  place(scene, "table frame", m.brass, brass, at);
  place(scene, "mirror table top", m.mirror, top, at);
  place(scene, "lower shelf", m.black_lacquer, shelf, at);
}

void add_round_table(Scene& scene, const Materials& m, const mat4& at, int material, float radius, float tall) {
  const Mesh mesh = lathe(
      {0,    0,     0.6f, 0,     0.6f,  0,     0.57f, 0.03f, 0.25f, 0.08f, 0.1f,  0.25f, 0.1f,  0.5f, 0.17f, 0.85f,
       0.5f, 0.94f, 0.5f, 0.94f, 0.96f, 0.94f, 1.0f,  0.96f, 1.0f,  0.98f, 0.98f, 1.0f,  0.98f, 1.0f, 0,     1.0f},
      64);
  place(scene, "round table", material, mesh, at * scaled({radius, tall, radius}));
  add_torus(add_mesh(scene, "table rim", m.brass), vec3(at * glm::vec4(0, 0.97f * tall, 0, 1)), {0, 1, 0}, radius,
            0.007f, 96, 8);
}

void add_floor_lamp(Scene& scene, const Materials& m, const mat4& at, int metal) {
  Mesh stem = turned_shape({0.16f, 0, 0.155f, 0.015f, 0.05f, 0.035f, 0.014f, 0.06f, 0.012f, 0.7f, 0.025f, 0.75f, 0.012f,
                            0.8f, 0.012f, 1.45f},
                           32, 5);
  Mesh shade = lathe({0, 0, 0.25f, 0, 0.25f, 0, 0.17f, 0.28f, 0.17f, 0.28f, 0, 0.28f}, 48), rims;
  map_by_height(shade);
  add_torus(rims, {0, 1.4f, 0}, {0, 1, 0}, 0.25f, 0.006f, 64, 8);
  add_torus(rims, {0, 1.68f, 0}, {0, 1, 0}, 0.17f, 0.005f, 64, 8);
  append(stem, rims, mat4(1));
  place(scene, "floor lamp", metal, stem, at);
  place(scene, "lampshade", m.shade, shade, at * moved({0, 1.4f, 0}));
}

void add_table_lamp(Scene& scene, const Materials& m, const mat4& at, int glaze) {
  place(scene, "lamp foot", glaze, pot(Pot::flask), at * scaled(vec3(0.34f)));
  Mesh shade = lathe({0, 0, 0.19f, 0, 0.19f, 0, 0.12f, 0.21f, 0.12f, 0.21f, 0, 0.21f}, 44);
  map_by_height(shade);
  place(scene, "lampshade", m.shade, shade, at * moved({0, 0.34f, 0}));
}

/// A heap of three books, each turned.
void add_book_heap(Scene& scene, const Materials& m, const mat4& at, uint32_t seed) {
  float y = 0;
  for (uint32_t i = 0; i < 3; ++i) {
    Mesh cover, pages;
    const float thick_book = 0.02f + 0.02f * hash01(seed, i, 60), half = 0.13f - 0.015f * float(i);
    for (const float low : {0.0f, thick_book - 0.004f})
      add_chamfered_box(cover, {-half, low, -0.75f * half}, {half, low + 0.004f, 0.75f * half}, 0.001f);
    add_box(cover, {-half, 0, -0.75f * half}, {-half + 0.005f, thick_book, 0.75f * half});
    add_box(pages, {-half + 0.004f, 0.003f, -0.72f * half}, {half - 0.005f, thick_book - 0.003f, 0.72f * half});
    const mat4 turn = at * moved({0, y, 0}) * turned_y(0.8f * (hash01(seed, i, 61) - 0.5f));
    place(scene, "book", m.books[size_t(6 * hash01(seed, i, 62))], cover, turn);
    place(scene, "pages", m.paper, pages, turn);
    y += thick_book;
  }
}

/// Cups and a pot on a silver tray.
void add_tea_set(Scene& scene, const Materials& m, const mat4& at) {
  Mesh tray = lathe({0, 0, 0.2f, 0, 0.2f, 0, 0.22f, 0.014f, 0.215f, 0.016f, 0.195f, 0.006f, 0, 0.006f}, 56);
  const Mesh teapot = turned_shape(
      {0.045f, 0, 0.08f, 0.05f, 0.07f, 0.1f, 0.03f, 0.125f, 0.012f, 0.135f, 0.014f, 0.15f, 0.006f, 0.155f}, 36, 5);
  Mesh china;
  append(china, teapot, moved({-0.05f, 0.006f, -0.04f}));
  add_tube(china, {{0.02f, 0.05f, -0.04f}, {0.06f, 0.07f, -0.04f}, {0.075f, 0.11f, -0.04f}}, 0.01f, 12);
  add_torus(china, {-0.13f, 0.075f, -0.04f}, {0, 0, 1}, 0.032f, 0.007f, 28, 10);
  const Mesh cup = turned_shape({0.02f, 0, 0.03f, 0.02f, 0.042f, 0.05f, 0.04f, 0.05f, 0.02f, 0.015f}, 28, 4);
  for (const vec2 p : {vec2(0.11f, 0.02f), vec2(0.02f, 0.12f), vec2(-0.1f, 0.1f)}) {
    add_turned(china, {p.x, 0.006f, p.y}, {0, 0, 0.035f, 0, 0.06f, 0.008f, 0.058f, 0.011f, 0, 0.004f}, 32);
    append(china, cup, moved({p.x, 0.012f, p.y}));
  }
  place(scene, "tray", m.silver, tray, at);
  place(scene, "tea set", m.porcelain, china, at);
}

Mesh chess_piece(int kind) {
  const float tall = 0.045f + 0.008f * float(kind), r = 0.0145f + 0.0008f * float(kind);
  Mesh mesh = turned_shape({r, 0, r, 0.006f, 0.6f * r, 0.012f, 0.42f * r, 0.6f * tall, 0.8f * r, 0.68f * tall,
                            0.45f * r, 0.72f * tall, 0.62f * r, 0.9f * tall, 0.1f * r, tall},
                           14, 2);
  if (kind > 2) add_sphere(mesh, {0, tall, 0}, 0.3f * r, 10, 6);
  return mesh;
}

void add_chess(Scene& scene, const Materials& m, const mat4& at) {
  Mesh board, squares[2], men[2];
  add_chamfered_box(board, {-0.24f, 0, -0.24f}, {0.24f, 0.022f, 0.24f}, 0.005f);
  for (int i = 0; i < 64; ++i) {
    const vec3 low(-0.2f + 0.05f * float(i % 8), 0.015f, -0.2f + 0.05f * float(i / 8));
    add_box(squares[(i + i / 8) % 2], low, low + vec3(0.0498f, 0.0075f, 0.0498f));
  }
  const int back_rank[] = {3, 1, 2, 5, 4, 2, 1, 3};
  for (int side = 0; side < 2; ++side) {
    for (int i = 0; i < 16; ++i) {
      const int file = i % 8, rank = i < 8 ? 0 : 1 + int(2.3f * hash01(uint32_t(i), uint32_t(side), 5));
      const float z = -0.175f + 0.05f * float(rank);
      append(men[side], chess_piece(i < 8 ? back_rank[file] : 0),
             moved({-0.175f + 0.05f * float(file), 0.0225f, side ? -z : z}));
    }
  }
  place(scene, "chess board", m.walnut, board, at);
  const int materials[] = {m.ivory, m.ebony};
  for (int i = 0; i < 2; ++i) {
    place(scene, "chess squares", materials[i], squares[i], at);
    place(scene, "chessmen", materials[1 - i], men[i], at);
  }
}

/// A screen of lacquered leaves that stand in a zigzag.
void add_folding_screen(Scene& scene, const Materials& m, const mat4& at) {
  float x = 0, z = 0;
  for (int i = 0; i < 4; ++i) {
    const float turn = i % 2 ? 0.55f : -0.55f, wide = 0.5f;
    const mat4 leaf = at * moved({x, 0, z}) * turned_y(turn);
    Mesh board, rim;
    add_chamfered_box(board, {0, 0.06f, -0.012f}, {wide, 1.9f, 0.012f}, 0.003f);
    for (const float at_x : {0.0f, wide - 0.03f})
      add_chamfered_box(rim, {at_x, 0, -0.017f}, {at_x + 0.03f, 1.93f, 0.017f}, 0.004f);
    for (const float y : {0.06f, 1.2f, 1.9f})
      add_chamfered_box(rim, {0, y, -0.016f}, {wide, y + 0.03f, 0.016f}, 0.004f);
    place(scene, "screen", i % 2 ? m.green_lacquer : m.red_lacquer, board, leaf);
    place(scene, "screen rim", m.black_lacquer, rim, leaf);
    Mesh ring;
    add_torus(ring, {0, 0, 0}, {0, 0, 1}, 0.13f, 0.012f, 48, 10);
    append(ring, lathe({0, -0.06f, 0.06f, 0, 0, 0.06f}, 6), turned(pi / 2, {1, 0, 0}) * scaled({1, 0.2f, 1}));
    place(scene, "screen ring", m.gilt, ring, leaf * moved({0.5f * wide, 1.55f, 0.008f}));
    x += wide * std::cos(turn), z -= wide * std::sin(turn);
  }
}

// --- The piano. Drawn as seen from above: x to the right of the player, y from the keys to the tail.

constexpr float case_low = 0.64f, case_high = 0.99f;

/// The bent side from the treble end of the keys round the tail to the spine, moved away from the middle by a factor.
std::vector<vec2> bent_side(float factor) {
  const std::vector<vec2> guides = {{1.5f, 0.6f},   {1.48f, 0.9f},  {1.3f, 1.2f},  {1.08f, 1.45f}, {0.98f, 1.7f},
                                    {0.88f, 1.95f}, {0.62f, 2.12f}, {0.3f, 2.14f}, {0.08f, 2.04f}, {0, 1.8f}};
  std::vector<vec2> points = smooth(guides, 6);
  for (vec2& p : points) p = vec2(0.65f, 1.0f) + factor * (p - vec2(0.65f, 1.0f));
  return points;
}

Outline piano_outline(float factor, float from) {
  const std::vector<vec2> side = bent_side(factor);
  Outline outline = {{side.back().x, from}, {side.front().x, from}};
  outline.insert(outline.end(), side.begin(), side.end());
  return outline;
}

void add_piano_keys(Scene& scene, const Materials& m, const mat4& at) {
  Mesh white, black;
  const float step = 1.3f / 52;
  for (int i = 0; i < 52; ++i) {
    const float x = 0.1f + step * float(i);
    add_chamfered_box(white, {x + 0.0005f, 0.69f, 0.02f}, {x + step - 0.0005f, 0.712f, 0.17f}, 0.0015f);
    const int note = (i + 5) % 7;  // the lowest key is an A; no black key after B and E
    if (note == 6 || note == 2 || i == 51) continue;
    add_chamfered_box(black, {x + step - 0.006f, 0.7f, 0.02f}, {x + step + 0.006f, 0.724f, 0.115f}, 0.002f);
  }
  place(scene, "white keys", m.ivory, white, at);
  place(scene, "black keys", m.ebony, black, at);
}

void add_piano_case(Scene& scene, const Materials& m, const mat4& at) {
  Mesh rim, lid, metal;
  add_extrusion(rim, piano_outline(1, 0), {piano_outline(0.93f, 0.42f)}, case_low, case_high);
  add_extrusion(rim, piano_outline(0.99f, 0), case_low - 0.02f, case_low);
  Mesh body;
  append(body, rim, laid_down());
  add_chamfered_box(body, {0, 0.62f, -0.02f}, {1.5f, 0.69f, 0.22f}, 0.008f);  // key bed
  for (const float x : {0.0f, 1.4f}) add_chamfered_box(body, {x, 0.66f, -0.02f}, {x + 0.1f, 0.9f, 0.2f}, 0.02f);
  add_box(body, {0.1f, 0.7f, -0.01f}, {1.4f, 0.9f, 0.02f});
  add_chamfered_box(body, {0, case_high, -0.42f}, {1.5f, case_high + 0.02f, 0.02f}, 0.004f);
  for (const vec2 foot : {vec2(0.14f, -0.12f), vec2(1.36f, -0.12f), vec2(0.45f, -1.8f)}) {
    add_turned(body, {foot.x, 0.06f, foot.y},
               {0, 0, 0.03f, 0, 0.04f, 0.05f, 0.035f, 0.1f, 0.06f, 0.3f, 0.075f, 0.45f, 0.05f, 0.47f, 0.08f, 0.5f,
                0.08f, 0.58f},
               32);
    add_sphere(metal, {foot.x, 0.035f, foot.y}, 0.035f, 20, 12);
  }
  for (const float x : {0.66f, 0.84f}) add_cylinder(body, {x, 0.12f, -0.2f}, {x, 0.64f, -0.2f}, 0.018f, 0.018f, 16);
  add_chamfered_box(body, {0.6f, 0.06f, -0.26f}, {0.9f, 0.13f, -0.13f}, 0.012f);
  for (const float x : {0.67f, 0.75f, 0.83f})
    add_pillow(metal, {x, 0.075f, -0.08f}, {0.018f, 0.008f, 0.07f}, 0.6f, 20, 10);
  place(scene, "piano case", m.black_lacquer, body, at);
  // The lid turns about the spine.
  const float open = 0.62f, reach = 1.2f;
  add_extrusion(lid, piano_outline(1.015f, 0.42f), 0, 0.022f);
  place(scene, "piano lid", m.black_lacquer, lid,
        at * moved({0, case_high + 0.004f, 0}) * turned(open, {0, 0, 1}) * laid_down());
  add_cylinder(metal, {1.38f, case_high - 0.03f, -0.85f},
               {reach * std::cos(open), case_high + reach * std::sin(open), -0.85f}, 0.009f, 0.009f, 12);
  for (const float z : {-0.6f, -1.2f, -1.7f})
    add_cylinder(metal, {-0.004f, case_high, z}, {-0.004f, case_high, z - 0.12f}, 0.01f, 0.01f, 12);
  place(scene, "piano fittings", m.brass, metal, at);
}

void add_piano_inside(Scene& scene, const Materials& m, const mat4& at) {
  Mesh sound_board, plate, strings, dampers;
  add_extrusion(sound_board, piano_outline(0.92f, 0.43f), 0.7f, 0.73f);
  add_extrusion(plate, piano_outline(0.9f, 0.44f),
                {circle({0.25f, 1.72f}, 0.09f), circle({0.5f, 1.86f}, 0.08f), circle({0.72f, 1.7f}, 0.08f),
                 circle({0.3f, 1.35f}, 0.12f), circle({0.75f, 1.25f}, 0.12f), circle({1.15f, 0.95f}, 0.08f)},
                0.78f, 0.8f);
  for (int i = 0; i < 56; ++i) {
    const float t = float(i) / 55, x = 0.12f + 1.22f * t;
    const float end = 1.9f - 1.25f * std::pow(t, 0.8f);
    add_cylinder(strings, {x, 0.85f, -0.5f}, {x - 0.1f * (1 - t) + 0.06f, 0.84f, -end}, 0.0022f, 0.0022f, 5);
    add_chamfered_box(dampers, {x - 0.008f, 0.85f, -0.68f}, {x + 0.008f, 0.88f, -0.6f}, 0.002f);
  }
  add_chamfered_box(dampers, {0.08f, 0.8f, -0.5f}, {1.4f, 0.85f, -0.46f}, 0.006f);
  place(scene, "sound board", m.spruce, sound_board, at * laid_down());
  place(scene, "piano plate", m.gilt, plate, at * laid_down());
  place(scene, "strings", m.steel, strings, at);
  place(scene, "dampers", m.ebony, dampers, at);
}

void add_piano(Scene& scene, const Materials& m, const mat4& at) {
  add_piano_case(scene, m, at);
  add_piano_keys(scene, m, at);
  add_piano_inside(scene, m, at);
  Mesh desk, music, legs, seat;
  add_extrusion(desk, rectangle({0.35f, 0}, {1.15f, 0.26f}),
                {circle({0.55f, 0.13f}, 0.06f), circle({0.75f, 0.13f}, 0.07f), circle({0.95f, 0.13f}, 0.06f)}, 0,
                0.014f);
  add_box(music, {0.53f, 0.004f, 0.016f}, {0.745f, 0.3f, 0.02f});
  add_box(music, {0.755f, 0.004f, 0.016f}, {0.97f, 0.3f, 0.02f});
  const mat4 lean = at * moved({0, case_high + 0.022f, -0.3f}) * turned(-0.35f, {1, 0, 0});
  place(scene, "music desk", m.black_lacquer, desk, lean);
  place(scene, "sheet music", m.paper, music, lean);
  const mat4 bench = at * moved({0.75f, 0, 0.6f});
  add_legs(legs, 0.34f, 0.16f, 0.44f, 0.03f);
  add_chamfered_box(legs, {-0.38f, 0.4f, -0.19f}, {0.38f, 0.46f, 0.19f}, 0.008f);
  add_tufted(seat, {-0.37f, -0.18f, 0}, {0.37f, 0.18f, 0.03f}, 6, 3);
  place(scene, "piano bench", m.black_lacquer, legs, bench);
  place(scene, "piano bench seat", m.brown_leather, seat, bench * moved({0, 0.46f, 0}) * laid_down());
}

// --- Plants.

/// A leaf, one sheet, from its stalk at the origin along +z; it droops.
void add_leaf(Mesh& mesh, const mat4& at, float length, float width, float droop, int rows = 7) {
  const auto surface = [&](float u, float v) {
    const float across = (u - 0.5f) * width * std::sin(pi * std::min(0.04f + 0.96f * std::pow(v, 0.8f), 1.0f));
    return vec3(at * glm::vec4(across, 0.25f * std::abs(across) - droop * length * v * v, length * v, 1));
  };
  add_surface(mesh, surface, 2, rows);
}

void add_palm(Scene& scene, const Materials& m, vec3 at, float size, uint32_t seed) {
  Mesh stems, leaves;
  for (uint32_t i = 0; i < 13; ++i) {
    const float turn = 2.4f * float(i) + hash01(seed, i), rise = 0.75f + 0.45f * hash01(seed, i, 1);
    const float reach = 0.45f + 0.4f * hash01(seed, i, 2);
    const auto path = [&](float t) {
      const float out = reach * std::pow(t, 1.4f), up = rise * (1.5f * t - 0.62f * t * t);
      return vec3(std::sin(turn) * out, up, std::cos(turn) * out);
    };
    std::vector<vec3> stem;
    for (int k = 0; k <= 12; ++k) stem.push_back(path(float(k) / 12));
    add_tube(stems, stem, 0.007f, 6);
    for (int k = 0; k < 30; ++k) {
      const float t = 0.32f + 0.68f * float(k / 2) / 15, side = k % 2 ? 1.0f : -1.0f;
      const mat4 foot =
          moved(path(t)) * turned_y(turn + side * (1.0f - 0.5f * t)) * turned(-0.35f + 0.5f * t, {1, 0, 0});
      add_leaf(leaves, foot, 0.3f * (1.25f - 0.8f * t), 0.034f, 0.5f, 5);
    }
  }
  const mat4 place_at = moved(at) * scaled(vec3(size));
  place(scene, "palm stems", m.bark, stems, place_at);
  place(scene, "leaves", m.leaf, leaves, place_at);
}

void add_rubber_plant(Scene& scene, const Materials& m, vec3 at, float size, uint32_t seed) {
  Mesh stems, leaves;
  for (uint32_t i = 0; i < 3; ++i) {
    const float turn = 2.1f * float(i) + hash01(seed, i), tall = 0.8f + 0.5f * hash01(seed, i, 1);
    const auto path = [&](float t) {
      return vec3(0.03f + 0.16f * t * t * std::sin(turn), tall * t, 0.16f * t * t * std::cos(turn));
    };
    std::vector<vec3> stem;
    for (int k = 0; k <= 8; ++k) stem.push_back(path(float(k) / 8));
    add_tube(stems, stem, 0.011f, 8);
    for (uint32_t k = 0; k < 13; ++k) {
      const float t = 0.25f + 0.75f * float(k) / 12;
      const mat4 foot =
          moved(path(t)) * turned_y(2.4f * float(k) + turn) * turned(-0.8f + 0.5f * hash01(k, seed), {1, 0, 0});
      add_leaf(leaves, foot, 0.26f + 0.08f * hash01(k, i, seed), 0.13f, 0.35f, 10);
    }
  }
  const mat4 place_at = moved(at) * scaled(vec3(size));
  place(scene, "rubber stems", m.bark, stems, place_at);
  place(scene, "leaves", m.leaf, leaves, place_at);
}

void add_potted(Scene& scene, const Materials& m, vec3 at, float size, int glaze, bool palm, uint32_t seed) {
  const Mesh planter =
      turned_shape({0.2f, 0, 0.22f, 0.02f, 0.3f, 0.3f, 0.28f, 0.46f, 0.31f, 0.5f, 0.3f, 0.52f, 0.26f, 0.47f}, 32, 4);
  place(scene, "planter", glaze, planter, moved(at) * scaled(vec3(0.8f * size)));
  const vec3 earth = at + vec3(0, 0.36f * size, 0);
  if (palm) return add_palm(scene, m, earth, 1.25f * size, seed);
  add_rubber_plant(scene, m, earth, size, seed);
}

/// Tulips in a vase.
void add_tulips(Scene& scene, const Materials& m, vec3 at, int glaze, uint32_t seed) {
  place_pot(scene, glaze, Pot::urn, at, 0.28f);
  Mesh stems, heads, leaves;
  const Mesh head = turned_shape({0.006f, 0, 0.022f, 0.012f, 0.026f, 0.03f, 0.016f, 0.056f, 0.01f, 0.05f}, 16, 3);
  for (uint32_t i = 0; i < 15; ++i) {
    const float turn = 2.4f * float(i), out = 0.035f * std::sqrt(float(i)), tall = 0.26f + 0.1f * hash01(seed, i);
    const vec3 foot = at + vec3(0.02f * std::sin(turn), 0.25f, 0.02f * std::cos(turn));
    const vec3 end = foot + vec3(out * std::sin(turn), tall, out * std::cos(turn));
    add_tube(stems, {foot, glm::mix(foot, end, 0.5f) + vec3(0, 0.04f, 0), end}, 0.0035f, 6);
    append(heads, head, moved(end) * turned(2.5f * out, {std::cos(turn), 0, -std::sin(turn)}));
    add_leaf(leaves, moved(foot) * turned_y(turn + 1) * turned(-1.1f, {1, 0, 0}), 0.2f + 0.06f * hash01(seed, i, 2),
             0.035f, 0.5f);
  }
  place(scene, "tulip stems", m.leaf, stems, mat4(1));
  place(scene, "tulips", m.petal, heads, mat4(1));
  place(scene, "leaves", m.leaf, leaves, mat4(1));
}

// --- The room as it is furnished.

/// Two rings of lamps on bent arms.
void add_chandelier(Scene& scene, const Materials& m, vec3 at) {
  Mesh brass, globes;
  const float drop = at.y - height;
  add_cylinder(brass, {0, 0.5f, 0}, {0, -drop, 0}, 0.012f, 0.012f, 16);
  add_turned(brass, {0, -drop - 0.09f, 0}, {0, 0, 0.04f, 0.01f, 0.11f, 0.06f, 0.12f, 0.09f}, 40);
  append(
      brass,
      turned_shape({0.03f, 0, 0.09f, 0.06f, 0.05f, 0.14f, 0.025f, 0.2f, 0.06f, 0.32f, 0.03f, 0.42f, 0.015f, 0.52f}, 40),
      mat4(1));
  const auto add_ring = [&](int count, float radius, float low) {
    for (int i = 0; i < count; ++i) {
      const float turn = 2 * pi * (float(i) + 0.5f * float(count % 2)) / float(count);
      const vec3 out(std::sin(turn), 0, std::cos(turn));
      const auto point = [&](float r, float y) { return radius * r * out + vec3(0, low + y, 0); };
      add_tube(brass,
               {point(0.05f, 0.05f), point(0.3f, -0.04f), point(0.6f, -0.06f), point(0.85f, -0.01f),
                point(0.97f, 0.06f), point(1, 0.12f)},
               0.011f, 12);
      add_turned(brass, point(1, 0.1f), {0, 0, 0.02f, 0, 0.05f, 0.025f, 0.045f, 0.04f, 0, 0.04f}, 24);
      add_sphere(globes, point(1, 0.205f), 0.075f, 20, 12);
    }
    add_torus(brass, {0, low - 0.02f, 0}, {0, 1, 0}, 0.78f * radius, 0.008f, 96, 8);
  };
  add_ring(8, 0.62f, 0.1f);
  add_ring(5, 0.34f, 0.38f);
  place(scene, "chandelier", m.brass, brass, moved(at));
  place(scene, "chandelier globes", m.lamp, globes, moved(at));
}

/// A rug with a border, 8 mm thick where `high` says so.
void add_rug(Scene& scene, const Materials& m, vec3 low, vec3 high) {
  Mesh rug, border;
  add_chamfered_box(rug, low, high, 0.002f);
  const vec3 inset(0.12f, 0, 0.12f);
  add_chamfered_box(border, low + inset, high - inset + vec3(0, 0.003f, 0), 0.002f);
  place(scene, "rug border", m.rug, rug, mat4(1));
  place(scene, "rug", m.red_velvet, border, mat4(1));
}

/// A side board with a mirror above it, between the lamps of the right wall.
void add_console(Scene& scene, const Materials& m, const mat4& at) {
  Mesh body, knobs, mirror;
  add_chamfered_box(body, {-0.75f, 0.82f, 0.02f}, {0.75f, 0.86f, 0.46f}, 0.01f);
  add_chamfered_box(body, {-0.72f, 0.66f, 0.02f}, {0.72f, 0.82f, 0.43f}, 0.006f);
  for (int i = 0; i < 3; ++i) {
    const float x = -0.68f + 0.46f * float(i);
    add_chamfered_box(body, {x, 0.68f, 0.42f}, {x + 0.44f, 0.8f, 0.445f}, 0.006f);
    add_sphere(knobs, {x + 0.22f, 0.74f, 0.455f}, 0.016f, 20, 12);
  }
  for (const float x : {-0.68f, 0.68f}) {
    for (const float z : {0.06f, 0.39f}) add_cylinder(body, {x, 0, z}, {x, 0.68f, z}, 0.018f, 0.03f, 20);
  }
  place(scene, "console", m.green_lacquer, body, at);
  place(scene, "console knobs", m.old_brass, knobs, at);
  add_quad(mirror, {-0.55f, 1.25f, 0.022f}, {0.55f, 1.25f, 0.022f}, {0.55f, 2.75f, 0.022f}, {-0.55f, 2.75f, 0.022f});
  place(scene, "mirror", m.mirror, mirror, at);
  place(scene, "mirror frame", m.gilt, frame(1.1f, 1.5f, 0.11f), at * moved({0, 1.25f, 0}));
  add_table_lamp(scene, m, at * moved({-0.5f, 0.86f, 0.24f}), m.cobalt);
  place(scene, "vase", m.celadon, pot(Pot::jar), at * moved({0.5f, 0.86f, 0.24f}) * scaled(vec3(0.4f)));
  place(scene, "vase", m.red_lacquer, pot(Pot::bowl), at * moved({0.05f, 0.86f, 0.25f}) * scaled(vec3(0.3f)));
}

void furnish_hearth(Scene& scene, const Materials& m) {
  add_rug(scene, m, {-3.45f, 0, -3.55f}, {-1.25f, 0.008f, -1.85f});
  add_sofa(scene, m, moved({-2.1f, 0, -4.35f}), m.brown_leather);
  add_tub_chair(scene, m, moved({-1.0f, 0, -2.45f}) * turned_y(-1.45f), m.blue_velvet);
  add_tub_chair(scene, m, moved({-2.95f, 0, -1.5f}) * turned_y(pi - 0.45f), m.green_leather);
  add_mirror_table(scene, m, moved({-2.3f, 0.008f, -2.75f}), {0.5f, 0.36f});
  add_tea_set(scene, m, moved({-2.45f, 0.412f, -2.8f}) * turned_y(0.6f));
  add_book_heap(scene, m, moved({-2.0f, 0.412f, -2.6f}), 3);
  add_floor_lamp(scene, m, moved({-0.8f, 0, -4.55f}), m.chrome);
  add_round_table(scene, m, moved({-3.45f, 0, -4.3f}), m.mahogany, 0.26f, 0.58f);
  add_table_lamp(scene, m, moved({-3.45f, 0.58f, -4.3f}), m.celadon);
}

void furnish_right_side(Scene& scene, const Materials& m) {
  add_piano(scene, m, moved({1.5f, 0, -4.25f}) * turned_y(-1.25f));
  add_floor_lamp(scene, m, moved({0.3f, 0, -5.7f}), m.brass);
  add_round_table(scene, m, moved({2.55f, 0, -0.75f}), m.red_lacquer, 0.42f, 0.6f);
  add_table_lamp(scene, m, moved({2.65f, 0.6f, -0.85f}), m.porcelain);
  add_book_heap(scene, m, moved({2.35f, 0.6f, -0.62f}), 8);
  add_tub_chair(scene, m, moved({2.05f, 0, -1.75f}) * turned_y(0.55f), m.red_velvet);
  add_tub_chair(scene, m, moved({3.4f, 0, -0.25f}) * turned_y(-0.9f), m.brown_leather);
  add_folding_screen(scene, m, moved({2.35f, 0, -8.2f}) * turned_y(0.35f));
  add_console(scene, m, on_right_wall(1.1f));
}

void furnish_foreground(Scene& scene, const Materials& m) {
  add_round_table(scene, m, moved({-1.55f, 0, 0.2f}), m.black_lacquer, 0.48f, 0.66f);
  add_chess(scene, m, moved({-1.62f, 0.66f, 0.15f}) * turned_y(0.4f));
  add_tulips(scene, m, {-1.28f, 0.66f, 0.38f}, m.cobalt, 4);
  add_tub_chair(scene, m, moved({-2.35f, 0, 0.6f}) * turned_y(2.0f), m.red_velvet);
  add_tub_chair(scene, m, moved({-1.75f, 0, -0.85f}) * turned_y(-0.15f), m.green_leather);
}

void add_plants(Scene& scene, const Materials& m) {
  add_potted(scene, m, {1.3f, 0, -8.35f}, 1, m.cobalt, true, 1);
  add_potted(scene, m, {-1.3f, 0, -8.35f}, 1, m.celadon, true, 2);
  add_potted(scene, m, {4.0f, 0, -6.0f}, 1, m.porcelain, false, 3);
  add_potted(scene, m, {3.95f, 0, -3.2f}, 0.9f, m.terracotta, true, 4);
  add_potted(scene, m, {-3.95f, 0, 1.55f}, 1, m.stoneware, false, 5);
  add_potted(scene, m, {3.9f, 0, 2.5f}, 1, m.cobalt, true, 6);
  place_pot(scene, m.red_lacquer, Pot::flask, {0.45f, 0, -8.3f}, 0.95f);
  place_pot(scene, m.porcelain, Pot::jar, {-0.45f, 0, -8.4f}, 0.75f);
  place_pot(scene, m.stoneware, Pot::urn, {-4.15f, 0, -4.75f}, 0.8f);
}

Scene make(const ParameterValues&) {
  Scene scene;
  const Materials m = add_materials(scene);
  add_floor(scene, m);
  add_walls(scene, m);
  add_ceiling(scene, m);
  add_columns(scene, m);
  add_balustrade(scene, m);
  add_city(scene, m);
  add_bookcase(scene, m, on_left_wall(-0.05f), 1.8f, 40);
  const mat4 hearth = on_left_wall(-2.7f);
  add_fireplace(scene, m, hearth);
  add_mantel_things(scene, m, hearth);
  add_bar(scene, m, on_left_wall(-7.05f));
  furnish_hearth(scene, m);
  furnish_right_side(scene, m);
  furnish_foreground(scene, m);
  add_plants(scene, m);
  add_chandelier(scene, m, {0, 2.35f, -3.0f});
  scene.cameras = {looking_at("main", {0.75f, 1.42f, 2.6f}, {-0.3f, 0.9f, -4.0f}, 76),
                   looking_at("piano", {-0.6f, 1.45f, -0.4f}, {2.2f, 0.75f, -4.6f}, 70),
                   looking_at("hearth", {0.2f, 1.5f, 0.3f}, {-3.7f, 0.95f, -4.6f}, 76)};
  scene.light.to_sun = {0.85f, 0.5f, -0.12f};
  scene.light.sun = {9.0f, 6.2f, 3.7f};
  scene.light.zenith = {0.40f, 0.37f, 0.40f};
  scene.light.horizon = {0.60f, 0.49f, 0.42f};
  scene.light.ground = {0.29f, 0.235f, 0.20f};
  scene.ao_radius = 0.5;
  return scene;
}

}  // namespace

std::vector<SceneRecipe> lounge() {
  return {{.name = "lounge",
           .summary = "a hotel's lounge at dusk: polished stone, lacquer, mirrors, lamps, a bar, a fire and a piano",
           .kind = "architecture",
           .make = make}};
}

}  // namespace gloam::scenes
