#include "loggia.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "base/low_discrepancy.h"

namespace gloam::analytic {
namespace {

using glm::dvec3;
using glm::vec3;

// Base colours, scene-linear.
const vec3 plaster(0.72f, 0.62f, 0.48f), ceiling_plaster(0.66f, 0.60f, 0.50f), limestone(0.70f, 0.66f, 0.58f);
const vec3 terracotta(0.46f, 0.19f, 0.10f), sand(0.62f, 0.50f, 0.35f), grout(0.30f, 0.26f, 0.21f);
const vec3 walnut(0.22f, 0.11f, 0.055f), oak(0.42f, 0.26f, 0.13f), pine(0.55f, 0.36f, 0.18f),
    iron(0.05f, 0.05f, 0.055f);
const vec3 door_green(0.07f, 0.19f, 0.17f), glaze_blue(0.06f, 0.17f, 0.36f), cream(0.76f, 0.71f, 0.60f);
const vec3 leaf(0.10f, 0.22f, 0.05f), orange(0.80f, 0.28f, 0.03f), lemon(0.82f, 0.62f, 0.08f),
    apple(0.52f, 0.06f, 0.05f);
const vec3 bottle_green(0.05f, 0.16f, 0.08f), rug_red(0.42f, 0.08f, 0.07f), rug_blue(0.10f, 0.15f, 0.28f);

/// Adds solids in the coordinates of a piece of furniture, which is moved and turned about y.
struct Group {
  Scene& scene;
  double yaw = 0;
  dvec3 at{0.0};

  void add(const Solid& solid, const vec3& albedo, std::vector<Solid> cuts = {}) const {
    for (Solid& cut : cuts) cut = placed(cut, yaw, at);
    scene.add(placed(solid, yaw, at), albedo, cuts);
  }
  void box(const dvec3& low, const dvec3& high, const vec3& albedo) const { add(make_box(low, high), albedo); }
  void sphere(const dvec3& centre, double radius, const vec3& albedo) const {
    add(make_sphere(centre, radius), albedo);
  }
  void rod(const dvec3& from, const dvec3& to, double radius, const vec3& albedo) const {
    add(make_frustum(from, to, radius, radius), albedo);
  }
  void cone(const dvec3& from, const dvec3& to, double radius_from, double radius_to, const vec3& albedo) const {
    add(make_frustum(from, to, radius_from, radius_to), albedo);
  }
};

/// In [0,1), the same on every machine.
double random_unit(uint32_t i) { return (hash(i) >> 8) * 0x1p-24; }

constexpr double room_left = -2.4, room_right = 2.4, room_back = -3.0, room_front = 4.5, room_height = 3.0;

/// Tiles with open joints: 12 mm deep, 14 mm wide.
void add_floor(const Group& room) {
  constexpr double pitch = 0.6, joint = 0.014, depth = 0.012;
  room.box({room_left, -0.3, room_back}, {room_right, -depth, room_front}, grout);
  for (int ix = 0; ix < 8; ++ix) {
    for (int iz = 0; iz < 13; ++iz) {
      const dvec3 low(room_left + ix * pitch + joint / 2, -depth - 0.01, room_back + iz * pitch + joint / 2);
      const float tint = 0.9f + 0.2f * float(random_unit(uint32_t(100 + 16 * iz + ix)));
      const vec3 colour = (ix + iz) % 2 ? sand : terracotta;
      if (low.z < room_front) room.box(low, low + dvec3(pitch - joint, depth + 0.01, pitch - joint), colour * tint);
    }
  }
}

/// An opening with a round head through a wall that faces z.
std::vector<Solid> arched_opening_z(double x, double half_width, double y0, double spring, double z0, double z1) {
  return {make_box({x - half_width, y0, z0}, {x + half_width, spring, z1}),
          make_frustum({x, spring, z0}, {x, spring, z1}, half_width, half_width)};
}

/// A window to the sea, a door at the head of the stairs, and a niche.
void add_back_wall(const Group& room) {
  std::vector<Solid> cuts = arched_opening_z(0.62, 0.62, 0.92, 1.75, -3.5, -2.5);
  for (const Solid& cut : arched_opening_z(-1.9, 0.36, 1.44, 2.42, -3.16, -2.5)) cuts.push_back(cut);
  for (const Solid& cut : arched_opening_z(-0.72, 0.24, 0.95, 1.45, -3.2, -2.5)) cuts.push_back(cut);
  room.add(make_box({-2.7, -0.3, -3.3}, {2.4, 3.3, room_back}), plaster, cuts);

  room.box({-0.1, 0.86, -3.34}, {1.34, 0.92, -2.9}, limestone);  // sill
  for (const double x : {0.31, 0.62, 0.93}) room.rod({x, 0.92, -3.15}, {x, 2.3, -3.15}, 0.011, iron);
  for (const double y : {1.25, 1.75}) room.rod({0.0, y, -3.15}, {1.24, y, -3.15}, 0.011, iron);

  room.box({-2.26, 1.44, -3.16}, {-1.54, 2.8, -3.12}, door_green);
  for (const double x : {-2.16, -1.86})
    for (const double y : {1.54, 2.02}) room.box({x, y, -3.13}, {x + 0.24, y + 0.4, -3.105}, door_green * 1.2f);
  room.sphere({-1.6, 1.95, -3.09}, 0.025, oak);

  room.box({-1.0, 0.9, -3.15}, {-0.44, 0.95, -2.93}, limestone);  // ledge of the niche, and a jar
  room.cone({-0.72, 0.95, -3.06}, {-0.72, 1.12, -3.06}, 0.055, 0.10, glaze_blue);
  room.cone({-0.72, 1.12, -3.06}, {-0.72, 1.24, -3.06}, 0.10, 0.045, glaze_blue);
  room.cone({-0.72, 1.24, -3.06}, {-0.72, 1.29, -3.06}, 0.045, 0.06, cream);
  room.box({-1.4, 0, -3.0}, {2.1, 0.13, -2.975}, limestone);  // skirting
}

void add_left_wall_and_ceiling(const Group& room) {
  room.box({-2.7, -0.3, -3.3}, {room_left, 3.3, room_front}, plaster);
  room.box({room_left, 0, -0.4}, {room_left + 0.025, 0.13, room_front}, limestone);
  room.box({-2.7, room_height, -3.3}, {2.6, 3.3, room_front}, ceiling_plaster);
  for (double z = -2.75; z < room_front; z += 0.62)
    room.box({room_left, 2.82, z}, {room_right, room_height, z + 0.13}, walnut);
  room.box({room_left, 2.74, room_back}, {room_left + 0.1, 2.82, room_front}, walnut);
}

void add_column(const Group& room, double x, double y, double z) {
  const Group column{room.scene, 0, {x, y, z}};
  column.box({-0.17, 0, -0.17}, {0.17, 0.07, 0.17}, limestone);
  column.rod({0, 0.07, 0}, {0, 0.11, 0}, 0.16, limestone);
  column.cone({0, 0.11, 0}, {0, 0.17, 0}, 0.145, 0.125, limestone);
  column.cone({0, 0.17, 0}, {0, 1.56, 0}, 0.115, 0.095, limestone);
  column.rod({0, 1.56, 0}, {0, 1.59, 0}, 0.115, limestone);
  column.cone({0, 1.59, 0}, {0, 1.73, 0}, 0.098, 0.16, limestone);
  column.box({-0.18, 1.73, -0.18}, {0.18, 1.80, 0.18}, limestone);
}

/// Columns on a kerb, arches over them, a thin iron railing between them.
void add_arcade(const Group& room) {
  constexpr double x = 2.25, bay = 1.7, kerb = 0.14, spring = kerb + 1.80;
  std::vector<Solid> arches;
  for (int i = 0; i < 5; ++i) {
    const double column_z = -2.85 + i * bay, middle = column_z + bay / 2;
    arches.push_back(make_frustum({1.9, spring, middle}, {2.6, spring, middle}, 0.69, 0.69));
    add_column(room, x, kerb, column_z);
    for (int k = 1; k <= 10; ++k) {
      const double z = column_z + 0.17 + k * (bay - 0.34) / 11;
      room.rod({x, kerb, z}, {x, 0.95, z}, 0.008, iron);
    }
    room.box({x - 0.022, 0.95, column_z}, {x + 0.022, 0.975, column_z + bay}, iron);
    room.box({x - 0.012, 0.22, column_z}, {x + 0.012, 0.235, column_z + bay}, iron);
  }
  room.add(make_box({2.1, spring, -3.3}, {2.4, 3.3, room_front}), plaster, arches);
  room.box({2.02, 0, -3.0}, {2.48, kerb, room_front}, limestone);
}

/// Steps against the left wall up to the door, hollowed by an arched alcove, with a thin handrail.
void add_stairs(const Group& room) {
  constexpr int steps = 8;
  constexpr double rise = 0.18, run = 0.27, start = -0.35, side = -1.42;
  const std::vector<Solid> alcove = {make_box({-2.1, -0.1, -2.86}, {-1.0, 0.62, -2.14}),
                                     make_frustum({-2.1, 0.62, -2.5}, {-1.0, 0.62, -2.5}, 0.36, 0.36)};
  for (int i = 0; i < steps; ++i) {
    const double front = start - i * run, y = i * rise;
    room.add(make_box({room_left, y - 0.03, room_back}, {side, y + rise - 0.03, front}), plaster * 0.95f, alcove);
    room.box({room_left, y + rise - 0.03, i + 1 < steps ? front - run - 0.01 : room_back},
             {side + 0.02, y + rise, front + 0.02}, limestone);
    room.rod({side - 0.05, y + rise, front - 0.1}, {side - 0.05, y + rise + 0.8, front - 0.1}, 0.009, iron);
  }
  const dvec3 foot(side - 0.05, rise + 0.8, start - 0.1), head(side - 0.05, steps * rise + 0.8, start - 0.1 - 7 * run);
  room.rod(foot, head, 0.02, walnut);
  room.rod(head, {head.x, head.y, room_back}, 0.02, walnut);
  room.rod({foot.x, 0, start + 0.12}, {foot.x, 0.98, start + 0.12}, 0.025, walnut);
  room.rod({foot.x, 0.96, start + 0.12}, foot, 0.02, walnut);
  room.sphere({foot.x, 1.02, start + 0.12}, 0.05, oak);
}

/// Half a hollow ball on a foot, filled with fruit.
void add_fruit_bowl(const Group& table, const dvec3& at) {
  const Group bowl{table.scene, table.yaw, at};
  bowl.cone({0, 0, 0}, {0, 0.03, 0}, 0.07, 0.05, glaze_blue);
  bowl.add(make_sphere({0, 0.19, 0}, 0.17), glaze_blue,
           {make_sphere({0, 0.195, 0}, 0.157), make_box({-0.3, 0.135, -0.3}, {0.3, 0.5, 0.3})});
  const vec3 colours[] = {orange, lemon, apple, orange, lemon};
  for (int i = 0; i < 5; ++i) {
    const double angle = 2 * M_PI * i / 5 + 0.4;
    bowl.sphere({0.078 * std::cos(angle), 0.115, 0.078 * std::sin(angle)}, 0.045, colours[i]);
  }
  bowl.sphere({0.005, 0.175, 0.0}, 0.045, apple);
}

void add_table(const Group& room) {
  const Group table{room.scene, 0.32, {0.72, 0, 0.35}};
  table.box({-0.66, 0.72, -0.36}, {0.66, 0.755, 0.36}, oak);
  for (const double x : {-0.58, 0.58}) {
    for (const double z : {-0.29, 0.29}) table.cone({x, 0, z}, {x, 0.72, z}, 0.016, 0.028, walnut);
    table.rod({x, 0.16, -0.29}, {x, 0.16, 0.29}, 0.011, walnut);
  }
  table.rod({-0.58, 0.16, 0}, {0.58, 0.16, 0}, 0.011, walnut);
  for (const double z : {-0.3, 0.28}) table.box({-0.56, 0.64, z}, {0.56, 0.72, z + 0.02}, walnut);
  add_fruit_bowl(table, table.at + dvec3(0.05, 0.755, -0.02));

  const dvec3 bottle = table.at + dvec3(0.40, 0.755, -0.33);
  room.rod(bottle, bottle + dvec3(0, 0.19, 0), 0.042, bottle_green);
  room.cone(bottle + dvec3(0, 0.19, 0), bottle + dvec3(0, 0.24, 0), 0.042, 0.015, bottle_green);
  room.rod(bottle + dvec3(0, 0.24, 0), bottle + dvec3(0, 0.32, 0), 0.015, bottle_green);
  const dvec3 cup = table.at + dvec3(0.42, 0.755, 0.02);
  room.add(make_frustum(cup, cup + dvec3(0, 0.09, 0), 0.03, 0.042), cream,
           {make_frustum(cup + dvec3(0, 0.008, 0), cup + dvec3(0, 0.0901, 0), 0.026, 0.038)});

  const Group books{room.scene, 0.75, table.at + dvec3(-0.40, 0.755, 0.12)};
  books.box({-0.13, 0, -0.095}, {0.13, 0.035, 0.095}, rug_red);
  const Group upper{room.scene, 0.35, books.at};
  upper.box({-0.11, 0.035, -0.08}, {0.11, 0.06, 0.08}, glaze_blue);
  upper.box({-0.10, 0.06, -0.07}, {0.09, 0.095, 0.07}, cream);
}

void add_stool(const Group& room) {
  const Group stool{room.scene, 0.5, {0.05, 0, 1.25}};
  stool.rod({0, 0.44, 0}, {0, 0.475, 0}, 0.17, oak);
  for (int i = 0; i < 4; ++i) {
    const double x = i & 1 ? 1 : -1, z = i & 2 ? 1 : -1;
    stool.cone({0.17 * x, 0, 0.17 * z}, {0.09 * x, 0.44, 0.09 * z}, 0.013, 0.019, walnut);
    stool.rod({0.14 * x, 0.17, 0.14 * x * z}, {-0.14 * x * z, 0.17, 0.14 * x}, 0.009, walnut);
  }
}

/// An open-slatted crate: posts at the corners, boards with gaps, a bottom, and a dark box behind the gaps.
void add_crate(const Group& room, const dvec3& at, double yaw, double size, double height) {
  const Group crate{room.scene, yaw, at};
  const double h = size / 2, t = 0.016;
  crate.box({-h + t, 0, -h + t}, {h - t, 0.02, h - t}, pine * 0.8f);
  for (const double x : {-h + t, h - t - 0.035})
    for (const double z : {-h + t, h - t - 0.035}) crate.box({x, 0, z}, {x + 0.035, height, z + 0.035}, pine * 0.75f);
  const int boards = std::max(2, int(height / 0.12));
  const double pitch = height / boards, board = pitch - 0.025;
  for (int i = 0; i < boards; ++i) {
    const double y = i * pitch + 0.0125;
    const vec3 colour = pine * (0.85f + 0.25f * float(random_unit(uint32_t(7 + i + int(1000 * size + 100 * yaw)))));
    for (const double z : {-h, h - t}) crate.box({-h, y, z}, {h, y + board, z + t}, colour);
    for (const double x : {-h, h - t}) crate.box({x, y, -h + t}, {x + t, y + board, h - t}, colour);
  }
}

void add_crates(const Group& room) {
  add_crate(room, {-1.55, 0, 0.85}, 0.28, 0.56, 0.42);
  add_crate(room, {-1.52, 0.42, 0.84}, -0.18, 0.46, 0.32);
  add_crate(room, {-0.98, 0, 1.02}, -0.5, 0.40, 0.30);
  const Group low{room.scene, 0, {-0.98, 0.02, 1.02}};
  for (int i = 0; i < 14; ++i) {  // oranges, in two layers
    const double x = -0.12 + 0.08 * (i % 4), z = -0.12 + 0.08 * (i / 4);
    low.sphere({x + 0.02 * random_unit(300 + i), 0.20 + 0.02 * random_unit(400 + i), z}, 0.042, i % 3 ? orange : lemon);
  }
  room.box({-1.66, 0.74, 0.80}, {-1.40, 0.755, 0.95}, pine);
}

/// Plates and jars on the left wall.
void add_shelf(const Group& room) {
  room.box({room_left, 1.36, 0.15}, {-2.16, 1.385, 1.45}, walnut);
  for (const double z : {0.3, 1.3}) room.box({room_left, 1.24, z - 0.015}, {-2.24, 1.36, z + 0.015}, walnut);
  for (int i = 0; i < 3; ++i) {
    const double z = 0.32 + 0.25 * i;
    room.rod({-2.36, 1.495, z}, {-2.345, 1.497, z}, 0.11, i == 1 ? glaze_blue : cream);
  }
  room.cone({-2.27, 1.385, 1.08}, {-2.27, 1.52, 1.08}, 0.05, 0.085, terracotta);
  room.cone({-2.27, 1.52, 1.08}, {-2.27, 1.60, 1.08}, 0.085, 0.04, terracotta);
  room.rod({-2.27, 1.385, 1.3}, {-2.27, 1.55, 1.3}, 0.06, bottle_green);
}

/// A tree in a pot, its crown made of balls.
void add_tree(const Group& room, const dvec3& at) {
  const Group tree{room.scene, 0, at};
  tree.add(make_frustum({0, 0, 0}, {0, 0.38, 0}, 0.15, 0.22), terracotta * 1.15f,
           {make_frustum({0, 0.33, 0}, {0, 0.39, 0}, 0.18, 0.192)});
  tree.add(make_frustum({0, 0.36, 0}, {0, 0.41, 0}, 0.235, 0.235), terracotta * 1.15f,
           {make_frustum({0, 0.3, 0}, {0, 0.5, 0}, 0.19, 0.19)});
  tree.cone({0, 0.3, 0}, {0.02, 0.95, 0}, 0.03, 0.02, walnut);
  for (uint32_t i = 0; i < 34; ++i) {
    const double y = 1 - 2 * (i + 0.5) / 34, ring = std::sqrt(1 - y * y), angle = 2.39996 * i;
    const double reach = 0.24 + 0.06 * random_unit(500 + i), ball = 0.075 + 0.035 * random_unit(600 + i);
    const dvec3 direction(ring * std::cos(angle), y, ring * std::sin(angle));
    tree.sphere(dvec3(0.02, 1.16, 0) + reach * direction, ball, leaf * float(0.75 + 0.5 * random_unit(700 + i)));
    if (i % 4 == 1) tree.sphere(dvec3(0.02, 1.16, 0) + (reach + ball - 0.01) * direction, 0.035, orange);
  }
}

void add_rug(const Group& room) {
  const Group rug{room.scene, 0.32, {0.72, 0, 0.45}};
  rug.box({-1.0, 0, -0.7}, {1.0, 0.010, 0.7}, rug_red);
  rug.box({-0.9, 0, -0.6}, {0.9, 0.012, 0.6}, rug_blue);
  rug.box({-0.84, 0, -0.54}, {0.84, 0.014, 0.54}, rug_red);
}

/// A bench under the window with two jars on it.
void add_bench(const Group& room) {
  room.box({-0.1, 0.40, -2.85}, {1.35, 0.44, -2.48}, oak);
  for (const double x : {0.0, 1.18}) room.box({x, 0, -2.8}, {x + 0.06, 0.40, -2.53}, walnut);
  room.box({0.06, 0.12, -2.69}, {1.18, 0.16, -2.65}, walnut);
  const dvec3 jar(0.18, 0.44, -2.68);
  room.cone(jar, jar + dvec3(0, 0.14, 0), 0.06, 0.11, cream);
  room.cone(jar + dvec3(0, 0.14, 0), jar + dvec3(0, 0.25, 0), 0.11, 0.05, cream);
  room.cone(jar + dvec3(0, 0.25, 0), jar + dvec3(0, 0.29, 0), 0.05, 0.065, cream);
  room.sphere({0.42, 0.44 + 0.075, -2.64}, 0.075, glaze_blue);
}

/// Cypresses outside, metres behind the railing and the window.
void add_garden(const Group& room) {
  const vec3 cypress(0.045f, 0.10f, 0.05f);
  room.cone({4.6, -4, -3.6}, {4.6, 0.2, -3.6}, 0.42, 0.40, cypress);
  room.cone({4.6, 0.2, -3.6}, {4.6, 2.5, -3.6}, 0.40, 0.02, cypress);
  room.cone({7.6, -4, -7.5}, {7.6, -0.2, -7.5}, 0.55, 0.52, cypress);
  room.cone({7.6, -0.2, -7.5}, {7.6, 2.3, -7.5}, 0.52, 0.03, cypress);
  room.cone({0.85, -6, -14}, {0.85, -0.8, -14}, 0.65, 0.6, cypress * 1.3f);
  room.cone({0.85, -0.8, -14}, {0.85, 2.6, -14}, 0.6, 0.03, cypress * 1.3f);
}

const dvec3 towards_sun = glm::normalize(dvec3(0.80, 0.60, 0.30));

vec3 sky_light(const dvec3& normal) {
  const vec3 zenith(0.40f, 0.44f, 0.50f), ground(0.36f, 0.28f, 0.21f), opening(0.13f, 0.15f, 0.19f);
  const float up = 0.5f + 0.5f * float(normal.y), out = std::max(0.0f, float(normal.x));
  return glm::mix(ground, zenith, up) + opening * out;
}

/// Visible share of a sun with a radius of 1.6 degrees.
double sun_visibility(const Scene& scene, const dvec3& point, uint32_t seed) {
  constexpr int samples = 64;
  const double spread = std::tan(1.6 * M_PI / 180);
  const dvec3 side = glm::normalize(glm::cross(towards_sun, dvec3(0, 1, 0))), up = glm::cross(side, towards_sun);
  int seen = 0;
  for (uint32_t i = 0; i < samples; ++i) {
    const glm::dvec2 u = scrambled_sobol(i, seed);
    const double r = spread * std::sqrt(u.x), angle = 2 * M_PI * u.y;
    const dvec3 direction = glm::normalize(towards_sun + r * std::cos(angle) * side + r * std::sin(angle) * up);
    seen += !blocked(scene, {point, direction}, 1e9);
  }
  return double(seen) / samples;
}

}  // namespace

Scene loggia_scene() {
  Scene scene;
  const Group room{scene};
  add_floor(room);
  add_back_wall(room);
  add_left_wall_and_ceiling(room);
  add_arcade(room);
  add_stairs(room);
  add_rug(room);
  add_table(room);
  add_stool(room);
  add_crates(room);
  add_shelf(room);
  add_garden(room);
  add_tree(room, {1.62, 0, -2.3});
  add_bench(room);
  return scene;
}

Camera loggia_camera(int width, int height) {
  const dvec3 eye(0.0, 1.72, 4.0), target(-0.27, 0.82, -1.0);
  const dvec3 back = glm::normalize(eye - target), right = glm::normalize(glm::cross(dvec3(0, 1, 0), back));
  Camera camera;
  camera.fx = camera.fy = 0.5 * width / std::tan(0.5 * 65 * M_PI / 180);
  camera.cx = 0.5 * width;
  camera.cy = 0.5 * height;
  camera.pose = Pose{glm::transpose(glm::dmat3(right, glm::cross(back, right), back)), eye};
  camera.source = "header";
  return camera;
}

Ray camera_ray(const Camera& camera, double x, double y) {
  const dvec3 in_view((x - camera.cx) / camera.fx, (camera.cy - y) / camera.fy, -1);
  return {camera.pose->position, glm::normalize(glm::transpose(camera.pose->world_to_view) * in_view)};
}

double view_depth(const Camera& camera, const dvec3& position) {
  return -(camera.pose->world_to_view * (position - camera.pose->position)).z;
}

vec3 loggia_background(const dvec3& direction) {
  const vec3 horizon(0.95f, 0.86f, 0.72f), zenith(0.25f, 0.48f, 0.80f), far_sea(0.30f, 0.48f, 0.58f),
      near_sea(0.05f, 0.22f, 0.34f);
  const float y = float(direction.y);
  if (y > 0) return glm::mix(horizon, zenith, std::min(1.0f, std::sqrt(y * 1.6f)));
  return glm::mix(far_sea, near_sea, std::min(1.0f, std::sqrt(-y * 2.5f)));
}

vec3 loggia_radiance(const Scene& scene, const dvec3& position, const Hit& hit, uint32_t seed) {
  const vec3 sun(2.0f, 1.56f, 1.06f);
  const double facing = glm::dot(hit.normal, towards_sun);
  vec3 light = sky_light(hit.normal);
  if (facing > 0) light += sun * float(facing * sun_visibility(scene, position + 1e-7 * hit.normal, seed));
  return hit.object->albedo * light;
}

}  // namespace gloam::analytic
