// A glade: trees, bushes and ferns whose every leaf is geometry, over ground with stones.
#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "scene/built_in/mesh_builder.h"
#include "scene/built_in/tube.h"

namespace gloam::scenes {
namespace {

constexpr float pi = glm::pi<float>();

float ground_height(float x, float z) {
  return 0.14f * std::sin(0.55f * x + 0.3f) * std::cos(0.48f * z - 0.7f) + 0.05f * std::sin(1.7f * x - 1.1f * z) +
         0.02f * std::sin(4.3f * x + 2.9f * z) * std::sin(3.7f * z - 1.3f * x);
}

vec3 on_ground(float x, float z) { return {x, ground_height(x, z), z}; }

/// A leaf folded along its midrib and bent down: four one-sided triangles. `along` and `up` are unit.
void add_leaf(Mesh& mesh, vec3 root, vec3 along, vec3 up, float length, float width) {
  const vec3 across = glm::normalize(glm::cross(along, up)), above = glm::cross(across, along);
  const vec3 middle = root + 0.5f * length * along, lift = 0.22f * width * above;
  const vec3 points[5] = {root, middle - 0.5f * width * across + lift, middle, middle + 0.5f * width * across + lift,
                          root + length * along - 0.18f * length * above};
  const vec3 normals[5] = {above, glm::normalize(above + 0.35f * across), above, glm::normalize(above - 0.35f * across),
                           glm::normalize(above + 0.3f * along)};
  const unsigned first = unsigned(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), points, points + 5);
  mesh.normals.insert(mesh.normals.end(), normals, normals + 5);
  for (const glm::uvec3 t : {glm::uvec3(0, 2, 1), glm::uvec3(2, 4, 1), glm::uvec3(0, 3, 2), glm::uvec3(2, 3, 4)})
    mesh.triangles.push_back(first + t);
}

/// How a plant branches, from the trunk (level 0) to the twigs that bear leaves.
struct Habit {
  int levels = 4;                            ///< at most 4
  int children[3] = {9, 7, 8};               ///< branches that leave one of a level
  float shortening[3] = {0.5f, 0.5f, 0.5f};  ///< their length by the parent's
  float spread = 0.9f;                       ///< angle between parent and branch, radians
  float crook = 0.14f;                       ///< how much a branch turns per piece
  float rise = 0.12f;                        ///< how much it turns upward
  int trunk_sides = 14, limb_sides = 8;
  float bare = 0.35f;  ///< share of the trunk without branches
  int leaves = 15;     ///< on a twig
  float leaf_length = 0.115f, leaf_width = 0.06f;
};

struct Plant {
  Mesh wood, leaves[2];  ///< two kinds of leaves, for two materials
};

void add_leaves(Plant& plant, const Habit& habit, const std::vector<vec3>& twig, uint32_t seed) {
  for (int i = 0; i < habit.leaves; ++i) {
    const uint32_t at = uint32_t(i);
    const float t = 0.15f + 0.85f * (float(i) + 0.5f) / float(habit.leaves);
    const float place = t * float(twig.size() - 1);
    const size_t piece = std::min(size_t(place), twig.size() - 2);
    const vec3 root = glm::mix(twig[piece], twig[piece + 1], place - float(piece));
    const vec3 axis = glm::normalize(twig[piece + 1] - twig[piece]);
    const vec3 side = glm::normalize(glm::cross(axis, vec3(0.03f, 1, 0.01f))) * (i % 2 ? 1.0f : -1.0f);
    const vec3 along =
        glm::normalize(0.7f * side + 0.6f * axis + 0.45f * random_direction(seed, at + 500) + vec3(0, -0.15f, 0));
    const vec3 up = glm::normalize(vec3(0, 1, 0) + 0.5f * random_direction(seed, at + 900));
    const float size = random_in(0.7f, 1.2f, seed, at, 31);
    add_leaf(plant.leaves[hash01(seed, at, 32) < 0.3f], root, along, up, size * habit.leaf_length,
             size * habit.leaf_width);
  }
}

void add_branch(Plant& plant, const Habit& habit, int level, vec3 root, vec3 direction, float length, float radius,
                uint32_t seed) {
  const int pieces = level == 0 ? 10 : level == 1 ? 7 : level == habit.levels - 1 ? 3 : 5;
  std::vector<vec3> points = {root};
  std::vector<float> radii = {radius * (level == 0 ? 1.35f : 1.0f)};
  for (int i = 1; i <= pieces; ++i) {
    direction = glm::normalize(direction + habit.crook * random_direction(seed, uint32_t(i)) +
                               vec3(0, level == 0 ? 0 : habit.rise, 0));
    points.push_back(points.back() + length / float(pieces) * direction);
    radii.push_back(radius * (1 - 0.75f * float(i) / float(pieces)));
  }
  const bool twig = level >= std::min(habit.levels - 1, int(std::size(habit.children)));
  add_tube(plant.wood, points, radii, twig ? 3 : level == 0 ? habit.trunk_sides : level == 1 ? habit.limb_sides : 5);
  if (twig) {
    add_leaves(plant, habit, points, seed);
    return;
  }
  const float bare = level == 0 ? habit.bare : 0.2f;
  const float golden = 2.39996f;  // the angle from branch to branch
  const int count = habit.children[level];
  for (int child = 0; child < count; ++child) {
    const float t = bare + (1 - bare) * (float(child) + 0.7f) / float(count);
    const float place = std::min(t, 0.999f) * float(pieces);
    const size_t piece = size_t(place);
    const vec3 axis = glm::normalize(points[piece + 1] - points[piece]), x = perpendicular(axis);
    const float angle = golden * float(child) + random_in(-0.4f, 0.4f, seed, uint32_t(child), 41);
    const float spread = habit.spread * random_in(0.75f, 1.15f, seed, uint32_t(child), 42) * (1.2f - 0.45f * t);
    const vec3 out = std::cos(angle) * x + std::sin(angle) * glm::cross(axis, x);
    const vec3 towards = std::cos(spread) * axis + std::sin(spread) * out;
    const float shorter =
        habit.shortening[level] * (1.25f - 0.6f * t) * random_in(0.8f, 1.2f, seed, uint32_t(child), 43);
    add_branch(plant, habit, level + 1, glm::mix(points[piece], points[piece + 1], place - float(piece)), towards,
               length * shorter, std::max(0.0025f, 0.55f * radii[piece]), seed * 31 + uint32_t(child) + 1);
  }
}

/// Adds a plant's meshes that are not empty.
void add_plant(Scene& scene, const std::string& name, Plant&& plant, int wood, int leaf, int second_leaf) {
  const auto add = [&](Mesh& mesh, const char* part, int material) {
    if (mesh.triangles.empty()) return;
    mesh.name = fmt::format("{} {}", name, part);
    mesh.material = material;
    scene.meshes.push_back(std::move(mesh));
  };
  add(plant.wood, "wood", wood);
  add(plant.leaves[0], "leaves", leaf);
  add(plant.leaves[1], "young leaves", second_leaf);
}

struct Materials {
  int soil, stone, moss, bark, birch, stem, oak, oak_young, birch_leaf, birch_young, bush, bush_young, fern, fern_old,
      grass, litter;
};

Materials add_materials(Scene& scene) {
  Materials m;
  m.soil = add_material(scene, "forest soil", {0.27f, 0.2f, 0.13f}, 1);
  m.stone = add_material(scene, "stone", {0.45f, 0.44f, 0.41f}, 0.85f);
  m.moss = add_material(scene, "mossy stone", {0.26f, 0.32f, 0.16f}, 1);
  m.bark = add_material(scene, "bark", {0.27f, 0.2f, 0.14f}, 0.95f);
  m.birch = add_material(scene, "birch bark", {0.66f, 0.63f, 0.57f}, 0.7f);
  m.stem = add_material(scene, "green stem", {0.33f, 0.29f, 0.16f}, 0.8f);
  m.oak = add_material(scene, "oak leaf", {0.17f, 0.31f, 0.08f}, 0.5f);
  m.oak_young = add_material(scene, "young oak leaf", {0.36f, 0.47f, 0.13f}, 0.45f);
  m.birch_leaf = add_material(scene, "birch leaf", {0.32f, 0.45f, 0.12f}, 0.4f);
  m.birch_young = add_material(scene, "yellow birch leaf", {0.6f, 0.55f, 0.14f}, 0.45f);
  m.bush = add_material(scene, "bush leaf", {0.13f, 0.26f, 0.1f}, 0.3f);
  m.bush_young = add_material(scene, "red bush leaf", {0.45f, 0.18f, 0.1f}, 0.35f);
  m.fern = add_material(scene, "fern", {0.24f, 0.42f, 0.12f}, 0.6f);
  m.fern_old = add_material(scene, "old fern", {0.47f, 0.36f, 0.15f}, 0.8f);
  m.grass = add_material(scene, "grass", {0.3f, 0.42f, 0.15f}, 0.6f);
  m.litter = add_material(scene, "leaf litter", {0.42f, 0.27f, 0.13f}, 0.9f);
  return m;
}

void add_tree(Scene& scene, const Materials& m, const std::string& name, bool birch, float x, float z, float height,
              uint32_t seed) {
  Habit habit;
  if (birch) {
    habit.children[0] = 13;
    habit.children[1] = 6;
    habit.children[2] = 6;
    habit.shortening[0] = 0.36f;
    habit.rise = -0.03f;  // twigs hang
    habit.leaf_length = 0.085f;
    habit.leaf_width = 0.06f;
    habit.leaves = 13;
  }
  Plant plant;
  const vec3 lean = glm::normalize(vec3(random_in(-0.08f, 0.08f, seed, 1), 1, random_in(-0.08f, 0.08f, seed, 2)));
  add_branch(plant, habit, 0, on_ground(x, z) - vec3(0, 0.15f, 0), lean, height, (birch ? 0.018f : 0.03f) * height,
             seed);
  add_plant(scene, name, std::move(plant), birch ? m.birch : m.bark, birch ? m.birch_leaf : m.oak,
            birch ? m.birch_young : m.oak_young);
}

/// Several stems from one root, branching from the ground up.
void add_bush(Scene& scene, const Materials& m, int number, float x, float z, float height, uint32_t seed) {
  Habit habit;
  habit.levels = 3;
  habit.trunk_sides = 6;
  habit.limb_sides = 4;
  habit.children[0] = 9;
  habit.children[1] = 4;
  habit.shortening[0] = 0.5f;
  habit.shortening[1] = 0.55f;
  habit.bare = 0.12f;
  habit.leaves = 14;
  habit.leaf_length = 0.075f * (0.6f + 0.4f * height);
  habit.leaf_width = 0.55f * habit.leaf_length;
  Plant plant;
  for (uint32_t stem = 0; stem < 5; ++stem) {
    const float angle = 2 * pi * (float(stem) + hash01(seed, stem)) / 5;
    const vec3 out(std::cos(angle), 0, std::sin(angle));
    add_branch(plant, habit, 0, on_ground(x, z) + 0.06f * out - vec3(0, 0.04f, 0),
               glm::normalize(vec3(0, 1, 0) + random_in(0.25f, 0.75f, seed, stem, 1) * out),
               height * random_in(0.75f, 1.1f, seed, stem, 2), 0.014f, seed * 17 + stem);
  }
  const bool red = number % 3 == 1;
  add_plant(scene, fmt::format("bush {}", number), std::move(plant), m.stem, red ? m.oak : m.bush,
            red ? m.bush_young : m.oak_young);
}

/// A rosette of arching fronds with two rows of leaflets each.
void add_fern(Scene& scene, const Materials& m, int number, vec3 root, float size, uint32_t seed) {
  Plant plant;
  const int fronds = 11, leaflets = 24;
  for (int frond = 0; frond < fronds; ++frond) {
    const uint32_t at = uint32_t(frond);
    const float angle = 2 * pi * (float(frond) + 0.6f * hash01(seed, at)) / fronds;
    const float length = size * random_in(0.75f, 1.1f, seed, at, 1), reach = random_in(0.75f, 1, seed, at, 2);
    const vec3 out(std::cos(angle), 0, std::sin(angle));
    const auto rib = [&](float t) {
      return root + length * (reach * (0.3f * t + 0.6f * t * t) * out + vec3(0, 1.25f * t - 0.95f * t * t, 0));
    };
    std::vector<vec3> points;
    std::vector<float> radii;
    for (int i = 0; i <= 10; ++i) {
      points.push_back(rib(float(i) / 10));
      radii.push_back(0.005f * size * (1.1f - float(i) / 10));
    }
    add_tube(plant.wood, points, radii, 4);
    Mesh& leaves = plant.leaves[hash01(seed, at, 3) < 0.15f];
    for (int i = 0; i < leaflets; ++i) {
      const float t = 0.12f + 0.88f * float(i) / leaflets;
      const vec3 axis = glm::normalize(rib(t + 0.02f) - rib(t));
      const vec3 across = glm::normalize(glm::cross(axis, vec3(0, 1, 0)));
      const float long_side = length * 0.24f * std::pow(1.0f - t, 0.7f) * std::min(1.0f, 4 * t) + 0.01f;
      for (const float side : {-1.0f, 1.0f}) {
        const vec3 along =
            glm::normalize(side * across + 0.45f * axis + 0.12f * random_direction(seed + at, uint32_t(i)));
        add_leaf(leaves, rib(t), along, glm::normalize(glm::cross(across, axis)), long_side,
                 0.026f * size + 0.1f * long_side);
      }
    }
  }
  add_plant(scene, fmt::format("fern {}", number), std::move(plant), m.stem, m.fern, m.fern_old);
}

/// A rounded stone: a sphere pushed in and out by a few waves.
void add_stone(Scene& scene, const Materials& m, int number, vec3 centre, float size, uint32_t seed) {
  Mesh& mesh = add_mesh(scene, fmt::format("stone {}", number), number % 3 == 0 ? m.moss : m.stone);
  vec3 waves[4];
  for (uint32_t i = 0; i < 4; ++i) waves[i] = random_in(1.5f, 3.5f, seed, i, 1) * random_direction(seed, i);
  const vec3 stretch(random_in(0.8f, 1.3f, seed, 5), random_in(0.45f, 0.8f, seed, 6), random_in(0.8f, 1.2f, seed, 7));
  const int columns = size > 0.2f ? 36 : 16;
  add_surface(
      mesh,
      [&](float u, float v) {
        const float angle = 2 * pi * u, polar = pi * v;
        const vec3 out(std::sin(polar) * std::sin(angle), -std::cos(polar), std::sin(polar) * std::cos(angle));
        float radius = 1;
        for (uint32_t i = 0; i < 4; ++i) radius += 0.07f * std::sin(glm::dot(waves[i], out) * 1.6f + float(i));
        return centre + size * radius * stretch * out;
      },
      columns, columns / 2);
  // The rows at the poles are points: half of their triangles have no area, and differences give no normal.
  std::erase_if(mesh.triangles, [&](glm::uvec3 t) {
    const vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    return glm::length(glm::cross(b - a, c - a)) < 1e-6f * size * size;
  });
  for (int i = 0; i <= columns; ++i) {
    mesh.normals[size_t(i)] = {0, -1, 0};
    mesh.normals[mesh.normals.size() - 1 - size_t(i)] = {0, 1, 0};
  }
}

void add_ground(Scene& scene, const Materials& m) {
  add_surface(
      add_mesh(scene, "ground", m.soil), [](float u, float v) { return on_ground(-24 + 48 * u, 14 - 40 * v); }, 120,
      100);
  for (uint32_t i = 0; i < 90; ++i) {
    const float size = i < 9 ? random_in(0.22f, 0.5f, i, 1) : random_in(0.03f, 0.13f, i, 1);
    const float x = random_in(-6, 6, i, 2), z = random_in(-8, 3.4f, i, 3);
    add_stone(scene, m, int(i), on_ground(x, z) + vec3(0, 0.15f * size, 0), size, 700 + i);
  }
  Mesh& litter = add_mesh(scene, "leaf litter", m.litter);
  for (uint32_t i = 0; i < 9000; ++i) {
    const vec3 place = on_ground(random_in(-8, 8, i, 11), random_in(-11, 4.5f, i, 12));
    const float angle = random_in(0, 2 * pi, i, 13), size = random_in(0.05f, 0.1f, i, 14);
    const vec3 along = glm::normalize(vec3(std::cos(angle), random_in(0, 0.25f, i, 15), std::sin(angle)));
    const vec3 up = glm::normalize(vec3(0, 1, 0) + 0.35f * random_direction(i, 16));
    add_leaf(litter, place + vec3(0, 0.02f, 0), along, up, size, 0.5f * size);
  }
}

void add_grass(Scene& scene, const Materials& m) {
  for (int patch = 0; patch < 40; ++patch) {
    const uint32_t seed = 3000 + uint32_t(patch);
    Mesh& mesh = add_mesh(scene, fmt::format("grass {}", patch), m.grass);
    const float x = random_in(-7, 7, seed, 1), z = random_in(-9, 3, seed, 2);
    for (uint32_t blade = 0; blade < 300; ++blade) {
      const float angle = random_in(0, 2 * pi, seed, blade, 3), away = std::sqrt(hash01(seed, blade, 4));
      const float turn = random_in(0, 2 * pi, seed, blade, 5), lean = random_in(0.03f, 0.16f, seed, blade, 6);
      add_blade(mesh, on_ground(x + 0.9f * away * std::cos(angle), z + 0.9f * away * std::sin(angle)),
                lean * vec3(std::cos(turn), 0, std::sin(turn)), random_in(0.1f, 0.34f, seed, blade, 7), 0.008f, 3);
    }
  }
}

Scene make(const ParameterValues&) {
  Scene scene;
  const Materials m = add_materials(scene);
  add_ground(scene, m);
  add_grass(scene, m);
  add_tree(scene, m, "oak 0", false, -2.5f, -1.6f, 5.2f, 11);
  add_tree(scene, m, "oak 1", false, 3.6f, -4.5f, 6.0f, 12);
  add_tree(scene, m, "oak 2", false, -5.6f, -7.0f, 6.5f, 13);
  add_tree(scene, m, "birch 0", true, 1.7f, -2.2f, 5.5f, 21);
  add_tree(scene, m, "birch 1", true, -0.6f, -6.0f, 6.8f, 22);
  add_tree(scene, m, "birch 2", true, 6.6f, -7.5f, 7.0f, 23);
  const vec2 bushes[] = {{-4.3f, -2.8f}, {0.2f, -4.0f}, {4.6f, -1.8f}, {2.6f, -6.4f},  {-2.6f, -5.2f},
                         {-7.5f, -5.0f}, {7.8f, -4.6f}, {0.9f, -8.6f}, {-4.4f, -9.2f}, {5.4f, -9.6f}};
  for (int i = 0; i < 10; ++i) {
    const uint32_t seed = 40 + uint32_t(i);
    add_bush(scene, m, i, bushes[i].x, bushes[i].y, random_in(1, 1.6f, seed), seed);
  }
  for (int i = 0; i < 5; ++i) {  // a thicket behind the glade
    const uint32_t seed = 80 + uint32_t(i);
    const float x = -8 + 4 * float(i) + random_in(-0.6f, 0.6f, seed, 1);
    add_bush(scene, m, 10 + i, x, -11 - random_in(0, 2, seed, 2), random_in(2.2f, 3.2f, seed, 3), seed);
  }
  const vec2 ferns[] = {{-0.9f, 1.1f},  {1.3f, 0.4f},   {0.1f, -0.9f},  {-1.7f, -0.4f}, {2.6f, -0.9f}, {-3.2f, 0.2f},
                        {0.9f, -2.9f},  {-1.2f, -2.7f}, {3.4f, 0.8f},   {-4.6f, -1.2f}, {2.1f, -4.2f}, {-2.1f, 1.9f},
                        {-0.3f, -4.9f}, {5.0f, -3.2f},  {-3.4f, -4.0f}, {0.45f, 1.75f}};
  for (int i = 0; i < 34; ++i) {
    const uint32_t seed = 160 + uint32_t(i);
    const vec2 place = i < 16 ? ferns[i] : vec2(random_in(-7, 7, seed, 1), random_in(-9.5f, -1, seed, 2));
    add_fern(scene, m, i, on_ground(place.x, place.y), random_in(0.5f, 0.95f, seed), seed);
  }
  scene.cameras = {looking_at("main", {0.3, 1.5, 4.4}, {-0.1, 1.35, -3}, 68),
                   looking_at("close", {0.55, 0.75, 2.55}, {-0.35, 0.3, 0.6}, 55),
                   looking_at("canopy", {-1.2, 0.9, 0.6}, {-1.6, 4.0, -2.2}, 75)};
  scene.ao_radius = 0.3;
  scene.light.to_sun = {0.45f, 0.85f, 0.5f};
  return scene;
}

}  // namespace

std::vector<SceneRecipe> foliage() {
  return {{.name = "foliage",
           .summary = "a glade with trees, bushes and ferns: every leaf is geometry",
           .kind = "thin",
           .parameters = {},
           .make = make}};
}

}  // namespace gloam::scenes
