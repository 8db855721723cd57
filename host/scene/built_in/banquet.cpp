// A dining room with a laid table: silver, lacquer, porcelain, bottles, fruit and bread on polished wood, many small
// glossy things one behind the other and close to the eyes of a person who sits at the table's end.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "scene/built_in/mesh_builder.h"

namespace gloam::scenes {
namespace {

using glm::mat4;
constexpr float pi = glm::pi<float>();

// The room is 4.4 m wide, from z = 2.4 behind the main camera to -3.0; the table stands in the middle of its width,
// along z.
constexpr float half_width = 2.2f, front = 2.4f, back = -3.0f, height = 2.8f, thick = 0.3f;
constexpr float table_half_width = 0.55f, table_half_length = 1.3f, table_top = 0.76f;
constexpr float cloth_near = -0.56f, cloth_far = -1.06f, cloth_thick = 0.002f;
constexpr float plateau_top = table_top + 0.016f;

struct Materials {
  // In and about the room.
  int wall, panel, ceiling, floor_light, floor_dark, skirting, window_frame, curtain, gilt, varnish, sideboard, marble,
      outside;
  // Furniture.
  int table, banding, mahogany, leather, cloth, runner, napkin;
  // Metals.
  int mirror, bright_silver, silver, spun_silver, old_silver, steel, gold, brass, old_brass, copper, hammered_copper,
      bronze, pewter, iron;
  // Glazes and lacquers.
  int porcelain, cobalt, celadon, stoneware, black_lacquer, red_lacquer, green_bottle, brown_bottle, blue_bottle,
      clay_bottle, foil, sealing_wax, ebony, bone;
  // Food and candles.
  int red_apple, green_apple, orange, lemon, pear, dark_grape, green_grape, cherry, stalk, crust, cheese, rind, board,
      wicker, coffee, candle, flame;
  std::vector<int> labels, pictures;
};

// --- Pictures that are computed.

Painter seeded(vec3 (*paint)(float x, float y, uint32_t seed), uint32_t seed = 0) {
  return [=](float x, float y) { return paint(x, y, seed); };
}

/// Two leaves of figured mahogany, mirrored at the middle as a cabinet maker lays them; the grain runs along y.
vec3 wood(float x, float y, uint32_t seed) {
  const float across = std::abs(x - 0.5f);
  const float sway = noise(3 * across, 2.5f * y, seed) + 0.4f * noise(9 * across, 6 * y, seed + 1);
  const float rings = 0.5f + 0.5f * std::sin(50 * across + 9 * sway);
  const float pores = noise(260 * across, 14 * y, seed + 2);
  const vec3 colour = glm::mix(vec3(0.42f, 0.22f, 0.13f), vec3(0.59f, 0.36f, 0.22f), 0.75f * rings);
  return colour * (0.78f + 0.3f * pores) * (across < 0.0015f ? 0.7f : 1.0f);
}

/// How much of the material's roughness there is: worn and smeared patches.
vec3 wear(float x, float y, uint32_t seed) {
  const float smear = 0.6f * noise(5 * x, 12 * y, seed) + 0.4f * noise(23 * x, 40 * y, seed + 1);
  return vec3(0.5f + 0.5f * smear);
}

/// One repeat of a woven check: where warp and weft are both coloured, the colour is full.
vec3 check_pattern(float x, float y, uint32_t seed) {
  const int coloured = (x < 0.5f) + (y < 0.5f);
  const vec3 inks[] = {{0.90f, 0.88f, 0.82f}, {0.66f, 0.42f, 0.40f}, {0.50f, 0.10f, 0.10f}};
  return inks[coloured] * (0.9f + 0.1f * noise(48 * x, 48 * y, seed));
}

/// One repeat of a striped linen.
vec3 stripe_pattern(float x, float y, uint32_t seed) {
  const bool blue = x < 0.22f || (x > 0.3f && x < 0.36f);
  return (blue ? vec3(0.22f, 0.30f, 0.48f) : vec3(0.86f, 0.84f, 0.78f)) * (0.88f + 0.12f * noise(64 * x, 64 * y, seed));
}

/// A bottle's label: a frame, a crest and lines of writing that are too small to be read.
vec3 label(float x, float y, uint32_t seed) {
  const vec3 grounds[] = {{0.90f, 0.86f, 0.74f}, {0.85f, 0.80f, 0.66f}, {0.20f, 0.07f, 0.07f}};
  const vec3 inks[] = {{0.35f, 0.05f, 0.06f}, {0.08f, 0.12f, 0.22f}, {0.85f, 0.68f, 0.35f}};
  const vec3 ground = grounds[seed % 3] * (0.94f + 0.06f * noise(20 * x, 20 * y, seed)), ink = inks[seed % 3];
  const float edge = std::min({x, 1 - x, y, 1 - y});
  if (edge > 0.04f && edge < 0.065f) return ink;
  const vec2 crest((x - 0.5f) / 0.13f, (y - 0.28f) / 0.14f);
  if (glm::length(crest) < 1) return glm::length(crest) > 0.75f || std::abs(crest.x) < 0.2f ? ink : 0.7f * ground;
  const int line = int(std::floor((y - 0.48f) / 0.075f));
  const float inside = (y - 0.48f) / 0.075f - float(line), wide = line == 1 ? 0.36f : 0.2f + 0.1f * hash01(seed, 40);
  if (line < 0 || line > 5 || edge < 0.1f || inside > (line == 1 ? 0.95f : 0.5f) || std::abs(x - 0.5f) > wide)
    return ground;
  return noise(70 * x, float(line) * 3.7f, seed + 9) > 0.42f ? ink : ground;
}

/// Hills under an evening sky.
vec3 landscape(float x, float y, uint32_t seed) {
  vec3 colour = glm::mix(vec3(0.42f, 0.50f, 0.62f), vec3(0.86f, 0.68f, 0.46f), y) + 0.1f * (noise(6 * x, 14 * y, seed));
  for (int ridge = 0; ridge < 4; ++ridge) {
    const float line =
        0.42f + 0.14f * float(ridge) - 0.25f * (noise(2.5f * x + 7 * float(ridge), 0.5f, seed + 1) - 0.4f);
    if (y > line)
      colour = glm::mix(vec3(0.45f, 0.46f, 0.44f), vec3(0.20f, 0.22f, 0.10f), float(ridge) / 3) *
               (0.8f + 0.4f * noise(30 * x, 30 * y, seed));
  }
  return colour;
}

/// Flowers before a dark ground, every flower a few rings of petals.
vec3 bouquet(float x, float y, uint32_t seed) {
  vec3 colour = vec3(0.20f, 0.15f, 0.11f) * (0.6f + 0.8f * noise(4 * x, 4 * y, seed));
  if (std::abs(x - 0.5f) < 0.13f - 0.1f * std::abs(y - 0.82f) && y > 0.68f && y < 0.95f) colour = {0.35f, 0.42f, 0.5f};
  for (uint32_t i = 0; i < 22; ++i) {
    const float turn = 2 * pi * hash01(seed, i, 1), out = 0.3f * std::sqrt(hash01(seed, i, 2));
    const vec2 d = vec2(x - 0.5f, y - 0.42f) - out * vec2(std::cos(turn), 1.1f * std::sin(turn));
    const float r = 0.045f + 0.05f * hash01(seed, i, 3), petal = 1 + 0.15f * std::cos(7 * std::atan2(d.y, d.x) + turn);
    const vec3 inks[] = {{0.75f, 0.25f, 0.22f}, {0.88f, 0.80f, 0.66f}, {0.82f, 0.56f, 0.22f}, {0.30f, 0.38f, 0.18f}};
    const float reach = glm::length(d) / (r * petal);
    if (reach < 1) colour = inks[i % 4] * (1.05f - 0.5f * std::abs(std::sin(4 * reach)));
  }
  return colour;
}

// --- Materials.

void add_room_materials(Scene& scene, Materials& m) {
  m.wall = add_material(scene, "green wall", {0.24f, 0.30f, 0.25f}, 0.9f);
  m.panel = add_material(scene, "painted panel", {0.46f, 0.47f, 0.40f}, 0.5f);
  m.ceiling = add_material(scene, "ceiling", {0.70f, 0.69f, 0.65f}, 0.95f);
  m.floor_light = add_material(scene, "light parquet", {0.36f, 0.23f, 0.12f}, 0.22f);
  m.floor_dark = add_material(scene, "dark parquet", {0.27f, 0.16f, 0.08f}, 0.26f);
  m.skirting = add_material(scene, "skirting", {0.33f, 0.34f, 0.29f}, 0.45f);
  m.window_frame = add_material(scene, "white paint", {0.74f, 0.73f, 0.69f}, 0.4f);
  m.curtain = add_material(scene, "velvet curtain", {0.38f, 0.08f, 0.07f}, 1);
  m.gilt = add_material(scene, "gilt wood", {0.85f, 0.63f, 0.27f}, 0.35f, 1);
  m.sideboard = add_material(scene, "french polish", {0.24f, 0.11f, 0.05f}, 0.12f);
  m.marble = add_material(scene, "marble top", {0.66f, 0.62f, 0.57f}, 0.08f);
  m.outside = add_material(scene, "stone sill", {0.55f, 0.53f, 0.48f}, 0.9f);
  m.mahogany = add_material(scene, "chair mahogany", {0.22f, 0.09f, 0.045f}, 0.25f);
  m.leather = add_material(scene, "green leather", {0.10f, 0.17f, 0.11f}, 0.45f);
  m.napkin = add_material(scene, "napkin", {0.80f, 0.79f, 0.75f}, 0.95f);
  m.banding = add_material(scene, "table banding", {0.17f, 0.07f, 0.035f}, 0.12f);
}

void add_metals(Scene& scene, Materials& m) {
  m.mirror = add_material(scene, "mirror glass", {0.94f, 0.95f, 0.94f}, 0, 1);
  m.bright_silver = add_material(scene, "bright silver", {0.95f, 0.93f, 0.88f}, 0.05f, 1);
  m.silver = add_material(scene, "silver", {0.93f, 0.91f, 0.86f}, 0.1f, 1);
  m.spun_silver = add_material(scene, "spun silver", {0.91f, 0.89f, 0.84f}, 0.17f, 1);
  m.old_silver = add_material(scene, "old silver", {0.80f, 0.77f, 0.70f}, 0.25f, 1);
  m.steel = add_material(scene, "blade steel", {0.72f, 0.73f, 0.75f}, 0.08f, 1);
  m.gold = add_material(scene, "gold", {0.98f, 0.78f, 0.38f}, 0.12f, 1);
  m.brass = add_material(scene, "polished brass", {0.90f, 0.72f, 0.38f}, 0.1f, 1);
  m.old_brass = add_material(scene, "old brass", {0.70f, 0.55f, 0.28f}, 0.32f, 1);
  m.copper = add_material(scene, "copper", {0.94f, 0.60f, 0.45f}, 0.14f, 1);
  m.hammered_copper = add_material(scene, "hammered copper", {0.88f, 0.52f, 0.37f}, 0.22f, 1);
  m.bronze = add_material(scene, "bronze", {0.45f, 0.34f, 0.20f}, 0.35f, 1);
  m.pewter = add_material(scene, "pewter", {0.55f, 0.55f, 0.56f}, 0.4f, 1);
  m.iron = add_material(scene, "wrought iron", {0.30f, 0.30f, 0.31f}, 0.55f, 1);
}

void add_glazes(Scene& scene, Materials& m) {
  m.porcelain = add_material(scene, "porcelain", {0.78f, 0.77f, 0.73f}, 0.06f);
  m.cobalt = add_material(scene, "cobalt glaze", {0.05f, 0.09f, 0.32f}, 0.07f);
  m.celadon = add_material(scene, "celadon glaze", {0.42f, 0.55f, 0.45f}, 0.12f);
  m.stoneware = add_material(scene, "stoneware", {0.42f, 0.34f, 0.26f}, 0.38f);
  m.black_lacquer = add_material(scene, "black lacquer", {0.02f, 0.018f, 0.018f}, 0.02f);
  m.red_lacquer = add_material(scene, "red lacquer", {0.30f, 0.035f, 0.03f}, 0.04f);
  m.green_bottle = add_material(scene, "green bottle", {0.02f, 0.06f, 0.03f}, 0.03f);
  m.brown_bottle = add_material(scene, "brown bottle", {0.12f, 0.05f, 0.02f}, 0.05f);
  m.blue_bottle = add_material(scene, "blue bottle", {0.02f, 0.06f, 0.12f}, 0.04f);
  m.clay_bottle = add_material(scene, "clay bottle", {0.45f, 0.24f, 0.15f}, 0.48f);
  for (const int lacquer : {m.black_lacquer, m.red_lacquer, m.green_bottle, m.brown_bottle, m.blue_bottle})
    scene.materials[size_t(lacquer)].reflectance = 0.06f;
  m.foil = add_material(scene, "red foil", {0.55f, 0.06f, 0.06f}, 0.28f, 1);
  m.sealing_wax = add_material(scene, "sealing wax", {0.22f, 0.03f, 0.028f}, 0.3f);
  m.ebony = add_material(scene, "ebony", {0.05f, 0.04f, 0.035f}, 0.2f);
  m.bone = add_material(scene, "bone", {0.74f, 0.68f, 0.55f}, 0.3f);
}

void add_food_materials(Scene& scene, Materials& m) {
  m.red_apple = add_material(scene, "red apple", {0.36f, 0.06f, 0.045f}, 0.2f);
  m.green_apple = add_material(scene, "green apple", {0.38f, 0.46f, 0.09f}, 0.22f);
  m.orange = add_material(scene, "orange", {0.76f, 0.32f, 0.03f}, 0.4f);
  m.lemon = add_material(scene, "lemon", {0.68f, 0.52f, 0.09f}, 0.38f);
  m.pear = add_material(scene, "pear", {0.56f, 0.50f, 0.14f}, 0.36f);
  m.dark_grape = add_material(scene, "dark grape", {0.09f, 0.03f, 0.09f}, 0.18f);
  m.green_grape = add_material(scene, "green grape", {0.42f, 0.47f, 0.15f}, 0.16f);
  m.cherry = add_material(scene, "cherry", {0.30f, 0.015f, 0.025f}, 0.09f);
  m.stalk = add_material(scene, "stalk", {0.20f, 0.14f, 0.06f}, 0.7f);
  m.crust = add_material(scene, "bread crust", {0.52f, 0.28f, 0.11f}, 0.58f);
  m.cheese = add_material(scene, "cheese", {0.80f, 0.62f, 0.26f}, 0.5f);
  m.rind = add_material(scene, "cheese rind", {0.50f, 0.07f, 0.04f}, 0.33f);
  m.board = add_material(scene, "bread board", {0.50f, 0.33f, 0.18f}, 0.6f);
  m.wicker = add_material(scene, "wicker", {0.43f, 0.27f, 0.12f}, 0.65f);
  m.coffee = add_material(scene, "coffee", {0.05f, 0.025f, 0.012f}, 0.02f);
  m.candle = add_material(scene, "beeswax", {0.82f, 0.74f, 0.56f}, 0.42f);
  m.flame = add_material(scene, "flame", {0.9f, 0.8f, 0.6f}, 0.9f);
  scene.materials[size_t(m.flame)].emission = {1.6f, 1.1f, 0.5f};
}

int add_painted(Scene& scene, const std::string& name, float roughness, int texture) {
  const int material = add_material(scene, name, vec3(1), roughness);
  scene.materials.back().albedo_texture = texture;
  return material;
}

void add_painted_materials(Scene& scene, Materials& m) {
  m.table = add_painted(scene, "polished table", 0.2f, add_texture(scene, "figured wood", 512, 1024, seeded(wood, 3)));
  scene.materials[size_t(m.table)].roughness_texture =
      add_texture(scene, "wear of the polish", 256, 512, seeded(wear, 5));
  m.cloth = add_painted(scene, "checked cloth", 0.95f, add_texture(scene, "check", 64, 64, seeded(check_pattern)));
  m.runner = add_painted(scene, "striped linen", 0.95f, add_texture(scene, "stripes", 64, 64, seeded(stripe_pattern)));
  for (uint32_t i = 0; i < 3; ++i) {
    const std::string name = "label " + std::to_string(i);
    m.labels.push_back(add_painted(scene, name, 0.6f, add_texture(scene, name, 160, 192, seeded(label, i))));
  }
  for (uint32_t i = 0; i < 4; ++i) {
    const std::string name = "painting " + std::to_string(i);
    m.pictures.push_back(
        add_painted(scene, name, 0.2f, add_texture(scene, name, 160, 128, seeded(i % 2 ? bouquet : landscape, i))));
  }
}

Materials add_materials(Scene& scene) {
  Materials m;
  add_room_materials(scene, m);
  add_metals(scene, m);
  add_glazes(scene, m);
  add_food_materials(scene, m);
  add_painted_materials(scene, m);
  return m;
}

// --- Shapes that things are made of.

/// A small turn or offset in [-reach, reach] that belongs to a thing, so that nothing stands as if ruled.
float jitter(float reach, uint32_t thing, uint32_t which) { return reach * (2 * hash01(thing, which, 77) - 1); }

/// Points of a profile: radius, height, radius, height, ..., in millimetres.
std::vector<vec2> profile(const std::vector<float>& numbers) {
  std::vector<vec2> points;
  for (size_t i = 0; i + 1 < numbers.size(); i += 2) points.push_back(vec2(numbers[i], numbers[i + 1]) / 1000.0f);
  return points;
}

/// Points x, y, z, x, y, z, ..., in millimetres.
std::vector<vec3> path(const std::vector<float>& numbers) {
  std::vector<vec3> points;
  for (size_t i = 0; i + 2 < numbers.size(); i += 3)
    points.push_back(vec3(numbers[i], numbers[i + 1], numbers[i + 2]) / 1000.0f);
  return points;
}

/// A smooth curve through the points at t in [0, 1], the same stretch of t from each point to the next.
template <class Point>
Point along(const std::vector<Point>& points, float t) {
  const size_t last = points.size() - 1, i = std::min(size_t(t * float(last)), last - 1);
  const float f = t * float(last) - float(i);
  const Point a = points[i], b = points[i + 1];
  const Point from = 0.5f * (b - points[i > 0 ? i - 1 : 0]), to = 0.5f * (points[std::min(i + 2, last)] - a);
  const float f2 = f * f, f3 = f2 * f;
  return (2 * f3 - 3 * f2 + 1) * a + (f3 - 2 * f2 + f) * from + (3 * f2 - 2 * f3) * b + (f3 - f2) * to;
}

std::vector<vec3> bent(const std::vector<vec3>& points, int count) {
  std::vector<vec3> path;
  for (int i = 0; i < count; ++i) path.push_back(along(points, float(i) / float(count - 1)));
  return path;
}

/// The slope at point `at` of a profile, per metre of its length; 0 along an axis that turns back there, so that curves
/// do not swing past the points.
vec2 slope_at(const std::vector<vec2>& points, size_t at) {
  const vec2 before = at > 0 ? points[at] - points[at - 1] : vec2(0);
  const vec2 after = at + 1 < points.size() ? points[at + 1] - points[at] : vec2(0);
  const float a = glm::length(before), b = glm::length(after);
  if (a == 0 || b == 0) return (before + after) / (a + b);
  const vec2 mean = (b / a * before + a / b * after) / (a + b);
  return {before.x * after.x > 0 ? mean.x : 0, before.y * after.y > 0 ? mean.y : 0};
}

/// A profile for `add_lathe` with smooth curves between its points, in finer pieces where it bends. Repeated points
/// stay corners.
std::vector<vec2> smooth(const std::vector<vec2>& points, int most = 4) {
  std::vector<vec2> curve = {points.front()};
  for (size_t i = 0; i + 1 < points.size(); ++i) {
    const vec2 a = points[i], b = points[i + 1], way = b - a;
    const float length = glm::length(way);
    const auto limited = [&](vec2 slope) {
      return glm::clamp(length * slope, glm::min(3.0f * way, vec2(0)), glm::max(3.0f * way, vec2(0)));
    };
    const vec2 from = limited(slope_at(points, i)), to = limited(slope_at(points, i + 1));
    const float bend = (glm::length(from - way) + glm::length(to - way)) / std::max(length, 1e-6f);
    const int steps = length < 0.0025f ? 1 : std::clamp(int(1.5f + 1.9f * bend), 1, most);
    for (int k = 1; k < steps; ++k) {
      const float f = float(k) / float(steps), f2 = f * f, f3 = f2 * f;
      const vec2 p = (2 * f3 - 3 * f2 + 1) * a + (f3 - 2 * f2 + f) * from + (3 * f2 - 2 * f3) * b + (f3 - f2) * to;
      curve.push_back({std::max(p.x, 1e-5f), p.y});
    }
    curve.push_back(b);
  }
  return curve;
}

/// `add_surface` for a shape that is closed round its first parameter, an angle. Both sides of the seam and the corners
/// of a pole share one normal, so that a mirror shows no seam.
void add_round(Mesh& mesh, const std::function<vec3(float angle, float v)>& surface, int columns, int rows) {
  const size_t first = mesh.positions.size(), stride = size_t(columns) + 1;
  add_surface(
      mesh, [&](float u, float v) { return surface(u < 1 ? 2 * pi * u : 0, v); }, columns, rows);
  const auto row_normals = [&](int row) { return mesh.normals.begin() + long(first + size_t(row) * stride); };
  for (int row = 0; row <= rows; ++row) {
    const auto normals = row_normals(row);
    normals[0] = normals[columns] = glm::normalize(normals[0] + normals[columns]);
  }
  for (const int row : {0, rows}) {
    const vec3* corners = &mesh.positions[first + size_t(row) * stride];
    if (glm::length(corners[0] - corners[columns / 2]) > 1e-4f) continue;
    vec3 sum(0);
    for (int i = 0; i < columns; ++i) sum += row_normals(row == 0 ? 1 : rows - 1)[i];
    std::fill_n(row_normals(row), stride, glm::normalize(sum));
  }
}

/// A surface of revolution with `lobes` soft ribs, `depth` of the radius deep. Its profile has no corners.
void add_lobed(Mesh& mesh, const std::vector<vec2>& profile, int lobes, float depth, int segments) {
  const float last = float(profile.size() - 1);
  const auto surface = [&](float angle, float v) {
    const size_t i = std::min(size_t(v * last), profile.size() - 2);
    const vec2 p = glm::mix(profile[i], profile[i + 1], v * last - float(i));
    const float r = p.x * (1 + depth * std::cos(float(lobes) * angle));
    return vec3(r * std::sin(angle), p.y, r * std::cos(angle));
  };
  add_round(mesh, surface, segments, int(profile.size()) - 1);
}

struct Station {
  vec3 centre;
  vec2 half;  // width and thickness, half of each
};

/// Stations x, y, z, half width, half thickness, and so on, in millimetres.
std::vector<Station> stations(const std::vector<float>& numbers) {
  std::vector<Station> list;
  for (size_t i = 0; i + 4 < numbers.size(); i += 5) {
    list.push_back(
        {vec3(numbers[i], numbers[i + 1], numbers[i + 2]) / 1000.0f, vec2(numbers[i + 3], numbers[i + 4]) / 1000.0f});
  }
  return list;
}

Mesh sized(const Mesh& shape, vec3 factors) {
  Mesh mesh;
  append(mesh, shape, scaled(factors));
  return mesh;
}

/// A solid bar that runs along +z through stations, oval across: handles, blades, tines, spouts.
void add_bar(Mesh& mesh, const std::vector<Station>& list, int sides, int rows) {
  std::vector<vec3> centres;
  std::vector<vec2> halves;
  for (const Station& station : list) {
    centres.push_back(station.centre);
    halves.push_back(station.half);
  }
  const auto surface = [&](float angle, float v) {
    const vec2 half = v > 0 && v < 1 ? glm::max(along(halves, v), vec2(2e-4f)) : vec2(1e-5f);
    return along(centres, v) + vec3(half.x * std::cos(angle), half.y * std::sin(angle), 0);
  };
  add_round(mesh, surface, sides, rows);
}

/// A cushion, a loaf, a stone: a box whose corners are rounded; `power` 2 is an ellipsoid, more is more of a box.
void add_pillow(Mesh& mesh, vec3 centre, vec3 half, float power, int columns, int rows, float bumps = 0,
                uint32_t seed = 0) {
  const auto signed_power = [&](float x) { return std::copysign(std::pow(std::abs(x), 2 / power), x); };
  const auto surface = [&](float angle, float v) {
    const float polar = pi * (1 - v), across = v > 0 && v < 1 ? signed_power(std::sin(polar)) : 1e-5f;
    const vec3 d(across * signed_power(std::sin(angle)), signed_power(std::cos(polar)),
                 across * signed_power(std::cos(angle)));
    const float bump = bumps * (noise(9 * d.x + 20, 9 * d.z + 7 * d.y + 20, seed) - 0.5f);
    return centre + half * d * (1 + bump);
  };
  add_round(mesh, surface, columns, rows);
}

/// Texture coordinates for a grid that `add_surface` has just made in an empty mesh.
void add_coordinates(Mesh& mesh, int columns, int rows, const std::function<vec2(float u, float v)>& coordinate) {
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column)
      mesh.uvs.push_back(coordinate(float(column) / float(columns), float(row) / float(rows)));
  }
}

// --- The room.

/// Frame whose x runs along a wall, y up, z out of it; `turn` as turned_y: 0 faces +z.
mat4 on_wall(vec3 foot, float turn) { return moved(foot) * turned_y(turn); }

const float window_starts[] = {0.3f, 2.1f, 3.9f};  // along the left wall from the front
constexpr float window_width = 1.2f, window_sill = 0.55f, window_head = 2.55f;

void add_shell(Scene& scene, const Materials& m) {
  const float length = front - back;
  Mesh windows, plain, end;
  std::vector<std::vector<vec2>> holes;
  for (const float x : window_starts) holes.push_back(rectangle({x, window_sill}, {x + window_width, window_head}));
  add_extrusion(windows, rectangle({-thick, -0.05f}, {length + thick, height}), holes, -thick, 0);
  place(scene, "window wall", m.wall, windows, on_wall({-half_width, 0, front}, pi / 2));
  add_extrusion(plain, rectangle({-thick, -0.05f}, {length + thick, height}), -thick, 0);
  place(scene, "right wall", m.wall, plain, on_wall({half_width, 0, back}, -pi / 2));
  add_extrusion(end, rectangle({-half_width, -0.05f}, {half_width, height}), -thick, 0);
  place(scene, "far wall", m.wall, end, moved({0, 0, back}));
  place(scene, "near wall", m.wall, end, moved({0, 0, front}) * turned_y(pi));
  add_box(add_mesh(scene, "ceiling", m.ceiling), {-half_width - thick, height, back - thick},
          {half_width + thick, height + 0.2f, front + thick});
  Mesh light, dark;
  for (int row = 0; row < 34; ++row) {  // boards of 13 cm along z, joints staggered
    const float x = -half_width + 0.13f * float(row), right = std::min(x + 0.129f, half_width);
    for (int i = 0; i < 6; ++i) {
      const float z = back - 0.8f * hash01(uint32_t(row), 1) + 1.08f * float(i);
      Mesh& board = hash01(uint32_t(row), uint32_t(i), 2) < 0.5f ? light : dark;
      add_chamfered_box(board, {x, -0.03f, std::max(z, back)}, {right, 0, std::min(z + 1.079f, front)}, 0.001f);
    }
  }
  place(scene, "light boards", m.floor_light, light, mat4(1));
  place(scene, "dark boards", m.floor_dark, dark, mat4(1));
  add_box(add_mesh(scene, "ground", m.outside), {-3.2f, -0.3f, back - 1}, {3.2f, -0.03f, front + 1});
}

/// One raised panel with a moulding round it, its lower left corner at `low`.
void add_panel(Mesh& mesh, vec2 low, vec2 size) {
  const vec2 high = low + size;
  const float bar = 0.035f, out = 0.03f;
  add_chamfered_box(mesh, {low.x, low.y, -0.01f}, {high.x, low.y + bar, out}, 0.01f);
  add_chamfered_box(mesh, {low.x, high.y - bar, -0.01f}, {high.x, high.y, out}, 0.01f);
  add_chamfered_box(mesh, {low.x, low.y + bar, -0.01f}, {low.x + bar, high.y - bar, out}, 0.01f);
  add_chamfered_box(mesh, {high.x - bar, low.y + bar, -0.01f}, {high.x, high.y - bar, out}, 0.01f);
  add_chamfered_box(mesh, {low.x + 0.08f, low.y + 0.08f, -0.02f}, {high.x - 0.08f, high.y - 0.08f, 0.018f}, 0.015f);
}

/// Panels side by side between two places of a wall, a chair rail, a skirting and a cornice.
void add_panelling(Scene& scene, const Materials& m, const mat4& at, float x0, float x1, int count, bool has_windows) {
  Mesh panels, rails, cornice;
  const float step = (x1 - x0) / float(count);
  for (int i = 0; i < count; ++i) {
    const float x = x0 + step * float(i) + 0.03f;
    if (!has_windows) add_panel(panels, {x, 1.0f}, {step - 0.06f, 1.52f});
    add_panel(panels, {x, 0.2f}, {step - 0.06f, has_windows ? 0.3f : 0.62f});
  }
  if (!has_windows) add_chamfered_box(rails, {x0, 0.87f, -0.01f}, {x1, 0.93f, 0.04f}, 0.012f);
  add_chamfered_box(rails, {x0, 0, -0.01f}, {x1, 0.14f, 0.03f}, 0.01f);
  add_chamfered_box(cornice, {x0, height - 0.14f, -0.01f}, {x1, height, 0.1f}, 0.03f);
  add_chamfered_box(cornice, {x0, height - 0.2f, -0.01f}, {x1, height - 0.14f, 0.05f}, 0.015f);
  place(scene, "panels", m.panel, panels, at);
  place(scene, "rails", m.skirting, rails, at);
  place(scene, "cornice", m.window_frame, cornice, at);
}

void add_window(Scene& scene, const Materials& m, float start) {
  const mat4 at = on_wall({-half_width, 0, front - start}, pi / 2);
  Mesh frame;
  const float w = window_width, low = window_sill, high = window_head;
  for (const float x : {0.0f, 0.5f * w - 0.03f, w - 0.05f})
    add_chamfered_box(frame, {x, low, -0.2f}, {x + 0.05f, high, -0.14f}, 0.008f);
  for (int i = 0; i <= 4; ++i) {
    const float y = glm::mix(low + 0.025f, high - 0.025f, float(i) / 4), half = i % 4 ? 0.012f : 0.025f;
    add_chamfered_box(frame, {0, y - half, -0.19f}, {w, y + half, -0.15f}, 0.005f);
  }
  add_chamfered_box(frame, {-0.08f, low - 0.04f, -0.1f}, {w + 0.08f, low, 0.12f}, 0.01f);
  for (const float x : {-0.07f, w}) add_chamfered_box(frame, {x, low, -0.01f}, {x + 0.07f, high, 0.035f}, 0.01f);
  add_chamfered_box(frame, {-0.07f, high, -0.01f}, {w + 0.07f, high + 0.08f, 0.035f}, 0.01f);
  place(scene, "window frame", m.window_frame, frame, at);
  Mesh drapes, rod;
  for (const float side : {0.0f, 1.0f}) {
    const float x0 = side > 0 ? w - 0.12f : -0.16f;
    const auto sheet = [&](float u, float v) {
      const float gather = 1 - 0.35f * std::exp(-30 * (v - 0.35f) * (v - 0.35f));
      const float x = x0 + 0.14f + gather * (u - 0.5f) * 0.28f;
      return vec3(x, 0.04f + 2.6f * v, 0.11f + 0.035f * std::sin(2 * pi * 5 * u + 3 * start + side + 0.7f * v));
    };
    add_surface(drapes, sheet, 48, 10);
  }
  add_cylinder(rod, {-0.25f, 2.66f, 0.11f}, {w + 0.25f, 2.66f, 0.11f}, 0.014f, 0.014f, 16);
  for (const float x : {-0.25f, w + 0.25f}) add_sphere(rod, {x, 2.66f, 0.11f}, 0.03f, 20, 12);
  place(scene, "curtain", m.curtain, drapes, at);
  place(scene, "curtain rod", m.old_brass, rod, at);
}

/// A picture in a moulded frame; the middle of its lower edge at the origin of `at`.
void add_framed(Scene& scene, const Materials& m, const mat4& at, vec2 size, int picture) {
  const std::vector<vec2> moulding = profile({0, 20, 150, 30, 350, 28, 600, 60, 850, 55, 1000, 40, 1000, 0});
  const vec2 corners[] = {{-0.5f * size.x, 0}, {0.5f * size.x, 0}, {0.5f * size.x, size.y}, {-0.5f * size.x, size.y}};
  const vec2 outward[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  Mesh frame, canvas;
  for (int side = 0; side < 4; ++side) {
    const auto point = [&](int corner, vec2 p) {
      return vec3(corners[corner % 4] + 0.09f * p.x * outward[corner % 4], 0.03f + p.y);
    };
    for (size_t i = 0; i + 1 < moulding.size(); ++i) {
      add_quad(frame, point(side, moulding[i + 1]), point(side + 1, moulding[i + 1]), point(side + 1, moulding[i]),
               point(side, moulding[i]));
    }
  }
  place(scene, "picture frame", m.gilt, frame, at);
  add_textured_quad(canvas, vec3(corners[0], 0.052f), vec3(corners[1], 0.052f), vec3(corners[2], 0.052f),
                    vec3(corners[3], 0.052f));
  place(scene, "picture", picture, canvas, at);
}

/// A candle with its flame, standing at the origin.
void add_candle(Scene& scene, const Materials& m, const mat4& at, float tall) {
  Mesh wax, flame;
  add_lathe(wax, vec3(0),
            {{0, 0}, {0.0095f, 0}, {0.0095f, 0}, {0.0095f, tall}, {0.007f, tall + 0.001f}, {0, tall - 0.003f}}, 16);
  add_lathe(flame, {0, tall + 0.003f, 0}, smooth(profile({0, 0, 4, 4, 6.2f, 13, 4, 26, 0, 42}), 3), 12);
  place(scene, "candle", m.candle, wax, at);
  place(scene, "flame", m.flame, flame, at);
}

void add_sconce(Scene& scene, const Materials& m, const mat4& at) {
  Mesh brass;
  add_lathe(brass, vec3(0), smooth(profile({0, -90, 20, -70, 50, 0, 45, 50, 0, 100})), 24);
  Mesh flat;
  append(flat, brass, scaled({1, 1, 0.35f}));
  for (const float side : {-1.0f, 1.0f}) {
    add_tube(
        flat,
        bent({{0, 0, 0.01f}, {side * 0.04f, -0.04f, 0.06f}, {side * 0.1f, -0.03f, 0.09f}, {side * 0.1f, 0.02f, 0.09f}},
             12),
        0.006f, 8);
    add_lathe(flat, {side * 0.1f, 0.01f, 0.09f}, smooth(profile({0, 0, 15, 3, 28, 15, 24, 16, 0, 10})), 14);
  }
  place(scene, "sconce", m.old_brass, flat, at);
  for (const float side : {-1.0f, 1.0f}) add_candle(scene, m, at * moved({side * 0.1f, 0.02f, 0.09f}), 0.11f);
}

void add_room(Scene& scene, const Materials& m) {
  add_shell(scene, m);
  const float length = front - back;
  add_panelling(scene, m, on_wall({-half_width, 0, front}, pi / 2), 0, length, 6, true);
  add_panelling(scene, m, on_wall({half_width, 0, back}, -pi / 2), 0, length, 8, false);
  add_panelling(scene, m, moved({-half_width, 0, back}), 0, 2 * half_width, 7, false);
  add_panelling(scene, m, on_wall({half_width, 0, front}, pi), 0, 2 * half_width, 7, false);
  for (const float start : window_starts) add_window(scene, m, start);
  add_framed(scene, m, moved({0, 1.42f, back}), {1.3f, 0.85f}, m.pictures[0]);
  add_framed(scene, m, moved({-1.5f, 1.45f, back}), {0.55f, 0.72f}, m.pictures[1]);
  add_framed(scene, m, moved({1.5f, 1.45f, back}), {0.55f, 0.72f}, m.pictures[3]);
  for (int i = 0; i < 3; ++i) {
    const mat4 at = on_wall({half_width, 1.3f, 1.0f - 1.5f * float(i)}, -pi / 2);
    add_framed(scene, m, at, {0.8f, 0.65f + 0.2f * hash01(uint32_t(i), 3)}, m.pictures[size_t(2 + i) % 4]);
  }
  for (const float x : {-1.0f, 1.0f}) add_sconce(scene, m, moved({x, 1.75f, back + 0.03f}));
  for (const float z : {0.25f, -1.25f}) add_sconce(scene, m, on_wall({half_width - 0.03f, 1.75f, z}, -pi / 2));
}

// --- The furniture.

void add_table(Scene& scene, const Materials& m) {
  const float w = table_half_width, l = table_half_length;
  Mesh top, boards, inlay, legs;
  add_chamfered_box(top, {-w, table_top - 0.018f, -l}, {w, table_top - 0.0003f, l}, 0.005f);
  add_chamfered_box(top, {-w + 0.012f, table_top - 0.034f, -l + 0.012f}, {w - 0.012f, table_top - 0.016f, l - 0.012f},
                    0.006f);
  for (const float s : {-1.0f, 1.0f}) {  // the apron
    add_box(top, {s * 0.46f - 0.012f, table_top - 0.13f, -1.16f}, {s * 0.46f + 0.012f, table_top - 0.03f, 1.16f});
    add_box(top, {-0.46f, table_top - 0.13f, s * 1.16f - 0.012f}, {0.46f, table_top - 0.03f, s * 1.16f + 0.012f});
  }
  const float x = w - 0.08f, z = l - 0.08f, y = table_top;
  add_textured_quad(boards, {-x, y, z}, {x, y, z}, {x, y, -z}, {-x, y, -z});
  for (const float s : {-1.0f, 1.0f}) {
    add_box(inlay, {s * x - 0.002f, y - 0.001f, -z}, {s * x + 0.002f, y + 0.0004f, z});
    add_box(inlay, {-x, y - 0.001f, s * z - 0.002f}, {x, y + 0.0004f, s * z + 0.002f});
    for (const float at : {-1.13f, 0.0f, 1.13f})
      add_lathe(legs, {s * 0.43f, 0, at}, smooth(profile({0,   0,  22,  0,  30,  30, 22,  60, 25,  90, 45,  350, 40,
                                                          450, 26, 490, 50, 520, 48, 540, 30, 560, 40, 600, 40,  740})),
                20);
  }
  place(scene, "table", m.banding, top, mat4(1));
  place(scene, "table boards", m.table, boards, mat4(1));
  place(scene, "table inlay", m.brass, inlay, mat4(1));
  place(scene, "table legs", m.banding, legs, mat4(1));
}

/// A cloth across the table that hangs down on both sides: upper and lower face in one closed surface.
void add_cloth(Scene& scene, const Materials& m) {
  const float hang = 0.2f, flat = 2 * table_half_width + 0.016f, length = flat + 2 * hang;
  const auto middle = [&](float s, float z) {  // x, y, and the outward direction
    const float d = s * length - 0.5f * length, beyond = std::max(std::abs(d) - 0.5f * flat, 0.0f);
    const float fold = beyond / hang, side = std::copysign(1.0f, d);
    const float out = 0.022f * fold * (1 + std::sin(38 * z + 2.3f * side) + 0.4f * std::sin(91 * z));
    const float x = side * (std::min(std::abs(d), 0.5f * flat) + out);
    return glm::vec4(x, table_top + 0.5f * cloth_thick - beyond, beyond > 0 ? side : 0, beyond > 0 ? 0 : 1);
  };
  const auto surface = [&](float angle, float v) {
    const float u = angle / pi, s = u <= 1 ? u : 2 - u;
    const glm::vec4 at = middle(s, glm::mix(cloth_near, cloth_far, v));
    const float hem = std::min({1.0f, 0.01f + 40 * v, 0.01f + 40 * (1 - v)});
    const float half = (u <= 1 ? 0.5f : -0.5f) * cloth_thick * hem;
    return vec3(at.x + half * at.z, at.y + half * at.w, glm::mix(cloth_near, cloth_far, v));
  };
  Mesh cloth;
  const int columns = 160, rows = 24;
  add_round(cloth, surface, columns, rows);
  add_coordinates(cloth, columns, rows, [&](float u, float v) {
    const float s = u <= 0.5f ? 2 * u : 2 - 2 * u;
    return vec2(s * length / 0.05f, v * (cloth_near - cloth_far) / 0.05f);
  });
  place(scene, "cloth", m.cloth, cloth, mat4(1));
}

/// The height that things on the table stand at: there is the cloth or there is none.
float rest(float z) { return table_top + (z < cloth_near && z > cloth_far ? cloth_thick : 0.0f); }

mat4 on_table(float x, float z, float turn = 0) { return moved({x, rest(z), z}) * turned_y(turn); }

/// A chair whose sitter looks along -z; the middle of its seat over the origin.
void add_chair(Scene& scene, const Materials& m, const mat4& at) {
  Mesh side, wood, cushion;
  add_lathe(side, {0.2f, 0, -0.19f},
            smooth(profile({0, 0, 12, 0, 14, 40, 20, 300, 14, 330, 24, 360, 22, 440, 0, 440}), 2), 12);
  add_tube(side, bent(path({190, 0, 250, 195, 440, 200, 195, 750, 220, 190, 1020, 290}), 14), 0.018f, 10);
  add_chamfered_box(side, {0.188f, 0.38f, -0.19f}, {0.212f, 0.45f, 0.2f}, 0.003f);
  add_tube(side, {{0.2f, 0.18f, -0.19f}, {0.192f, 0.18f, 0.225f}}, 0.01f, 8);
  append(wood, side, mat4(1));
  append(wood, side, scaled({-1, 1, 1}));
  for (const float z : {-0.2f, 0.19f}) add_chamfered_box(wood, {-0.2f, 0.38f, z}, {0.2f, 0.45f, z + 0.022f}, 0.003f);
  add_tube(wood, bent(path({-193, 600, 194, 0, 630, 234, 193, 600, 194}), 11), 0.014f, 8);
  add_tube(wood, bent(path({-193, 970, 283, 0, 1000, 323, 193, 970, 283}), 13), 0.026f, 12);
  for (int i = -2; i <= 2; ++i) {
    const float x = 0.065f * float(i);
    add_tube(wood,
             bent({{x, 0.62f, 0.225f}, {1.15f * x, 0.72f, 0.24f}, {0.8f * x, 0.85f, 0.28f}, {x, 0.99f, 0.315f}}, 9),
             0.008f, 6);
  }
  add_pillow(cushion, {0, 0.47f, 0}, {0.22f, 0.035f, 0.215f}, 5, 28, 10);
  place(scene, "chair", m.mahogany, wood, at);
  place(scene, "chair cushion", m.leather, cushion, at);
}

// --- Vessels.

/// A vessel's profile: the outside, the lip, and back down the inside, `wall` thinner, to its floor.
std::vector<vec2> hollow(std::vector<vec2> outside, float wall, float floor) {
  const std::vector<vec2> points = outside;
  outside.push_back({points.back().x - 0.5f * wall, points.back().y + 0.3f * wall});
  for (size_t i = points.size(); i-- > 0 && points[i].y > floor + wall;)
    if (points[i].x > 1.5f * wall) outside.push_back({points[i].x - wall, points[i].y});
  outside.push_back({0.6f * outside.back().x, floor + 0.3f * wall});
  outside.push_back({0, floor});
  return outside;
}

Mesh turned_shape(const std::vector<vec2>& points, int segments, int steps = 4) {
  Mesh mesh;
  add_lathe(mesh, vec3(0), smooth(points, steps), segments);
  return mesh;
}

Mesh goblet(float tall) {
  Mesh mesh = turned_shape(hollow(profile({0,  0,  30, 0,  34, 2,  33, 5,  12, 13,  6,  30,  6,  45,
                                           12, 52, 6,  60, 8,  72, 26, 84, 36, 110, 37, 135, 34, 165}),
                                  0.002f, 0.085f),
                           28, 2);
  return sized(mesh, {1, tall / 0.165f, 1});
}

Mesh beaker() {
  return turned_shape(hollow(profile({0, 0, 22, 0, 26, 3, 27, 20, 30, 50, 34, 75}), 0.002f, 0.008f), 26, 3);
}

Mesh plate(float radius) {
  const Mesh unit = turned_shape(
      profile({0, 0, 550, 0, 600, 3, 680, 6, 970, 17.5f, 1000, 19.5f, 985, 21, 720, 12.5f, 630, 7.5f, 500, 6, 0, 6}),
      42, 3);
  return sized(unit, {radius, 1, radius});
}

Mesh bowl(float radius, float tall, int segments = 36) {
  const Mesh unit = turned_shape(
      hollow(profile({0, 0, 400, 0, 450, 60, 420, 120, 750, 350, 950, 700, 1000, 1000}), 0.025f, 0.2f), segments);
  return sized(unit, {radius, tall, radius});
}

Mesh jug(float tall) {
  const float s = tall / 0.26f;
  Mesh mesh = turned_shape(
      hollow(profile({0, 0, 50, 0, 56, 6, 75, 50, 78, 85, 60, 140, 38, 180, 36, 205, 46, 250, 48, 260}), 0.003f, 0.01f),
      36);
  add_torus(mesh, {0, 0.178f, 0}, {0, 1, 0}, 0.0385f, 0.003f, 40, 8);
  add_tube(mesh, bent(path({0, 75, -74, 0, 120, -110, 0, 200, -105, 0, 250, -75, 0, 252, -46}), 24), 0.0065f, 10);
  Mesh lip;  // a beak that leans out of the rim
  add_bar(lip, stations({0, 243, 30, 12, 4, 0, 250, 50, 17, 6, 0, 262, 74, 8, 3}), 20, 10);
  append(mesh, lip, mat4(1));
  return sized(mesh, vec3(s));
}

/// A pot with ribs, a spout towards +z, a lid; the handle is a mesh of its own, for it is of wood.
Mesh coffee_pot(int segments = 84) {
  Mesh mesh;
  add_lobed(mesh,
            smooth(profile({0,   0,  35,  0,  42,  3,  36,  12, 30,  20, 50,  40, 62,  70, 60,
                            100, 45, 140, 34, 170, 36, 185, 38, 188, 30, 198, 12, 206, 0,  208}),
                   4),
            12, 0.045f, segments);
  add_lathe(mesh, {0, 0.204f, 0}, smooth(profile({0, 0, 5, 0, 4, 6, 10, 14, 6, 24, 0, 28})), 24);
  add_bar(mesh,
          stations({0, 60, 50, 14, 22, 0, 85, 85, 11, 14, 0, 135, 103, 7.5f, 11, 0, 172, 130, 6, 6, 0, 174, 137, 4, 2}),
          24, 28);
  return mesh;
}

Mesh pot_handle() {
  Mesh mesh;
  add_tube(mesh, bent(path({0, 150, -38, 0, 170, -75, 0, 130, -100, 0, 75, -85, 0, 60, -58}), 28), 0.006f, 12);
  return mesh;
}

Mesh cup() {
  Mesh mesh = turned_shape(hollow(profile({0, 0, 18, 0, 20, 4, 18, 7, 32, 22, 37, 42, 40, 56}), 0.0018f, 0.014f), 40);
  add_tube(mesh, bent(path({36, 46, 0, 50, 50, 0, 58, 36, 0, 48, 22, 0, 31, 22, 0}), 20), 0.0025f, 10);
  return mesh;
}

/// An oval tray with a ribbed rim and two handles; its floor at y = 0.004.
Mesh tray(vec2 half) {
  Mesh round, mesh;
  const auto surface =
      smooth(profile({0, 0, 900, 0, 930, 4, 970, 14, 1000, 16, 985, 18.5f, 950, 16, 915, 6, 880, 4, 0, 4}), 4);
  add_lobed(round, surface, 24, 0.012f, 168);
  append(mesh, round, scaled({half.x, 1, half.y}));
  for (const float s : {-1.0f, 1.0f})
    add_tube(mesh,
             bent({{s * 0.96f * half.x, 0.014f, -0.05f},
                   {s * (half.x + 0.03f), 0.03f, -0.045f},
                   {s * (half.x + 0.04f), 0.034f, 0},
                   {s * (half.x + 0.03f), 0.03f, 0.045f},
                   {s * 0.96f * half.x, 0.014f, 0.05f}},
                  28),
             0.0055f, 12);
  return mesh;
}

enum class BottleShape { straight, sloping, flask };

std::vector<vec2> bottle_profile(BottleShape shape) {
  if (shape == BottleShape::straight)
    return profile({0,   0,     32,  0,     36.5f, 5,     37.5f, 20,    37.5f, 100,   37.5f, 185, 33,  207, 19,
                    228, 14.5f, 250, 13.5f, 292,   13.5f, 292,   15.5f, 293,   15.5f, 303,   13,  306, 0,   306});
  if (shape == BottleShape::sloping)
    return profile({0,  0,   36,    0,   40.5f, 6,   41.5f, 30,  41, 130, 33, 180, 20, 220,
                    15, 250, 13.8f, 285, 13.8f, 285, 16,    286, 16, 296, 13, 299, 0,  299});
  return profile(
      {0, 0, 40, 0, 50, 8, 62, 50, 60, 90, 35, 130, 16, 155, 13, 200, 13, 200, 17, 202, 17, 211, 12, 214, 0, 214});
}

/// A stoppered bottle; flasks have a wax seal, the others foil and a label.
void add_bottle(Scene& scene, const Materials& m, const mat4& at, BottleShape shape, int material, uint32_t id) {
  const std::vector<vec2> outline = bottle_profile(shape);
  const float tall = outline.back().y;
  place(scene, "bottle", material, turned_shape(outline, 36), at);
  const int seals[] = {m.sealing_wax, m.foil, m.old_brass};
  Mesh seal;
  const float neck = shape == BottleShape::flask ? 0.03f : 0.075f, r = 0.0168f;
  add_lathe(seal, {0, tall - neck, 0},
            smooth({{0.0125f, -0.001f},
                    {r - 0.0005f, 0},
                    {r, 0.004f},
                    {r, neck - 0.002f},
                    {r - 0.003f, neck + 0.0015f},
                    {0, neck + 0.002f}},
                   3),
            32);
  place(scene, "bottle seal", seals[shape == BottleShape::flask ? 0 : id % 3], seal, at);
  if (shape == BottleShape::flask) return;
  Mesh paper;
  const float low = 0.045f, high = shape == BottleShape::straight ? 0.15f : 0.125f, around = 1.25f;
  const float radius = shape == BottleShape::straight ? 0.038f : 0.0421f;
  const auto sheet = [&](float u, float v) {
    const float angle = (2 * u - 1) * around;
    return vec3(radius * std::sin(angle), glm::mix(low, high, v), radius * std::cos(angle));
  };
  add_surface(paper, sheet, 32, 4);
  add_coordinates(paper, 32, 4, [](float u, float v) { return vec2(u, 1 - v); });
  place(scene, "paper", m.labels[id % m.labels.size()], paper, at);
}

// --- Cutlery: it lies along z, its head towards -z, its lowest points at y = 0.

std::vector<Station> handle(float from) {
  return {{{0, 0.004f, from}, {0.0035f, 0.0018f}},
          {{0, 0.006f, from + 0.03f}, {0.003f, 0.002f}},
          {{0, 0.004f, from + 0.07f}, {0.005f, 0.0018f}},
          {{0, 0.002f, from + 0.11f}, {0.0085f, 0.0016f}},
          {{0, 0.0018f, from + 0.125f}, {0.006f, 0.0014f}}};
}

Mesh fork(float length) {
  Mesh mesh;
  std::vector<Station> stem = stations({0, 7.5f, -62, 9, 1, 0, 4, -50, 11.5f, 1.4f, 0, 3, -38, 9, 1.6f});
  for (const Station& station : handle(-0.022f)) stem.push_back(station);
  add_bar(mesh, stem, 10, 22);
  for (int i = 0; i < 4; ++i) {
    const float x = 0.006f * (float(i) - 1.5f);
    add_bar(mesh,
            {{{x, 0.004f, -0.104f}, {0.0006f, 0.0006f}},
             {{x, 0.007f, -0.085f}, {0.0014f, 0.0011f}},
             {{x, 0.0075f, -0.055f}, {0.0018f, 0.0012f}}},
            6, 5);
  }
  return sized(mesh, vec3(length / 0.205f));
}

Mesh knife(float length) {
  Mesh mesh;
  add_bar(mesh, stations({3,     8.5f, -115, 2,    0.4f, 2,    8.5f, -100, 9, 0.7f, 0, 8.5f, -50,
                          10.5f, 0.9f, 0,    7.5f, 0,    8.5f, 1.3f, 0,    6, 10,   5, 5}),
          12, 18);
  add_bar(mesh, stations({0, 6, 6, 5.5f, 5, 0, 6, 30, 6.5f, 5.5f, 0, 6, 80, 8.5f, 6, 0, 6, 100, 6, 4}), 12, 12);
  return sized(mesh, vec3(length / 0.215f));
}

Mesh spoon(float length) {
  Mesh mesh, round;
  add_lathe(round, vec3(0),
            smooth(profile({0, 0, 500, 120, 850, 500, 1000, 950, 970, 1000, 800, 600, 450, 240, 0, 140})), 24);
  append(mesh, round, moved({0, 0.0005f, -0.07f}) * scaled({0.02f, 0.008f, 0.031f}));
  std::vector<Station> stem = stations({0, 8, -43, 4, 1.5f});
  for (const Station& station : handle(-0.025f)) stem.push_back(station);
  add_bar(mesh, stem, 10, 18);
  return sized(mesh, vec3(length / 0.2f));
}

// --- Food.

Mesh apple(uint32_t id) {
  Mesh mesh;
  add_lobed(mesh, smooth(profile({0, 9, 13, 0, 30, 9, 39, 36, 35, 57, 20, 67, 8, 63, 0, 54}), 3), 5,
            0.015f + 0.02f * hash01(id, 5), 30);
  return mesh;
}

Mesh pear() {
  return turned_shape(profile({0, 4, 12, 0, 30, 12, 36, 34, 29, 55, 19, 73, 16.5f, 86, 10, 95, 0, 93}), 32);
}

Mesh orange(uint32_t id) {
  Mesh mesh;
  const auto surface = [&](float angle, float v) {
    const float polar = pi * (1 - v), across = v > 0 && v < 1 ? std::sin(polar) : 1e-5f;
    const vec3 d(across * std::sin(angle), std::cos(polar), across * std::cos(angle));
    const float pores = noise(22 * angle, 60 * v, id), dimple = std::exp(-400 * (1 - v) * (1 - v));
    return vec3(0, 0.037f, 0) + d * vec3(0.0385f, 0.037f, 0.0385f) * (0.99f + 0.012f * pores * across - 0.06f * dimple);
  };
  add_round(mesh, surface, 40, 26);
  return mesh;
}

Mesh lemon() {
  Mesh upright = turned_shape(profile({0, 0, 7, 2, 11, 10, 25, 24, 29, 42, 25, 60, 10, 75, 6, 83, 0, 85}), 32);
  Mesh lying;
  append(lying, upright, moved({0, 0.029f, -0.0425f}) * turned(pi / 2, {1, 0, 0}));
  return lying;
}

/// A fruit with its stalk where it has one. `kind`: red apple, green apple, orange, pear, lemon.
void add_fruit(Scene& scene, const Materials& m, const mat4& at, uint32_t kind, uint32_t id) {
  const int skins[] = {m.red_apple, m.green_apple, m.orange, m.pear, m.lemon};
  const char* names[] = {"apple", "apple", "orange", "pear", "lemon"};
  const mat4 leaning = at * turned_y(7 * hash01(id, 1)) * turned(jitter(0.25f, id, 2), {1, 0, 0});
  place(scene, names[kind], skins[kind],
        kind < 2    ? apple(id)
        : kind == 2 ? orange(id)
        : kind == 3 ? pear()
                    : lemon(),
        leaning);
  if (kind == 2 || kind == 4) return;
  const float top = kind == 3 ? 0.092f : 0.055f;
  add_tube(add_mesh(scene, "stalk", m.stalk),
           {vec3(leaning * glm::vec4(0, top, 0, 1)), vec3(leaning * glm::vec4(0.002f, top + 0.012f, 0, 1)),
            vec3(leaning * glm::vec4(0.007f, top + 0.022f, 0, 1))},
           0.0013f, 8);
}

/// A bunch of grapes that lies along +z, thick at its stalk.
void add_grapes(Scene& scene, const Materials& m, const mat4& at, int skin, int count, uint32_t seed) {
  Mesh berries, stalk;
  for (int i = 0; i < count; ++i) {
    const uint32_t id = uint32_t(i);
    const float t = (float(i) + 0.5f) / float(count), r = 0.0092f + 0.002f * hash01(id, seed, 1);
    const float spread = 0.042f * std::sqrt(1 - t) + 0.006f, angle = 2.4f * float(i),
                out = spread * std::sqrt(hash01(id, seed, 2));
    const vec3 centre(out * std::cos(angle), r + 0.75f * std::max(out * std::sin(angle) + 0.4f * spread, 0.0f),
                      0.15f * t + jitter(0.008f, id, seed));
    Mesh berry;
    add_sphere(berry, vec3(0), r, 15, 8);
    append(berries, berry, moved(centre) * turned(2 * hash01(id, seed, 3), {1, 0, 0}) * scaled({1, 1, 1.14f}));
  }
  add_tube(stalk, bent(path({0, 30, 30, 5, 45, -10, 15, 40, -40}), 12), 0.002f, 8);
  place(scene, "grapes", skin, berries, at);
  place(scene, "grape stalk", m.stalk, stalk, at);
}

/// A pile of mixed fruit: two rings and one on top.
void add_fruit_pile(Scene& scene, const Materials& m, const mat4& at, uint32_t seed) {
  uint32_t id = 10 * seed;
  const auto put = [&](float radius, float angle, float y) {
    const vec3 place_at(radius * std::sin(angle), y, radius * std::cos(angle));
    add_fruit(scene, m, at * moved(place_at), (id * 3 + seed) % 5, id);
    ++id;
  };
  for (int i = 0; i < 6; ++i) put(0.08f, 2 * pi * float(i) / 6 + 0.3f * float(seed), 0.012f + 0.006f * hash01(id, 6));
  for (int i = 0; i < 3; ++i) put(0.042f, 2 * pi * float(i) / 3 + 0.5f, 0.066f);
  put(0.004f, 0, 0.122f);
}

/// A loaf along x with slanting cuts.
Mesh loaf(vec3 half, uint32_t seed) {
  Mesh mesh;
  const auto surface = [&](float angle, float v) {
    const float x = 2 * v - 1, end = v > 0 && v < 1 ? std::pow(1 - x * x * x * x, 0.6f) : 1e-5f;
    const float cut = std::sin(13 * x + 1.2f * std::cos(angle)), up = std::max(std::sin(angle), 0.0f);
    const float r = end * (1 + 0.07f * up * std::copysign(std::pow(std::abs(cut), 0.5f), cut) +
                           0.06f * (noise(8 * v, 3 * std::cos(angle) + 9, seed) - 0.5f));
    const float low = std::sin(angle) < 0 ? 0.55f : 1.0f;
    return vec3(half.x * x, 0.55f * half.y + half.y * low * r * std::sin(angle), -half.z * r * std::cos(angle));
  };
  add_round(mesh, surface, 44, 64);
  return mesh;
}

/// A woven basket: stakes, and strands that pass them in front and behind by turns.
Mesh basket(float radius, float tall) {
  Mesh mesh;
  const int stakes = 24, strands = 10;
  const auto flare = [&](float y) { return radius * (0.78f + 0.22f * std::sqrt(y / tall)); };
  add_cylinder(mesh, {0, 0.002f, 0}, {0, 0.008f, 0}, 0.8f * radius, 0.8f * radius, 40);
  for (int i = 0; i < stakes; ++i) {
    const float angle = 2 * pi * float(i) / float(stakes);
    const vec3 out(std::sin(angle), 0, std::cos(angle));
    std::vector<vec3> path;
    for (int k = 0; k <= 5; ++k)
      path.push_back(flare(tall * float(k) / 5) * out + vec3(0, 0.004f + tall * float(k) / 5, 0));
    add_tube(mesh, path, 0.0025f, 6);
  }
  for (int row = 0; row < strands; ++row) {
    const float y = 0.007f + (tall - 0.006f) * float(row) / float(strands - 1);
    std::vector<vec3> path;
    for (int i = 0; i <= 3 * stakes; ++i) {
      const float turn = float(i) / float(3 * stakes), angle = 2 * pi * turn;
      const float weave = 0.004f * std::sin(pi * float(stakes) * turn + pi * float(row % 2));
      path.push_back((flare(y) + weave) * vec3(std::sin(angle), 0, std::cos(angle)) + vec3(0, y, 0));
    }
    add_tube(mesh, path, 0.005f, 5);
  }
  add_torus(mesh, {0, tall + 0.006f, 0}, {0, 1, 0}, radius, 0.006f, 60, 10);
  return mesh;
}

// --- What stands on the table.

/// A place: its plate at the origin, its guest on the side of +z.
void add_setting(Scene& scene, const Materials& m, const mat4& at, uint32_t id) {
  const auto lying = [&](float x, float z, uint32_t which) {
    return at * moved({x + jitter(0.004f, id, which), 0, z + jitter(0.008f, id, which + 20)}) *
           turned_y(jitter(0.07f, id, which + 40));
  };
  const int glazes[] = {m.porcelain, m.cobalt, m.celadon};
  const int goblets[] = {m.gold, m.bright_silver, m.copper, m.black_lacquer};
  const int chargers[] = {m.pewter, m.spun_silver, m.red_lacquer, m.old_silver};
  place(scene, "charger", chargers[id % 4], plate(0.155f), at);
  const mat4 on_charger = at * moved({jitter(0.006f, id, 1), 0.0065f, jitter(0.006f, id, 2)});
  place(scene, "plate", m.porcelain, plate(0.128f), on_charger);
  Mesh rim;
  add_torus(rim, {0, 0.0205f, 0}, {0, 1, 0}, 0.1265f, 0.0013f, 56, 6);
  place(scene, "gold rim", m.gold, rim, on_charger);
  place(scene, "fork", m.silver, fork(0.205f), lying(-0.178f, 0.01f, 3));
  place(scene, "small fork", m.old_silver, fork(0.175f), lying(-0.205f, 0.02f, 4));
  place(scene, "knife", m.steel, knife(0.225f), lying(0.178f, 0, 5));
  place(scene, "spoon", m.bright_silver, spoon(0.2f), lying(0.205f, 0.015f, 6));
  place(scene, "goblet", goblets[id % 4], goblet(0.16f + 0.02f * hash01(id, 8)), lying(0.15f, -0.15f, 7));
  place(scene, "beaker", id % 2 ? m.red_lacquer : m.black_lacquer, beaker(), lying(0.09f, -0.17f, 9));
  const mat4 on_plate = on_charger * moved({0, 0.007f, 0}) * turned_y(jitter(0.6f, id, 10));
  if (id % 3 == 1) {
    place(scene, "soup bowl", glazes[(id / 2) % 3], bowl(0.075f, 0.05f), on_plate);
    return;
  }
  Mesh napkin, ring;  // rolled and pinched by its ring, it spreads at both ends
  const auto cloth = [&](float angle, float v) {
    const float z = 0.2f * (v - 0.5f), wide = 0.016f + 0.9f * std::abs(z) * std::abs(z) / 0.1f * 0.4f;
    const float r = v > 0 && v < 1 ? 1 + 0.13f * std::sin(9 * angle + 4 * v) : 1e-4f;
    return vec3(wide * r * std::cos(angle), 0.017f + 0.016f * r * std::sin(angle), z);
  };
  add_round(napkin, cloth, 48, 16);
  add_torus(ring, {0, 0.019f, 0}, {0, 0, 1}, 0.0185f, 0.0028f, 40, 12);
  for (const vec3 p : napkin.positions) napkin.uvs.push_back(vec2(p.x, p.z) / 0.04f);
  place(scene, "napkin", id % 4 < 2 ? m.napkin : m.runner, napkin, on_plate);
  place(scene, "napkin ring", id % 2 ? m.copper : m.brass, ring, on_plate);
}

void add_candelabrum(Scene& scene, const Materials& m, const mat4& at, int material, int arms) {
  Mesh body = turned_shape(profile({0,  0,  60, 0,   65, 4,   60, 10,  35, 18,  30, 28,  12, 40,  10, 60,  20, 75,
                                    10, 90, 8,  150, 12, 190, 22, 205, 12, 220, 8,  235, 9,  280, 16, 290, 0,  295}),
                           26, 3);
  const std::vector<vec2> socket =
      smooth(profile({0, 0, 6, 2, 26, 10, 27, 13, 13, 13, 12, 18, 14, 33, 11, 35, 0, 30}), 2);
  Mesh arm;
  add_tube(arm, bent(path({0, 205, 8, 0, 175, 40, 0, 180, 90, 0, 215, 125, 0, 255, 125}), 22), 0.0052f, 9);
  add_torus(arm, {0, 0.196f, 0.045f}, {1, 0, 0}, 0.015f, 0.003f, 16, 7);
  add_lathe(arm, {0, 0.25f, 0.125f}, socket, 17);
  add_lathe(body, {0, 0.285f, 0}, socket, 17);
  std::vector<vec3> candles = {{0, 0.315f, 0}};
  for (int i = 0; i < arms; ++i) {
    const float angle = 2 * pi * float(i) / float(arms);
    append(body, arm, turned_y(angle));
    candles.push_back({0.125f * std::sin(angle), 0.28f, 0.125f * std::cos(angle)});
  }
  place(scene, "candelabrum", material, body, at);
  for (size_t i = 0; i < candles.size(); ++i)
    add_candle(scene, m, at * moved(candles[i]), 0.08f + 0.05f * hash01(uint32_t(i), uint32_t(arms), 4));
}

/// The mirror in the middle of the table, in a gilt rail on small balls, and what stands on it.
void add_plateau(Scene& scene, const Materials& m) {
  const float w = 0.15f, near = 0.36f, far = -0.5f;
  Mesh glass, rail, baluster;
  add_chamfered_box(glass, {-w, table_top + 0.004f, far}, {w, plateau_top, near}, 0.002f);
  add_lathe(baluster, vec3(0), smooth(profile({0, 0, 3, 0, 1.8f, 4, 3.4f, 9, 1.6f, 16, 0, 16}), 2), 8);
  for (const float s : {-1.0f, 1.0f}) {
    const float z = s > 0 ? near : far;
    add_chamfered_box(rail, {s * w - 0.006f, table_top + 0.003f, far - 0.006f},
                      {s * w + 0.006f, plateau_top + 0.003f, near + 0.006f}, 0.002f);
    add_chamfered_box(rail, {-w, table_top + 0.003f, z - 0.006f}, {w, plateau_top + 0.003f, z + 0.006f}, 0.002f);
    add_tube(rail, {{s * w, plateau_top + 0.018f, far}, {s * w, plateau_top + 0.018f, near}}, 0.0022f, 10);
    add_tube(rail, {{-w, plateau_top + 0.018f, z}, {w, plateau_top + 0.018f, z}}, 0.0022f, 10);
    for (int i = 0; i < 22; ++i)
      append(rail, baluster, moved({s * w, plateau_top + 0.002f, glm::mix(far, near, float(i) / 21)}));
    for (int i = 1; i < 9; ++i) append(rail, baluster, moved({glm::mix(-w, w, float(i) / 9), plateau_top + 0.002f, z}));
    for (const float corner : {-w, w}) {
      add_sphere(rail, {corner, plateau_top + 0.024f, z}, 0.009f, 16, 10);
      add_sphere(rail, {corner, table_top + 0.006f, z}, 0.006f, 10, 7);
    }
  }
  place(scene, "mirror plateau", m.mirror, glass, mat4(1));
  place(scene, "plateau rail", m.gold, rail, mat4(1));
}

mat4 on_plateau(float x, float z, float turn = 0) { return moved({x, plateau_top, z}) * turned_y(turn); }

/// A footed bowl with ribs, 12 cm high; its floor at y = 0.07.
Mesh footed_bowl() {
  Mesh mesh;
  add_lobed(mesh,
            smooth(hollow(profile({0, 0, 50, 0, 55, 4, 45, 12, 18, 25, 14, 45, 24, 58, 80, 75, 118, 100, 132, 122}),
                          0.003f, 0.068f),
                   4),
            16, 0.03f, 112);
  return mesh;
}

void add_centrepieces(Scene& scene, const Materials& m) {
  add_plateau(scene, m);
  add_candelabrum(scene, m, on_plateau(0.01f, 0.2f, 0.35f), m.porcelain, 4);
  add_candelabrum(scene, m, on_plateau(-0.01f, -0.38f, 0.8f), m.silver, 4);
  place(scene, "fruit bowl", m.celadon, footed_bowl(), on_plateau(0, -0.09f));
  add_fruit_pile(scene, m, on_plateau(0, -0.09f) * moved({0, 0.082f, 0}), 1);
  for (uint32_t i = 0; i < 4; ++i) {  // salt cellars and eggs of stone at the mirror's corners
    const mat4 at = on_plateau(i % 2 ? 0.1f : -0.1f, i / 2 ? 0.29f : -0.24f, jitter(1, i, 90));
    place(scene, "salt cellar", i % 2 ? m.gold : m.cobalt, bowl(0.03f, 0.03f, 24), at);
    Mesh egg;
    add_lathe(egg, vec3(0), smooth(profile({0, 0, 14, 7, 17, 20, 11, 35, 0, 41})), 28);
    const int stones[] = {m.red_lacquer, m.celadon, m.black_lacquer, m.copper};
    place(scene, "egg", stones[i], egg, at * moved({0.012f, 0.001f, -0.075f}));
  }
}

/// Coffee for two on a silver tray, next to the main camera.
void add_coffee_tray(Scene& scene, const Materials& m, const mat4& at) {
  place(scene, "tray", m.bright_silver, tray({0.175f, 0.13f}), at);
  const auto on_tray = [&](float x, float z, float turn) { return at * moved({x, 0.0042f, z}) * turned_y(turn); };
  const mat4 pot = on_tray(-0.09f, -0.03f, 1.0f);
  place(scene, "coffee pot", m.silver, coffee_pot(), pot);
  place(scene, "pot handle", m.ebony, pot_handle(), pot);
  place(scene, "cream jug", m.bright_silver, jug(0.1f), on_tray(0.015f, -0.075f, -0.8f));
  Mesh sugar;
  add_lobed(sugar, smooth(hollow(profile({0, 0, 22, 0, 25, 4, 20, 9, 38, 30, 40, 45, 34, 60}), 0.002f, 0.018f)), 10,
            0.05f, 70);
  place(scene, "sugar bowl", m.spun_silver, sugar, on_tray(0.1f, -0.047f, 0));
  Mesh lumps;
  for (uint32_t i = 0; i < 9; ++i) {
    Mesh lump;
    add_chamfered_box(lump, vec3(-0.0065f), vec3(0.0065f), 0.001f);
    append(lumps, lump,
           moved({jitter(0.018f, i, 1), 0.045f + 0.014f * hash01(i, 2), jitter(0.018f, i, 3)}) *
               turned_y(6 * hash01(i, 4)) * turned(jitter(0.6f, i, 5), {1, 0, 0}));
  }
  place(scene, "sugar", m.napkin, lumps, on_tray(0.1f, -0.047f, 0));
  const vec3 cups[] = {{0.097f, 0.038f, 2.3f}, {-0.031f, 0.068f, 0.4f}};
  for (const vec3 c : cups) {
    const mat4 saucer = on_tray(c.x, c.y, c.z);
    place(scene, "saucer", m.porcelain, plate(0.062f), saucer);
    Mesh rim;
    add_torus(rim, {0, 0.0205f, 0}, {0, 1, 0}, 0.061f, 0.001f, 48, 6);
    place(scene, "gold rim", m.gold, rim, saucer);
    place(scene, "cup", c.x > 0 ? m.cobalt : m.porcelain, cup(), saucer * moved({0, 0.0062f, 0}));
    add_cylinder(add_mesh(scene, "coffee", m.coffee), vec3(saucer * glm::vec4(0, 0.048f, 0, 1)),
                 vec3(saucer * glm::vec4(0, 0.05f, 0, 1)), 0.0355f, 0.0358f, 36);
    place(scene, "coffee spoon", m.silver, spoon(0.115f),
          saucer * moved({-0.045f, 0.0155f, 0}) * turned(0.08f, {0, 0, 1}));
  }
}

/// An urn for tea: its fire in the foot, a small pot on its chimney, a tap towards +z.
void add_samovar(Scene& scene, const Materials& m, const mat4& at) {
  Mesh body, fittings;
  add_lobed(body,
            smooth(profile({0,   30,  60,  30,  62,  40, 40,  60, 45,  80, 90,  120, 115,
                            190, 118, 250, 100, 300, 70, 320, 66, 330, 30, 345, 0,   347}),
                   4),
            14, 0.03f, 96);
  for (int i = 0; i < 4; ++i) {
    const float angle = pi / 4 + pi / 2 * float(i);
    add_sphere(fittings, {0.075f * std::sin(angle), 0.014f, 0.075f * std::cos(angle)}, 0.014f, 20, 12);
  }
  add_chamfered_box(fittings, {-0.08f, 0.024f, -0.08f}, {0.08f, 0.036f, 0.08f}, 0.004f);
  add_lathe(fittings, {0, 0.34f, 0}, smooth(profile({0, 0, 30, 0, 28, 30, 45, 40, 45, 45, 0, 45})), 32);
  for (const float s : {-1.0f, 1.0f})
    add_tube(fittings,
             bent({{s * 0.11f, 0.27f, 0},
                   {s * 0.15f, 0.3f, 0},
                   {s * 0.175f, 0.26f, 0},
                   {s * 0.155f, 0.2f, 0},
                   {s * 0.112f, 0.19f, 0}},
                  28),
             0.007f, 12);
  add_tube(fittings, {{0, 0.14f, 0.09f}, {0, 0.14f, 0.165f}, {0, 0.135f, 0.172f}, {0, 0.115f, 0.174f}}, 0.0075f, 14);
  add_cylinder(fittings, {0, 0.14f, 0.145f}, {0, 0.178f, 0.145f}, 0.004f, 0.004f, 12);
  add_torus(fittings, {0, 0.188f, 0.145f}, {0, 0, 1}, 0.012f, 0.003f, 24, 10);
  place(scene, "samovar", m.brass, body, at);
  place(scene, "samovar fittings", m.old_brass, fittings, at);
  const mat4 top = at * moved({0, 0.385f, 0}) * scaled(vec3(0.62f)) * turned_y(0.9f);
  place(scene, "tea pot", m.porcelain, coffee_pot(60), top);
  place(scene, "tea pot handle", m.cobalt, pot_handle(), top);
}

void add_bread(Scene& scene, const Materials& m, const mat4& at) {
  Mesh board, crumbs;
  add_chamfered_box(board, {-0.15f, 0, -0.09f}, {0.15f, 0.018f, 0.09f}, 0.004f);
  add_chamfered_box(board, {0.148f, 0.002f, -0.02f}, {0.2f, 0.016f, 0.02f}, 0.004f);
  place(scene, "bread board", m.board, board, at);
  place(scene, "loaf", m.crust, loaf({0.11f, 0.05f, 0.055f}, 4),
        at * moved({-0.02f, 0.018f, -0.02f}) * turned_y(0.15f));
  for (uint32_t i = 0; i < 26; ++i) {
    const vec3 c(jitter(0.14f, i, 1), 0.019f, jitter(0.08f, i, 2));
    add_sphere(crumbs, c, 0.0012f + 0.0015f * hash01(i, 3), 7, 5);
  }
  place(scene, "crumbs", m.crust, crumbs, at);
  place(scene, "bread knife", m.steel, knife(0.27f), at * moved({0.04f, 0.018f, 0.065f}) * turned_y(1.75f));
}

void add_cheese(Scene& scene, const Materials& m, const mat4& at) {
  std::vector<vec2> sector = {{0, 0}};
  for (int i = 0; i <= 48; ++i) {
    const float angle = 0.4f + (2 * pi - 0.9f) * float(i) / 48;
    sector.push_back(0.075f * vec2(std::cos(angle), std::sin(angle)));
  }
  Mesh wheel, rind, wedge;
  add_extrusion(wheel, sector, 0, 0.05f);
  for (vec2& p : sector) p *= 1.02f;
  add_extrusion(rind, sector, 0, 0.0015f);
  const mat4 lying = at * moved({0, 0.02f, 0}) * turned(-pi / 2, {1, 0, 0});
  place(scene, "cheese plate", m.stoneware, plate(0.118f), at);
  place(scene, "cheese", m.cheese, wheel, lying);
  place(scene, "cheese rind", m.rind, rind, lying * moved({0, 0, 0.05f}));
  add_extrusion(wedge, profile({0, 0, 70, -15, 75, 0, 70, 15}), 0, 0.05f);
  place(scene, "cheese wedge", m.cheese, wedge, lying * moved({0.03f, -0.004f, -0.003f}) * turned(-0.1f, {0, 0, 1}));
}

void add_dome(Scene& scene, const Materials& m, const mat4& at) {
  place(scene, "round tray", m.old_silver, plate(0.15f), at);
  Mesh dome = turned_shape(profile({0,   0,  120, 0, 126, 4, 122, 10, 119, 30, 105, 75, 70,
                                    110, 25, 127, 6, 130, 6, 140, 14, 150, 9,  163, 0,  166}),
                           72, 5);
  place(scene, "dome", m.bright_silver, dome, at * moved({0, 0.012f, 0}));
}

void add_rolls(Scene& scene, const Materials& m, const mat4& at) {
  place(scene, "basket", m.wicker, basket(0.11f, 0.07f), at);
  for (uint32_t i = 0; i < 8; ++i) {
    Mesh roll;
    add_pillow(roll, vec3(0), {0.042f, 0.028f, 0.034f}, 2.3f, 28, 16, 0.12f, i);
    const float angle = 2 * pi * float(i) / 5, radius = i < 5 ? 0.055f : 0.028f;
    place(scene, "roll", m.crust, roll,
          at * moved({radius * std::sin(angle), i < 5 ? 0.045f : 0.085f, radius * std::cos(angle)}) *
              turned_y(angle + jitter(0.5f, i, 6)) * turned(jitter(0.3f, i, 7), {0, 0, 1}));
  }
}

void add_cherries(Scene& scene, const Materials& m, const mat4& at) {
  place(scene, "cherry bowl", m.celadon, bowl(0.075f, 0.06f), at);
  Mesh fruit, stalks;
  for (uint32_t i = 0; i < 26; ++i) {
    const float angle = 2.4f * float(i), r = 0.056f * std::sqrt((float(i % 14) + 0.5f) / 14),
                lift = i < 14 ? 0.046f : 0.061f;
    const vec3 c((i < 14 ? 1.0f : 0.7f) * r * std::sin(angle), lift - 2.5f * r * r,
                 (i < 14 ? 1.0f : 0.7f) * r * std::cos(angle));
    add_sphere(fruit, c, 0.0105f, 14, 9);
    if (i % 2)
      add_tube(stalks,
               bent({c + vec3(0, 0.009f, 0), c + vec3(jitter(0.01f, i, 1), 0.025f, jitter(0.01f, i, 2)),
                     c + vec3(jitter(0.03f, i, 3), 0.036f, jitter(0.03f, i, 4))},
                    7),
               0.0007f, 6);
  }
  place(scene, "cherries", m.cherry, fruit, at);
  place(scene, "cherry stalks", m.stalk, stalks, at);
}

void add_mill(Scene& scene, const Materials& m, const mat4& at, int material) {
  place(scene, "mill", material,
        turned_shape(profile({0, 0, 26, 0, 28, 6, 22, 20, 24, 45, 16, 75, 18, 100, 24, 112, 20, 135, 8, 145, 0, 146}),
                     36),
        at);
  Mesh knob;
  add_sphere(knob, {0, 0.152f, 0}, 0.008f, 20, 12);
  add_torus(knob, {0, 0.102f, 0}, {0, 1, 0}, 0.019f, 0.002f, 36, 8);
  place(scene, "mill fittings", m.brass, knob, at);
}

/// Things that stand between the places, from near to far.
void add_table_things(Scene& scene, const Materials& m) {
  add_coffee_tray(scene, m, on_table(0, 0.62f, 0.1f));
  // Right before the sitter: a bottle on the left, a goblet and a mill on the right.
  add_bottle(scene, m, on_table(-0.215f, 1.0f, 0.5f), BottleShape::straight, m.green_bottle, 0);
  place(scene, "goblet", m.gold, goblet(0.175f), on_table(0.2f, 0.93f));
  add_mill(scene, m, on_table(0.29f, 0.87f), m.ebony);
  add_mill(scene, m, on_table(0.35f, 0.91f), m.bone);
  add_grapes(scene, m, on_table(-0.14f, 0.84f, -1.0f), m.dark_grape, 52, 1);
  add_grapes(scene, m, on_table(-0.01f, 0.88f, 1.25f), m.green_grape, 46, 2);
  add_fruit(scene, m, on_table(0.1f, 0.8f), 4, 91);
  add_fruit(scene, m, on_table(0.175f, 0.79f), 0, 92);
  // Between the first and the second places.
  add_bottle(scene, m, on_table(-0.31f, 0.33f, 0.2f), BottleShape::sloping, m.brown_bottle, 1);
  add_bottle(scene, m, on_table(-0.4f, 0.27f, 0.9f), BottleShape::straight, m.black_lacquer, 2);
  add_bottle(scene, m, on_table(-0.27f, 0.22f), BottleShape::flask, m.blue_bottle, 3);
  place(scene, "copper jug", m.copper, jug(0.22f), on_table(0.225f, 0.345f, -2.2f));
  add_bread(scene, m, on_table(0.385f, 0.26f, 0.55f));
  // Between the second and the third.
  add_dome(scene, m, on_table(-0.385f, -0.415f));
  add_cheese(scene, m, on_table(0.43f, -0.43f, 0.4f));
  place(scene, "tall jug", m.stoneware, jug(0.24f), on_table(0.235f, -0.36f, 0.7f));
  add_bottle(scene, m, on_table(-0.23f, -0.3f, 0.4f), BottleShape::sloping, m.red_lacquer, 5);
  // On the cloth.
  add_samovar(scene, m, on_table(0.05f, -0.8f, 0.25f));
  add_rolls(scene, m, on_table(-0.11f, -0.615f) * scaled(vec3(0.78f)));
  add_cherries(scene, m, on_table(0.2f, -0.63f));
  add_bottle(scene, m, on_table(-0.2f, -0.93f, 0.3f), BottleShape::straight, m.clay_bottle, 6);
}

void add_places(Scene& scene, const Materials& m) {
  uint32_t id = 0;
  const float seats[] = {0.6f, -0.08f, -0.79f};
  for (const float z : seats) {
    for (const float s : {-1.0f, 1.0f}) {
      ++id;
      const float turn = s * pi / 2 + jitter(0.08f, id, 30), x = s * (0.385f + jitter(0.012f, id, 31));
      add_setting(scene, m, on_table(x, z + jitter(0.015f, id, 32), turn), id);
      add_chair(scene, m,
                moved({s * (0.82f + jitter(0.07f, id, 33)), 0, z}) * turned_y(s * pi / 2 + jitter(0.2f, id, 34)));
    }
  }
  add_setting(scene, m, on_table(0.02f, -1.15f, pi), 9);
  add_chair(scene, m, moved({0.04f, 0, -1.62f}) * turned_y(pi + 0.12f));
}

// --- The sideboard at the far wall.

void add_sideboard(Scene& scene, const Materials& m) {
  const float z = back + 0.04f, top = 0.9f;
  Mesh body, slab, knobs;
  add_chamfered_box(body, {-0.95f, 0.2f, z}, {0.95f, top - 0.03f, z + 0.42f}, 0.006f);
  for (int i = 0; i < 4; ++i) {
    const float x = -0.93f + 0.47f * float(i);
    Mesh door;
    add_panel(door, {x, 0.24f}, {0.45f, 0.42f});
    add_panel(door, {x, 0.68f}, {0.45f, 0.17f});
    append(body, door, moved({0, 0, z + 0.415f}));
    add_sphere(knobs, {x + 0.4f, 0.48f, z + 0.47f}, 0.013f, 12, 8);
    add_sphere(knobs, {x + 0.225f, 0.765f, z + 0.45f}, 0.012f, 12, 8);
  }
  for (const float x : {-0.88f, 0.88f}) {
    for (const float at : {z + 0.06f, z + 0.36f})
      add_lathe(body, {x, 0, at}, smooth(profile({0, 0, 20, 0, 30, 80, 40, 210})), 20);
  }
  add_chamfered_box(slab, {-1.0f, top - 0.03f, z - 0.02f}, {1.0f, top, z + 0.47f}, 0.006f);
  place(scene, "sideboard", m.sideboard, body, mat4(1));
  place(scene, "sideboard top", m.marble, slab, mat4(1));
  place(scene, "knobs", m.old_brass, knobs, mat4(1));
}

Mesh urn() {
  Mesh mesh = turned_shape(
      hollow(profile({0, 0, 50, 0, 55, 8, 30, 25, 35, 50, 85, 130, 90, 200, 60, 270, 45, 310, 60, 350}), 0.004f, 0.1f),
      32);
  for (const float s : {-1.0f, 1.0f})
    add_tube(mesh,
             bent({{s * 0.085f, 0.2f, 0}, {s * 0.125f, 0.24f, 0}, {s * 0.11f, 0.31f, 0}, {s * 0.055f, 0.325f, 0}}, 24),
             0.006f, 12);
  return mesh;
}

void add_sideboard_things(Scene& scene, const Materials& m) {
  const auto at = [](float x, float z, float turn = 0) { return moved({x, 0.9f, back + 0.04f + z}) * turned_y(turn); };
  place(scene, "urn", m.cobalt, urn(), at(-0.8f, 0.2f, 0.4f));
  place(scene, "urn", m.bronze, urn(), at(0.8f, 0.2f, -0.3f));
  add_candelabrum(scene, m, at(-0.48f, 0.18f, 0.2f), m.old_brass, 3);
  add_candelabrum(scene, m, at(0.5f, 0.18f, 0.5f), m.iron, 3);
  for (int i = 0; i < 4; ++i)
    place(scene, "stacked plate", m.porcelain, plate(0.12f),
          at(-0.2f + 0.004f * float(i % 2), 0.2f) * moved({0, 0.009f * float(i), 0}));
  // A dish that leans against the wall.
  place(scene, "dish", m.hammered_copper, plate(0.22f),
        at(0.12f, 0.09f) * moved({0, 0.215f, 0}) * turned(1.3f, {1, 0, 0}));
  place(scene, "jug", m.pewter, jug(0.2f), at(0.3f, 0.3f, 1.8f));
  add_bottle(scene, m, at(-0.62f, 0.33f, 0.1f), BottleShape::straight, m.green_bottle, 4);
  add_bottle(scene, m, at(-0.35f, 0.34f, -0.4f), BottleShape::flask, m.brown_bottle, 8);
  place(scene, "bowl", m.stoneware, bowl(0.11f, 0.08f), at(0.05f, 0.28f));
  for (uint32_t i = 0; i < 3; ++i)
    add_fruit(scene, m,
              at(0.05f + 0.05f * std::sin(2.1f * float(i)), 0.28f + 0.05f * std::cos(2.1f * float(i))) *
                  moved({0, 0.028f, 0}),
              i, 60 + i);
  for (uint32_t i = 0; i < 3; ++i)
    place(scene, "goblet", i % 2 ? m.copper : m.old_silver, goblet(0.15f),
          at(0.6f + 0.085f * float(i), 0.36f, float(i)));
}

Scene make(const ParameterValues&) {
  Scene scene;
  const Materials m = add_materials(scene);
  add_room(scene, m);
  add_table(scene, m);
  add_cloth(scene, m);
  add_places(scene, m);
  add_centrepieces(scene, m);
  add_table_things(scene, m);
  add_sideboard(scene, m);
  add_sideboard_things(scene, m);
  scene.cameras = {looking_at("main", {0.05f, 1.19f, 1.4f}, {0.0f, 0.83f, 0.1f}, 68),
                   looking_at("guest", {0.92f, 1.17f, 0.05f}, {-0.25f, 0.82f, -0.12f}, 72),
                   looking_at("tray", {-0.55f, 1.08f, 0.76f}, {0.04f, 0.8f, 0.55f}, 58)};
  scene.light.to_sun = {-1.0f, 0.62f, 0.32f};
  scene.light.sun = {4.3f, 3.75f, 2.95f};
  scene.light.sun_angle_degrees = 0.5f;  // the window bars shall throw shadows on the table
  scene.light.zenith = {0.32f, 0.37f, 0.45f};
  scene.light.horizon = {0.52f, 0.54f, 0.55f};
  scene.light.ground = {0.20f, 0.175f, 0.145f};
  scene.ao_radius = 0.2;
  return scene;
}

}  // namespace

std::vector<SceneRecipe> banquet() {
  return {{.name = "banquet",
           .summary = "a laid table: silver, lacquer, bottles, fruit and bread on polished wood, close to the eyes",
           .kind = "object",
           .make = make}};
}

}  // namespace gloam::scenes
