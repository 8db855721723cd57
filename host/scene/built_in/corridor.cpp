// A long corridor seen from inside: pilasters, an alcove, a side hall, open doorways, window recesses, furniture. The
// shell, with the rooms behind the doorways, is one connected mesh with many concave corners.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "scene/built_in/mesh_builder.h"

namespace gloam::scenes {
namespace {

using glm::mat4;
constexpr float pi = glm::pi<float>();
// Boards, furniture and skirting stand at y = 0; the shell's floor lies a board's thickness lower.
constexpr float room_height = 3.4f, reveal = 0.35f, shell_floor = -0.012f;

// A plan is drawn in (x, -z): north, the far end, is up. Loops are counter-clockwise, the room on their left. All
// coordinates of the shell are whole millimetres, so that its parts meet exactly.
using Plan = std::vector<vec2>;

/// A hole in a wall of the plan, by the middle of its lower side.
struct Opening {
  vec2 middle;
  float width, bottom, height;
  bool is_closed = false;  ///< a niche; otherwise one sees through
};

vec3 lifted(vec2 p, float height) { return {p.x, height, -p.y}; }

struct Edge {
  vec2 from, to;
  float length() const { return glm::length(to - from); }
  vec2 along() const { return (to - from) / length(); }
  vec2 inward() const { return {-along().y, along().x}; }
  /// Distance of the point from `from`, or -1 when it does not lie on the edge.
  float where(vec2 p) const {
    const float t = glm::dot(p - from, along());
    return std::abs(glm::dot(p - from, inward())) < 1e-3f && t > 0 && t < length() ? t : -1;
  }
};

std::vector<Edge> edges_of(const Plan& plan) {
  std::vector<Edge> edges;
  for (size_t i = 0; i < plan.size(); ++i) edges.push_back({plan[i], plan[(i + 1) % plan.size()]});
  return edges;
}

/// Openings of one wall, sorted from its start.
std::vector<std::pair<float, Opening>> openings_on(const Edge& edge, const std::vector<Opening>& openings) {
  std::vector<std::pair<float, Opening>> found;
  for (const Opening& o : openings) {
    if (const float t = edge.where(o.middle); t >= 0) found.push_back({t, o});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return found;
}

/// The sides of an opening, from the wall outwards.
void add_reveal(Mesh& mesh, const Edge& edge, float t, const Opening& o) {
  const vec2 a = edge.from + (t - 0.5f * o.width) * edge.along(), b = edge.from + (t + 0.5f * o.width) * edge.along();
  const vec2 out = -reveal * edge.inward();
  const float low = o.bottom, high = o.bottom + o.height;
  add_quad(mesh, lifted(a + out, low), lifted(b + out, low), lifted(b, low), lifted(a, low));
  add_quad(mesh, lifted(a, high), lifted(b, high), lifted(b + out, high), lifted(a + out, high));
  add_quad(mesh, lifted(a, high), lifted(a + out, high), lifted(a + out, low), lifted(a, low));
  add_quad(mesh, lifted(b + out, high), lifted(b, high), lifted(b, low), lifted(b + out, low));
  if (o.is_closed)
    add_quad(mesh, lifted(b + out, low), lifted(a + out, low), lifted(a + out, high), lifted(b + out, high));
}

/// Floor, ceiling and walls, seen from inside. Reveals are added for openings whose middle lies on this plan's walls when
/// `with_reveals`; the room on the other side of a doorway shares them.
void add_room(Mesh& mesh, const Plan& plan, const std::vector<Opening>& openings, bool with_reveals) {
  Plan floor, ceiling;
  for (const Edge& edge : edges_of(plan)) {
    floor.push_back(edge.from);
    ceiling.push_back({edge.from.x, -edge.from.y});
    std::vector<std::vector<vec2>> doors, holes;
    const float length = edge.length();
    for (const auto& [t, o] : openings_on(edge, openings)) {
      // The wall is drawn from inside, where its end is on the left.
      const float x = length - t;
      const auto outline = rectangle({x - 0.5f * o.width, o.bottom}, {x + 0.5f * o.width, o.bottom + o.height});
      if (o.bottom == shell_floor) {
        doors.insert(doors.begin(), outline);
        floor.push_back(edge.from + (t - 0.5f * o.width) * edge.along());
        floor.push_back(edge.from + (t + 0.5f * o.width) * edge.along());
      } else {
        holes.push_back(outline);
      }
      if (with_reveals) add_reveal(mesh, edge, t, o);
    }
    const vec2 along = edge.along();
    add_polygon(mesh, lifted(edge.to, 0), {-along.x, 0, along.y}, {0, 1, 0},
                wall({0, shell_floor}, {length, room_height}, doors), holes);
  }
  std::reverse(ceiling.begin(), ceiling.end());
  add_polygon(mesh, {0, shell_floor, 0}, {1, 0, 0}, {0, 0, -1}, floor);
  add_polygon(mesh, {0, room_height, 0}, {1, 0, 0}, {0, 0, 1}, ceiling);
}

/// A straight wall from `from` to `to` with a pilaster every `spacing` metres; the last corner is left to the next wall.
void draw_wall(Plan& plan, vec2 from, vec2 to, float spacing) {
  const Edge edge{from, to};
  plan.push_back(from);
  const int count = int(edge.length() / spacing);
  const float start = std::round(500 * (edge.length() - spacing * float(count - 1))) / 1000;
  for (int i = 0; i < count; ++i) {
    const vec2 middle = from + (start + spacing * float(i)) * edge.along();
    const vec2 half = 0.2f * edge.along(), in = 0.14f * edge.inward();
    plan.insert(plan.end(), {middle - half, middle - half + in, middle + half + in, middle + half});
  }
}

Plan corridor_plan() {
  Plan plan;
  draw_wall(plan, {1.6f, -3}, {1.6f, 9}, 4);
  plan.insert(plan.end(), {{1.6f, 9}, {4.4f, 9}, {4.4f, 13}});
  draw_wall(plan, {1.6f, 13}, {1.6f, 18}, 2.5f);
  plan.push_back({1.6f, 18});
  draw_wall(plan, {-1.6f, 18}, {-1.6f, 8}, 3);
  plan.insert(plan.end(), {{-1.6f, 8}, {-3.0f, 8}, {-3.0f, 5}});
  draw_wall(plan, {-1.6f, 5}, {-1.6f, -3}, 4);
  plan.push_back({-1.6f, -3});
  return plan;
}

const Plan east_room = {{1.95f, -1}, {5.2f, -1}, {5.2f, 4}, {1.95f, 4}};
const Plan west_room = {{-5.5f, 9}, {-1.95f, 9}, {-1.95f, 13}, {-5.5f, 13}};
const Plan north_room = {{-2.6f, 18.35f}, {2.6f, 18.35f}, {2.6f, 22}, {-2.6f, 22}};

// Doorways by their middle on the corridor's side and on the other.
struct Doorway {
  vec2 middle, other;
  float width, height;
  float leaf_angle;  ///< how far the leaf is open
};
const Doorway doorways[] = {{{1.6f, 1}, {1.95f, 1}, 1.0f, 2.2f, 1.9f},
                            {{-1.6f, 11.4f}, {-1.95f, 11.4f}, 1.0f, 2.2f, 1.3f},
                            {{0, 18}, {0, 18.35f}, 1.4f, 2.4f, 2.2f}};

const std::vector<Opening> windows = {{{-1.6f, 1}, 1.2f, 0.9f, 1.7f},     {{-1.6f, 4.1f}, 1.2f, 0.9f, 1.7f},
                                      {{-1.6f, 14.5f}, 1.2f, 0.9f, 1.7f}, {{-1.6f, 17.1f}, 0.9f, 0.9f, 1.7f},
                                      {{4.4f, 11}, 2.0f, 0.7f, 2.0f},     {{5.2f, 1.5f}, 1.4f, 0.9f, 1.6f},
                                      {{-5.5f, 11}, 1.2f, 0.9f, 1.6f},    {{0, 22}, 2.4f, 0.8f, 2.0f}};
const std::vector<Opening> niches = {{{1.6f, 8}, 0.7f, 1.0f, 1.3f, true}, {{1.6f, 15.5f}, 0.7f, 1.0f, 1.3f, true}};

void add_shell(Scene& scene, int plaster) {
  std::vector<Opening> all = windows, others = windows;
  all.insert(all.end(), niches.begin(), niches.end());
  for (const Doorway& d : doorways) {
    all.push_back({d.middle, d.width, shell_floor, d.height - shell_floor});
    others.push_back({d.other, d.width, shell_floor, d.height - shell_floor});
  }
  Mesh& mesh = add_mesh(scene, "room", plaster);
  add_room(mesh, corridor_plan(), all, true);
  for (const Plan& plan : {east_room, west_room, north_room}) {
    add_room(mesh, plan, others, false);
    Mesh reveals;
    for (const Edge& edge : edges_of(plan)) {
      for (const auto& [t, o] : openings_on(edge, windows)) add_reveal(reveals, edge, t, o);
    }
    append(mesh, reveals, mat4(1));
  }
  for (vec3& p : mesh.positions) p = glm::round(1000.0f * p) / 1000.0f;
}

struct Materials {
  int plaster, white_paint, oak, dark_wood, iron, brass, fabric, red, blue, green, paper, glass, lamp, clay, leaf,
      brick, earth, steel, rug;
};

Materials add_materials(Scene& scene) {
  Materials m;
  m.plaster = add_material(scene, "plaster", {0.70f, 0.67f, 0.60f}, 0.9f);
  m.white_paint = add_material(scene, "white paint", {0.78f, 0.77f, 0.73f}, 0.35f);
  m.oak = add_material(scene, "oak", {0.42f, 0.28f, 0.16f}, 0.5f);
  m.dark_wood = add_material(scene, "walnut", {0.20f, 0.12f, 0.07f}, 0.4f);
  m.iron = add_material(scene, "painted iron", {0.16f, 0.17f, 0.16f}, 0.4f);
  m.brass = add_material(scene, "brass", {0.80f, 0.60f, 0.28f}, 0.25f, 1);
  m.fabric = add_material(scene, "wool", {0.30f, 0.33f, 0.38f}, 1);
  m.red = add_material(scene, "red enamel", {0.55f, 0.06f, 0.04f}, 0.25f);
  m.blue = add_material(scene, "blue cloth", {0.10f, 0.16f, 0.34f}, 0.9f);
  m.green = add_material(scene, "green cloth", {0.13f, 0.26f, 0.15f}, 0.9f);
  m.paper = add_material(scene, "paper", {0.80f, 0.78f, 0.70f}, 0.95f);
  m.glass = add_material(scene, "lamp shade", {0.75f, 0.72f, 0.62f}, 0.4f);
  m.lamp = add_material(scene, "bulb", {0.9f, 0.9f, 0.9f}, 0.3f);
  m.clay = add_material(scene, "glazed clay", {0.25f, 0.38f, 0.42f}, 0.15f);
  m.leaf = add_material(scene, "leaf", {0.12f, 0.27f, 0.08f}, 0.5f);
  m.brick = add_material(scene, "brick", {0.48f, 0.28f, 0.20f}, 0.9f);
  m.earth = add_material(scene, "lawn", {0.18f, 0.25f, 0.09f}, 1);
  m.steel = add_material(scene, "steel", {0.62f, 0.62f, 0.63f}, 0.3f, 1);
  m.rug = add_material(scene, "rug", {0.42f, 0.12f, 0.10f}, 1);
  scene.materials[size_t(m.lamp)].emission = {0.98f, 0.85f, 0.6f};
  return m;
}

/// Stretches of a wall, as distances from its start, that no doorway interrupts below its height.
std::vector<vec2> stretches(const Edge& edge, float low) {
  std::vector<float> ends = {0};
  for (const Doorway& d : doorways) {
    const float t = std::max(edge.where(d.middle), edge.where(d.other));
    if (t < 0 || low > d.height) continue;
    ends.insert(ends.end(), {t - 0.5f * d.width - 0.1f, t + 0.5f * d.width + 0.1f});
  }
  ends.push_back(edge.length());
  std::sort(ends.begin(), ends.end());
  std::vector<vec2> found;
  for (size_t i = 0; i + 1 < ends.size(); i += 2) {
    if (ends[i + 1] - ends[i] > 0.05f) found.push_back({ends[i], ends[i + 1]});
  }
  return found;
}

/// A bar on a wall, `thick` deep, over a stretch of it.
void add_bar(Mesh& mesh, const Edge& edge, vec2 stretch, float low, float high, float thick) {
  const vec2 a = edge.from + stretch.x * edge.along();
  const vec2 b = edge.from + stretch.y * edge.along() + thick * edge.inward();
  const vec2 p = glm::min(a, b), q = glm::max(a, b);
  add_chamfered_box(mesh, {p.x, low, -q.y}, {q.x, high, -p.y}, 0.3f * std::min(thick, high - low));
}

void add_moulding(Mesh& mesh, const Plan& plan, float low, float high, float thick) {
  for (const Edge& edge : edges_of(plan)) {
    for (const vec2 stretch : stretches(edge, low)) add_bar(mesh, edge, stretch, low, high, thick);
  }
}

/// Raised panels between the skirting and the rail.
void add_panels(Mesh& mesh, const Plan& plan) {
  for (const Edge& edge : edges_of(plan)) {
    for (const vec2 stretch : stretches(edge, 0)) {
      const float length = stretch.y - stretch.x;
      if (length < 0.3f) continue;
      const int count = std::max(1, int(length / 0.62f));
      for (int i = 0; i < count; ++i) {
        const float a = stretch.x + length * float(i) / float(count),
                    b = stretch.x + length * float(i + 1) / float(count);
        add_bar(mesh, edge, {a + 0.06f, b - 0.06f}, 0.22f, 0.7f, 0.012f);
        add_bar(mesh, edge, {a + 0.12f, b - 0.12f}, 0.28f, 0.64f, 0.022f);
      }
    }
  }
}

/// Floor boards along z, their tops at y = 0.
void add_boards(Mesh& mesh, vec2 low, vec2 high, uint32_t seed) {
  const int rows = int(std::round((high.x - low.x) / 0.14f));
  const float width = (high.x - low.x) / float(rows);
  for (int row = 0; row < rows; ++row) {
    const float x = low.x + width * float(row);
    float y = low.y - 1.3f * hash01(seed, uint32_t(row));
    for (uint32_t i = 0; y < high.y; ++i) {
      const float length = 1.0f + 0.8f * hash01(seed, uint32_t(row), i + 1);
      const float a = std::max(y, low.y), b = std::min(y + length, high.y);
      y += length;
      if (b - a < 0.02f) continue;
      add_chamfered_box(mesh, {x + 0.0015f, shell_floor, -b + 0.001f}, {x + width - 0.0015f, 0, -a - 0.001f}, 0.002f);
    }
  }
}

void add_floors(Scene& scene, int wood) {
  const vec2 parts[][2] = {{{-1.6f, -3}, {1.6f, 18}},     {{-3, 5}, {-1.6f, 8}},
                           {{1.6f, 9}, {4.4f, 13}},       {{1.95f, -1}, {5.2f, 4}},
                           {{-5.5f, 9}, {-1.95f, 13}},    {{-2.6f, 18.35f}, {2.6f, 22}},
                           {{1.6f, 0.5f}, {1.95f, 1.5f}}, {{-1.95f, 10.9f}, {-1.6f, 11.9f}},
                           {{-0.7f, 18}, {0.7f, 18.35f}}};
  uint32_t seed = 600;
  for (const auto& [low, high] : parts) add_boards(add_mesh(scene, "floor boards", wood), low, high, ++seed);
}

/// Puts what is made against a wall (its back at z = 0, facing +z) to a place on the wall whose inward side is given.
mat4 against(vec2 point, vec2 inward) { return moved(lifted(point, 0)) * turned_y(std::atan2(inward.x, -inward.y)); }

void add_doorway(Scene& scene, const Materials& m, const Doorway& d) {
  const vec2 inward = glm::normalize(d.middle - d.other);
  Mesh frame, leaf, handle;
  const float half = 0.5f * d.width, h = d.height;
  for (const bool far : {false, true}) {
    // Architraves on both sides of the wall.
    const float z0 = far ? -reveal - 0.03f : -0.005f, z1 = far ? -reveal + 0.005f : 0.03f;
    add_chamfered_box(frame, {-half - 0.1f, 0, z0}, {-half + 0.02f, h + 0.1f, z1}, 0.008f);
    add_chamfered_box(frame, {half - 0.02f, 0, z0}, {half + 0.1f, h + 0.1f, z1}, 0.008f);
    add_chamfered_box(frame, {-half + 0.02f, h - 0.02f, z0}, {half - 0.02f, h + 0.1f, z1}, 0.008f);
  }
  add_chamfered_box(frame, {-half, 0, -reveal + 0.005f}, {-half + 0.02f, h, -0.005f}, 0.004f);
  add_chamfered_box(frame, {half - 0.02f, 0, -reveal + 0.005f}, {half, h, -0.005f}, 0.004f);
  add_chamfered_box(frame, {-half + 0.02f, h - 0.02f, -reveal + 0.005f}, {half - 0.02f, h, -0.005f}, 0.004f);
  const mat4 at = against(d.middle, inward);
  place(scene, "door frame", m.white_paint, frame, at);

  // The leaf, hinged at its left edge: stiles, rails and sunk panels.
  const float w = d.width - 0.06f, t = 0.04f;
  for (const float x : {0.0f, w - 0.11f}) add_chamfered_box(leaf, {x, 0, 0}, {x + 0.11f, h - 0.04f, t}, 0.004f);
  for (const float y : {0.0f, 0.85f, 1.5f, h - 0.16f}) {
    add_chamfered_box(leaf, {0.11f, y, 0}, {w - 0.11f, y + 0.12f, t}, 0.004f);
  }
  add_chamfered_box(leaf, {0.5f * w - 0.05f, 0.12f, 0}, {0.5f * w + 0.05f, h - 0.16f, t}, 0.004f);
  add_box(leaf, {0.1f, 0.1f, 0.012f}, {w - 0.1f, h - 0.14f, t - 0.012f});
  for (const float side : {-0.035f, t + 0.035f}) {
    const float root = side < 0 ? 0 : t;
    add_cylinder(handle, {w - 0.06f, 1.04f, root}, {w - 0.06f, 1.04f, side}, 0.012f, 0.009f, 12);
    add_tube(handle, {{w - 0.06f, 1.04f, side}, {w - 0.12f, 1.045f, side * 1.08f}, {w - 0.18f, 1.035f, side}}, 0.009f,
             10);
    add_cylinder(handle, {w - 0.06f, 1.04f, root}, {w - 0.06f, 1.04f, root + 0.1f * side}, 0.026f, 0.024f, 20);
  }
  const mat4 hinge = at * moved({-half + 0.025f, 0.01f, -reveal - 0.01f}) * turned_y(d.leaf_angle) * moved({0, 0, -t});
  place(scene, "door", m.oak, leaf, hinge);
  place(scene, "door handle", m.brass, handle, hinge);
}

void add_window(Scene& scene, const Materials& m, const Opening& o, vec2 inward) {
  Mesh frame, sill;
  const float half = 0.5f * o.width, h = o.height, z = -reveal + 0.04f, bar = 0.055f;
  add_box(frame, {-half, 0, z}, {-half + bar, h, z + 0.07f});
  add_box(frame, {half - bar, 0, z}, {half, h, z + 0.07f});
  for (const float y : {0.0f, 0.68f * h, h - bar}) {
    add_box(frame, {-half + bar, y, z + 0.002f}, {half - bar, y + bar, z + 0.068f});
  }
  for (int i = 1; i < 4; ++i) {
    const float x = -half + o.width * float(i) / 4, wide = i == 2 ? 0.04f : 0.012f;
    add_box(frame, {x - wide, bar, z + 0.004f}, {x + wide, h - bar, z + 0.066f});
  }
  add_box(frame, {-half + bar, 0.36f * h, z + 0.02f}, {half - bar, 0.36f * h + 0.025f, z + 0.05f});
  add_chamfered_box(sill, {-half - 0.08f, -0.04f, -reveal + 0.05f}, {half + 0.08f, 0.005f, 0.07f}, 0.008f);
  add_cylinder(sill, {0.03f, 0.5f * h, z + 0.07f}, {0.03f, 0.5f * h, z + 0.11f}, 0.01f, 0.01f, 10);
  const mat4 at = against(o.middle, inward) * moved({0, o.bottom, 0});
  place(scene, "window frame", m.white_paint, frame, at);
  place(scene, "window sill", m.white_paint, sill, at);
}

/// A column radiator of `sections`, against z = 0.
void add_radiator(Scene& scene, const Materials& m, const mat4& at, int sections) {
  Mesh iron;
  const float pitch = 0.06f, first = -0.5f * pitch * float(sections - 1);
  for (int i = 0; i < sections; ++i) {
    const float x = first + pitch * float(i);
    for (const float z : {0.06f, 0.11f, 0.16f}) {
      add_tube(iron, {{x, 0.12f, z}, {x, 0.16f, z}, {x, 0.58f, z}, {x, 0.62f, z}}, 0.02f, 8);
    }
    for (const float y : {0.12f, 0.62f}) {
      add_tube(iron, {{x, y, 0.05f}, {x, y, 0.17f}}, 0.028f, 10);
      add_sphere(iron, {x, y, 0.05f}, 0.028f, 10, 6);
      add_sphere(iron, {x, y, 0.17f}, 0.028f, 10, 6);
    }
  }
  const float last = -first;
  for (const float y : {0.12f, 0.62f}) add_cylinder(iron, {first, y, 0.11f}, {last, y, 0.11f}, 0.017f, 0.017f, 10);
  for (const float x : {first, last}) {
    for (const float z : {0.06f, 0.16f}) add_cylinder(iron, {x, 0, z}, {x, 0.12f, z}, 0.028f, 0.016f, 10);
  }
  add_tube(iron,
           {{last, 0.12f, 0.11f}, {last + 0.1f, 0.12f, 0.11f}, {last + 0.13f, 0.1f, 0.11f}, {last + 0.14f, 0, 0.11f}},
           0.012f, 10);
  place(scene, "radiator", m.iron, iron, at);
  Mesh valve;
  add_cylinder(valve, {last + 0.07f, 0.12f, 0.11f}, {last + 0.07f, 0.19f, 0.11f}, 0.014f, 0.014f, 12);
  add_torus(valve, {last + 0.07f, 0.19f, 0.11f}, {0, 1, 0}, 0.025f, 0.007f, 20, 8);
  place(scene, "valve", m.brass, valve, at);
}

void add_pipes(Scene& scene, const Materials& m) {
  Mesh pipes, clips;
  for (int i = 0; i < 3; ++i) {
    const float x = 1.3f - 0.09f * float(i), y = room_height - 0.36f, radius = 0.02f + 0.008f * float(i);
    add_tube(pipes, {{x, y, 3}, {x, y, -10.5f - 0.3f * float(i)}, {x, y, -17.98f}}, radius, 12);
    for (float z = 2.3f; z > -17.5f; z -= 2) {
      add_torus(clips, {x, y, z}, {0, 0, 1}, radius + 0.006f, 0.008f, 16, 6);
      add_cylinder(clips, {x, y + radius, z}, {x, room_height, z}, 0.006f, 0.006f, 6);
    }
  }
  for (const float z : {-4.0f, -8.7f}) {
    add_tube(pipes,
             {{1.3f, room_height - 0.36f, z},
              {1.42f, room_height - 0.38f, z},
              {1.5f, room_height - 0.45f, z},
              {1.52f, room_height - 0.6f, z},
              {1.52f, 0, z}},
             0.018f, 12);
  }
  place(scene, "pipes", m.steel, pipes, mat4(1));
  place(scene, "pipe clips", m.iron, clips, mat4(1));
}

void add_ceiling(Scene& scene, const Materials& m) {
  for (int i = 0; i < 11; ++i) {
    const float z = 2.2f - 2 * float(i);
    Mesh beam;
    add_chamfered_box(beam, {-1.62f, room_height - 0.22f, z - 0.1f}, {1.62f, room_height + 0.01f, z + 0.1f}, 0.015f);
    if (z > -18) place(scene, "beam", m.dark_wood, beam, mat4(1));
  }
  for (int i = 0; i < 5; ++i) {
    const vec3 top(0, room_height, 0.2f - 4 * float(i)), at = top - vec3(0, 0.9f, 0);
    Mesh& fitting = add_mesh(scene, "lamp fitting", m.brass);
    add_cylinder(fitting, at + vec3(0, 0.15f, 0), top, 0.005f, 0.005f, 8);
    add_lathe(fitting, top, {{0, -0.05f}, {0.03f, -0.045f}, {0.06f, -0.01f}, {0.06f, 0}}, 24);
    add_lathe(fitting, at, {{0, 0.08f}, {0.03f, 0.08f}, {0.035f, 0.12f}, {0.02f, 0.16f}, {0, 0.17f}}, 20);
    add_lathe(add_mesh(scene, "lamp shade", m.glass), at,
              {{0.20f, -0.06f},
               {0.205f, -0.06f},
               {0.205f, -0.055f},
               {0.14f, 0.04f},
               {0.05f, 0.11f},
               {0.04f, 0.11f},
               {0.13f, 0.035f},
               {0.20f, -0.06f}},
              36);
    add_sphere(add_mesh(scene, "bulb", m.lamp), at + vec3(0, 0.02f, 0), 0.055f, 20, 12);
  }
}

/// A bench of slats along z against the wall at x = 0, facing +x in its own frame's +z.
void add_bench(Scene& scene, const Materials& m, const mat4& at, float length) {
  Mesh wood, iron;
  for (int i = 0; i < 5; ++i) {
    const float z = 0.1f + 0.08f * float(i);
    add_chamfered_box(wood, {-0.5f * length, 0.43f, z}, {0.5f * length, 0.46f, z + 0.065f}, 0.006f);
  }
  for (int i = 0; i < 3; ++i) {
    const float y = 0.56f + 0.11f * float(i);
    add_chamfered_box(wood, {-0.5f * length, y, 0.05f}, {0.5f * length, y + 0.08f, 0.075f}, 0.006f);
  }
  for (const float x : {-0.42f * length, 0.0f, 0.42f * length}) {
    add_tube(iron, {{x, 0, 0.46f}, {x, 0.2f, 0.44f}, {x, 0.41f, 0.47f}, {x, 0.42f, 0.3f}, {x, 0.42f, 0.1f}}, 0.014f, 8);
    add_tube(iron, {{x, 0, 0.06f}, {x, 0.42f, 0.09f}, {x, 0.88f, 0.04f}}, 0.014f, 8);
  }
  place(scene, "bench", m.oak, wood, at);
  place(scene, "bench frame", m.iron, iron, at);
}

void add_chair(Scene& scene, const Materials& m, const mat4& at) {
  Mesh wood, seat;
  for (const float x : {-0.19f, 0.19f}) {
    add_tube(wood, {{1.05f * x, 0, 0.2f}, {x, 0.44f, 0.18f}}, 0.019f, 10);
    add_tube(wood, {{1.05f * x, 0, -0.22f}, {x, 0.45f, -0.18f}, {x, 0.7f, -0.2f}, {x, 0.95f, -0.27f}}, 0.018f, 10);
    add_cylinder(wood, {x, 0.18f, 0.19f}, {x, 0.18f, -0.2f}, 0.01f, 0.01f, 8);
  }
  add_cylinder(wood, {-0.19f, 0.25f, 0.19f}, {0.19f, 0.25f, 0.19f}, 0.01f, 0.01f, 8);
  for (int i = 0; i < 5; ++i) {
    const float x = -0.13f + 0.065f * float(i);
    add_tube(wood, {{x, 0.46f, -0.185f}, {x, 0.7f, -0.195f}, {x, 0.9f, -0.255f}}, 0.008f, 8);
  }
  add_tube(wood, {{-0.19f, 0.9f, -0.255f}, {0, 0.92f, -0.275f}, {0.19f, 0.9f, -0.255f}}, 0.018f, 10);
  add_chamfered_box(wood, {-0.21f, 0.42f, -0.2f}, {0.21f, 0.45f, 0.21f}, 0.01f);
  add_chamfered_box(seat, {-0.19f, 0.45f, -0.16f}, {0.19f, 0.485f, 0.19f}, 0.015f);
  place(scene, "chair", m.dark_wood, wood, at);
  place(scene, "cushion", m.fabric, seat, at);
}

/// Shelves with books; back against z = 0.
void add_bookcase(Scene& scene, const Materials& m, const mat4& at, float width, uint32_t seed) {
  const float height = 2.3f, depth = 0.32f;
  Mesh wood;
  for (const float x : {-0.5f * width, 0.5f * width - 0.03f}) {
    add_chamfered_box(wood, {x, 0, 0.005f}, {x + 0.03f, height, depth}, 0.004f);
  }
  add_box(wood, {-0.5f * width + 0.03f, 0.06f, 0.005f}, {0.5f * width - 0.03f, height - 0.01f, 0.02f});
  add_chamfered_box(wood, {-0.5f * width - 0.04f, height, 0.005f},
                    {0.5f * width + 0.04f, height + 0.06f, depth + 0.04f}, 0.01f);
  Mesh books[4];
  for (int shelf = 0; shelf < 6; ++shelf) {
    const float y = 0.06f + 0.37f * float(shelf);
    add_chamfered_box(wood, {-0.5f * width + 0.03f, y, 0.02f}, {0.5f * width - 0.03f, y + 0.025f, depth - 0.01f},
                      0.003f);
    float x = -0.5f * width + 0.035f;
    for (uint32_t k = 0; x < 0.5f * width - 0.1f; ++k) {
      const uint32_t id = seed + 100 * uint32_t(shelf) + k;
      const float thick = 0.018f + 0.035f * hash01(id, 1), tall = 0.2f + 0.11f * hash01(id, 2);
      if (hash01(id, 3) < 0.06f) {
        x += 0.12f;
        continue;
      }
      Mesh book;
      add_chamfered_box(book, {0, 0, 0}, {thick - 0.002f, tall, 0.15f + 0.08f * hash01(id, 4)}, 0.003f);
      const float lean = hash01(id, 5) < 0.08f ? -0.12f : 0;
      append(books[id % 4], book, moved({x, y + 0.025f, 0.05f}) * turned(lean, {0, 0, 1}));
      x += thick + (lean < 0 ? 0.04f : 0);
    }
  }
  place(scene, "bookcase", m.dark_wood, wood, at);
  const int covers[] = {m.red, m.blue, m.green, m.paper};
  for (int i = 0; i < 4; ++i) place(scene, "books", covers[i], books[i], at);
}

void add_plant(Scene& scene, const Materials& m, vec3 at, uint32_t seed) {
  add_lathe(add_mesh(scene, "flower pot", m.clay), at,
            {{0, 0},
             {0.14f, 0},
             {0.14f, 0},
             {0.19f, 0.15f},
             {0.2f, 0.3f},
             {0.22f, 0.34f},
             {0.22f, 0.36f},
             {0.19f, 0.36f},
             {0.18f, 0.3f},
             {0, 0.3f}},
            32);
  Mesh& leaves = add_mesh(scene, "leaves", m.leaf);
  for (uint32_t i = 0; i < 46; ++i) {
    const float tall = 0.5f + 0.7f * hash01(seed, i, 1), reach = 0.25f + 0.3f * hash01(seed, i, 2),
                wide = 0.03f + 0.02f * hash01(seed, i, 3);
    const auto blade = [&](float u, float v) {
      const float half = wide * std::sin(pi * (0.1f + 0.88f * v)), side = 2 * u - 1;
      return vec3(reach * v * v, 0.3f + tall * std::sin(1.9f * v) * 0.9f, -half * side) +
             vec3(0, 0.4f * half * side * side, 0);
    };
    Mesh leaf;
    add_surface(leaf, blade, 2, 8);
    append(leaves, leaf, moved(at) * turned_y(2 * pi * hash01(seed, i, 4)));
  }
}

void add_table(Scene& scene, const Materials& m, const mat4& at, float width, float depth) {
  Mesh wood;
  for (const float x : {-0.5f * width + 0.06f, 0.5f * width - 0.06f}) {
    for (const float z : {-0.5f * depth + 0.06f, 0.5f * depth - 0.06f}) {
      add_lathe(wood, {x, 0, z},
                {{0, 0},
                 {0.02f, 0},
                 {0.03f, 0.04f},
                 {0.018f, 0.08f},
                 {0.03f, 0.35f},
                 {0.035f, 0.55f},
                 {0.02f, 0.58f},
                 {0.035f, 0.61f},
                 {0.035f, 0.72f}},
                16);
    }
  }
  add_chamfered_box(wood, {-0.5f * width + 0.04f, 0.62f, -0.5f * depth + 0.04f},
                    {0.5f * width - 0.04f, 0.72f, 0.5f * depth - 0.04f}, 0.005f);
  add_chamfered_box(wood, {-0.5f * width, 0.72f, -0.5f * depth}, {0.5f * width, 0.75f, 0.5f * depth}, 0.008f);
  place(scene, "table", m.oak, wood, at);
}

void add_small_things(Scene& scene, const Materials& m) {
  // Fire extinguisher on the wall, a clock, a notice board with papers, coat hooks.
  const mat4 east = against({1.6f, 2.2f}, {-1, 0});
  Mesh bottle, hose, bracket;
  add_lathe(
      bottle, {0, 0.9f, 0.1f},
      {{0, 0}, {0.07f, 0}, {0.08f, 0.02f}, {0.08f, 0.38f}, {0.06f, 0.45f}, {0.03f, 0.48f}, {0.03f, 0.52f}, {0, 0.52f}},
      28);
  add_tube(hose,
           {{0.02f, 1.41f, 0.1f}, {0.09f, 1.4f, 0.12f}, {0.12f, 1.3f, 0.13f}, {0.1f, 1.1f, 0.13f}, {0.1f, 1.0f, 0.12f}},
           0.012f, 8);
  add_chamfered_box(bracket, {-0.05f, 1.0f, 0}, {0.05f, 1.3f, 0.025f}, 0.004f);
  place(scene, "extinguisher", m.red, bottle, east);
  place(scene, "hose", m.dark_wood, hose, east);
  place(scene, "bracket", m.steel, bracket, east);

  const mat4 board_at = against({1.6f, 5.5f}, {-1, 0});
  Mesh board, papers;
  add_chamfered_box(board, {-0.75f, 1.1f, 0}, {0.75f, 2.1f, 0.02f}, 0.004f);
  for (const float y : {1.08f, 2.08f}) add_chamfered_box(board, {-0.79f, y, 0}, {0.79f, y + 0.04f, 0.035f}, 0.006f);
  for (const float x : {-0.79f, 0.75f}) add_chamfered_box(board, {x, 1.12f, 0}, {x + 0.04f, 2.08f, 0.035f}, 0.006f);
  for (uint32_t i = 0; i < 14; ++i) {
    const float x = -0.66f + 0.2f * float(i % 7), y = i < 7 ? 1.2f : 1.66f;
    const float w = 0.15f + 0.04f * hash01(i, 80), h = 0.2f + 0.14f * hash01(i, 81);
    const auto sheet = [&](float u, float v) {
      return vec3(x + w * u, y + h * v, 0.0235f + 0.02f * (1 - v) * (1 - v) * hash01(i, 82) + 0.008f * u * (1 - v));
    };
    add_surface(papers, sheet, 4, 6);
  }
  place(scene, "notice board", m.dark_wood, board, board_at);
  place(scene, "paper", m.paper, papers, board_at);

  const mat4 clock_at = against({-1.6f, 8.9f}, {1, 0}) * moved({0, 2.3f, 0}) * turned(pi / 2, {1, 0, 0});
  Mesh clock, face;
  add_lathe(clock, vec3(0), {{0.19f, 0}, {0.2f, 0.03f}, {0.2f, 0.05f}, {0.18f, 0.06f}, {0.17f, 0.045f}}, 40);
  add_lathe(face, vec3(0), {{0.18f, 0.046f}, {0, 0.046f}}, 40);
  add_box(clock, {-0.006f, 0.046f, -0.13f}, {0.006f, 0.052f, 0.02f});
  add_box(clock, {-0.02f, 0.052f, -0.006f}, {0.1f, 0.058f, 0.006f});
  place(scene, "clock", m.brass, clock, clock_at);
  place(scene, "clock face", m.paper, face, clock_at);

  for (const Opening& niche : niches) {  // a vase in each niche
    const vec3 at(niche.middle.x + 0.18f, niche.bottom, -niche.middle.y);
    add_lathe(add_mesh(scene, "vase", m.clay), at,
              {{0, 0},
               {0.07f, 0},
               {0.075f, 0.02f},
               {0.05f, 0.06f},
               {0.11f, 0.2f},
               {0.125f, 0.32f},
               {0.09f, 0.43f},
               {0.04f, 0.5f},
               {0.045f, 0.56f},
               {0.075f, 0.6f},
               {0.07f, 0.605f},
               {0.035f, 0.56f},
               {0, 0.5f}},
              40);
  }
  const vec3 stand(-1.35f, 0, -4.75f);
  add_lathe(add_mesh(scene, "umbrella stand", m.brass), stand,
            {{0, 0},
             {0.12f, 0},
             {0.12f, 0},
             {0.11f, 0.03f},
             {0.12f, 0.5f},
             {0.13f, 0.52f},
             {0.115f, 0.52f},
             {0.1f, 0.04f},
             {0, 0.03f}},
            32);
  for (int i = 0; i < 3; ++i) {
    const float turn = 2.1f * float(i);
    const vec3 lean(0.06f * std::sin(turn), 0, 0.06f * std::cos(turn));
    Mesh& umbrella = add_mesh(scene, "umbrella", i == 1 ? m.blue : m.dark_wood);
    add_cylinder(umbrella, stand - lean + vec3(0, 0.05f, 0), stand + lean + vec3(0, 0.6f, 0), 0.01f, 0.035f, 10);
    const vec3 top = stand + lean * 1.3f + vec3(0, 0.8f, 0);
    add_tube(umbrella,
             {stand + lean + vec3(0, 0.58f, 0), top, top + vec3(0.02f, 0.05f, 0), top + vec3(0.06f, 0.06f, 0),
              top + vec3(0.08f, 0.03f, 0)},
             0.01f, 8);
  }
}

void add_furniture(Scene& scene, const Materials& m) {
  const vec2 east(1, 0), west(-1, 0);
  for (const Opening& o : windows) {
    const bool at_west = o.middle.x < -1 && o.middle.y > -5, at_east = o.middle.x > 1;
    const vec2 inward = at_west ? east : at_east ? west : vec2(0, -1);
    add_window(scene, m, o, inward);
    if (o.width < 2) add_radiator(scene, m, against(o.middle, inward), o.width < 1 ? 8 : 14);
  }
  add_bench(scene, m, against({1.6f, 5.5f}, west), 1.6f);
  add_bench(scene, m, against({4.4f, 11}, west), 1.9f);
  add_bench(scene, m, against({1.6f, 13.55f}, west), 0.8f);
  add_bookcase(scene, m, against({-3.0f, 6.5f}, east) * moved({0.72f, 0, 0}), 1.3f, 1000);
  add_bookcase(scene, m, against({-3.0f, 6.5f}, east) * moved({-0.72f, 0, 0}), 1.3f, 3000);
  add_bookcase(scene, m, against({2.7f, 9}, {0, 1}), 1.6f, 5000);
  add_bookcase(scene, m, against({5.2f, 3.2f}, west), 1.2f, 7000);
  add_chair(scene, m, moved({-2.1f, 0, -5.8f}) * turned_y(1.9f));
  add_chair(scene, m, moved({-2.2f, 0, -7.3f}) * turned_y(0.9f));
  add_table(scene, m, moved({-1.1f, 0, -9.0f}) * turned_y(pi / 2), 1.1f, 0.45f);
  add_table(scene, m, moved({3.1f, 0, -11.4f}), 1.3f, 0.8f);
  add_chair(scene, m, moved({3.0f, 0, -10.6f}) * turned_y(pi + 0.2f));
  add_chair(scene, m, moved({2.9f, 0, -12.25f}) * turned_y(0.3f));
  add_table(scene, m, moved({3.7f, 0, -1.4f}), 1.5f, 0.8f);
  add_chair(scene, m, moved({3.6f, 0, -0.6f}) * turned_y(pi - 0.3f));
  add_chair(scene, m, moved({-3.8f, 0, -10.6f}) * turned_y(1.2f));
  add_table(scene, m, moved({0.5f, 0, -20.5f}), 1.6f, 0.8f);
  add_chair(scene, m, moved({0.2f, 0, -19.7f}) * turned_y(pi));
  add_plant(scene, m, {1.2f, 0, -8.4f}, 31);
  add_plant(scene, m, {-1.25f, 0, -13.5f}, 32);
  add_plant(scene, m, {3.95f, 0, -9.4f}, 33);
  add_plant(scene, m, {-2.6f, 0, -5.35f}, 34);
  for (const vec3 at : {vec3(-1.1f, 0.75f, -9.2f), vec3(3.3f, 0.75f, -11.5f), vec3(3.9f, 0.75f, -1.5f)}) {
    Mesh& lamp = add_mesh(scene, "table lamp", m.brass);
    add_lathe(lamp, at,
              {{0, 0},
               {0.08f, 0},
               {0.08f, 0.015f},
               {0.02f, 0.04f},
               {0.015f, 0.2f},
               {0.03f, 0.24f},
               {0.012f, 0.28f},
               {0.012f, 0.34f},
               {0, 0.34f}},
              24);
    add_lathe(add_mesh(scene, "table lamp shade", m.green), at,
              {{0.15f, 0.27f}, {0.155f, 0.27f}, {0.1f, 0.42f}, {0.095f, 0.42f}, {0.15f, 0.27f}}, 32);
    add_sphere(add_mesh(scene, "bulb", m.lamp), at + vec3(0, 0.355f, 0), 0.035f, 16, 10);
    for (uint32_t i = 0; i < 4; ++i) {
      Mesh book;
      const float thick = 0.02f + 0.02f * hash01(i, uint32_t(at.x * 10 + 50), 90);
      add_chamfered_box(book, {-0.1f, 0, -0.07f}, {0.1f, thick, 0.07f}, 0.003f);
      place(scene, "book", i % 2 ? m.red : m.blue, book,
            moved(at + vec3(0, 0.04f * float(i), 0.32f)) * turned_y(0.5f * hash01(i, 91)) *
                scaled({1, 0.04f / thick, 1}));
    }
  }
  // The runner: a thick cloth with ripples and fringes.
  Mesh& rug = add_mesh(scene, "rug", m.rug);
  const auto top = [](float u, float v) {
    const float z = 2 - 15 * v, edge = std::min(1.0f, 14 * std::min(u, 1 - u));
    const float ripple = 0.012f * std::pow(std::max(0.0f, std::sin(1.3f * z + 2 * u)), 8.0f);
    return vec3(-0.6f + 1.2f * u, 0.004f + 0.006f * edge + ripple * edge, z);
  };
  add_surface(rug, top, 24, 260);
  for (int i = 0; i < 60; ++i) {
    const float x = -0.595f + 0.02f * float(i), bend = 0.02f * (hash01(uint32_t(i), 92) - 0.5f);
    add_tube(rug, {{x, 0.005f, 2}, {x + bend, 0.004f, 2.07f}}, 0.003f, 5);
  }
}

void add_prints(Scene& scene, const Materials& m) {
  const struct {
    vec2 point, inward;
  } places[] = {{{-1.6f, 2.3f}, {1, 0}},   {{-1.6f, -0.3f}, {1, 0}}, {{-1.6f, 9.4f}, {1, 0}}, {{-1.6f, 12.4f}, {1, 0}},
                {{1.6f, -0.25f}, {-1, 0}}, {{1.6f, 3.7f}, {-1, 0}},  {{3.0f, 13}, {0, -1}},   {{3.9f, 13}, {0, -1}},
                {{2.2f, 13}, {0, -1}},     {{-0.95f, 18}, {0, -1}},  {{1.15f, 18}, {0, -1}},  {{-2.3f, 8}, {0, -1}}};
  const int colours[] = {m.blue, m.green, m.red, m.fabric};
  uint32_t id = 700;
  for (const auto& p : places) {
    const float w = 0.16f + 0.1f * hash01(++id), h = 0.2f + 0.14f * hash01(id, 1), y = 1.6f;
    Mesh frame, mount, print;
    for (const float s : {-1.0f, 1.0f}) {
      add_chamfered_box(frame, {s * w - 0.02f, y - h - 0.02f, 0}, {s * w + 0.02f, y + h + 0.02f, 0.03f}, 0.006f);
      add_chamfered_box(frame, {-w + 0.02f, y + s * h - 0.02f, 0}, {w - 0.02f, y + s * h + 0.02f, 0.03f}, 0.006f);
    }
    add_box(mount, {-w, y - h, 0}, {w, y + h, 0.012f});
    add_box(print, {-0.6f * w, y - 0.6f * h, 0.005f}, {0.6f * w, y + 0.6f * h, 0.014f});
    const mat4 at = against(p.point, p.inward);
    place(scene, "picture frame", id % 2 ? m.dark_wood : m.brass, frame, at);
    place(scene, "mount", m.paper, mount, at);
    place(scene, "print", colours[id % 4], print, at);
  }
}

/// What the windows look out on.
void add_outside(Scene& scene, const Materials& m) {
  add_quad(add_mesh(scene, "lawn", m.earth), {-40, -0.5f, 40}, {40, -0.5f, 40}, {40, -0.5f, -60}, {-40, -0.5f, -60}, 8);
  Mesh& garden_wall = add_mesh(scene, "garden wall", m.brick);
  for (int row = 0; row < 14; ++row) {
    for (int i = 0; i < 36; ++i) {
      const float z = -22 + 0.7f * float(i) + (row % 2 ? 0.35f : 0), y = -0.5f + 0.17f * float(row);
      add_box(garden_wall, {-12.2f - 0.02f * hash01(uint32_t(row), uint32_t(i), 93), y, z},
              {-11.9f, y + 0.155f, z + 0.68f});
    }
  }
}

Scene make(const ParameterValues&) {
  Scene scene;
  const Materials m = add_materials(scene);
  add_shell(scene, m.plaster);
  Mesh skirting, cornice;
  for (const Plan& plan : {corridor_plan(), east_room, west_room, north_room}) {
    add_moulding(skirting, plan, 0, 0.14f, 0.02f);
    add_moulding(skirting, plan, 0, 0.03f, 0.035f);
    add_moulding(skirting, plan, 0.76f, 0.81f, 0.03f);
    add_panels(skirting, plan);
    add_moulding(cornice, plan, room_height - 0.1f, room_height, 0.06f);
    add_moulding(cornice, plan, room_height - 0.16f, room_height - 0.1f, 0.03f);
  }
  place(scene, "skirting", m.white_paint, skirting, mat4(1));
  place(scene, "cornice", m.white_paint, cornice, mat4(1));
  for (const Doorway& d : doorways) add_doorway(scene, m, d);
  add_floors(scene, m.oak);
  add_prints(scene, m);
  add_ceiling(scene, m);
  add_pipes(scene, m);
  add_furniture(scene, m);
  add_small_things(scene, m);
  add_outside(scene, m);
  scene.cameras = {looking_at("main", {0.35f, 1.65f, 2.3f}, {-0.15f, 1.35f, -8.0f}, 74),
                   looking_at("radiator", {-0.3f, 1.15f, 0.2f}, {-1.6f, 0.75f, -1.4f}, 66),
                   looking_at("hall", {-1.1f, 1.6f, -8.2f}, {3.6f, 1.1f, -11.6f}, 76)};
  scene.light.to_sun = {-0.8f, 0.62f, 0.25f};
  scene.light.sun = {2.4f, 2.1f, 1.6f};
  scene.light.zenith = {0.40f, 0.46f, 0.55f};
  scene.light.horizon = {0.50f, 0.50f, 0.50f};
  scene.light.ground = {0.32f, 0.29f, 0.25f};
  scene.ao_radius = 0.5;
  return scene;
}

}  // namespace

std::vector<SceneRecipe> corridor() {
  return {{.name = "corridor",
           .summary = "a corridor from inside: one connected shell with concave corners, doorways, recesses, furniture",
           .kind = "architecture",
           .make = make}};
}

}  // namespace gloam::scenes
