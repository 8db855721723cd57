#include "scene/built_in/mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>

#include "base/low_discrepancy.h"
#include "scene/polygon.h"

namespace gloam::scenes {
namespace {

constexpr float tau = glm::two_pi<float>();

vec3 any_perpendicular(vec3 axis) {
  const vec3 other = std::abs(axis.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0);
  return glm::normalize(glm::cross(other, axis));
}

unsigned add_vertex(Mesh& mesh, vec3 position, vec3 normal) {
  mesh.positions.push_back(position);
  mesh.normals.push_back(normal);
  return unsigned(mesh.positions.size() - 1);
}

/// Triangles of a grid of vertices that starts at `first`, rows of `columns + 1`.
void connect_grid(Mesh& mesh, unsigned first, int columns, int rows) {
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const unsigned a = first + unsigned(row * (columns + 1) + column), b = a + 1, c = a + unsigned(columns) + 1;
      mesh.triangles.push_back({a, b, c + 1});
      mesh.triangles.push_back({a, c + 1, c});
    }
  }
}

void add_outward(Mesh& mesh, vec3 middle, std::vector<vec3> corners) {
  const vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  if (glm::dot(normal, corners[0] - middle) < 0) std::reverse(corners.begin(), corners.end());
  if (corners.size() == 3) return add_triangle(mesh, corners[0], corners[1], corners[2]);
  add_quad(mesh, corners[0], corners[1], corners[2], corners[3]);
}

/// The sum of two unit vectors, made unit; where they cancel or are zero, whatever is left.
vec2 mean_direction(vec2 a, vec2 b) {
  const vec2 sum = a + b;
  if (glm::length(sum) > 1e-3f) return glm::normalize(sum);
  return glm::length(a) > 0 ? a : glm::length(b) > 0 ? b : vec2(0, 1);
}

}  // namespace

float hash01(uint32_t a, uint32_t b, uint32_t c) { return float(hash(a + hash(b + hash(c))) >> 8) * 0x1p-24f; }

float noise(float x, float y, uint32_t seed) {
  const float fx = std::floor(x), fy = std::floor(y);
  const auto at = [&](int dx, int dy) { return hash01(uint32_t(int(fx) + dx), uint32_t(int(fy) + dy), seed); };
  const float u = x - fx, v = y - fy, su = u * u * (3 - 2 * u), sv = v * v * (3 - 2 * v);
  return glm::mix(glm::mix(at(0, 0), at(1, 0), su), glm::mix(at(0, 1), at(1, 1), su), sv);
}

int add_texture(Scene& scene, const std::string& name, int width, int height, const Painter& painter) {
  Texture texture{.name = name, .width = width, .height = height};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const vec3 colour = painter((float(x) + 0.5f) / float(width), (float(y) + 0.5f) / float(height));
      for (int c = 0; c < 3; ++c)
        texture.texels.push_back(uint8_t(std::lround(255 * std::clamp(colour[c], 0.0f, 1.0f))));
      texture.texels.push_back(255);
    }
  }
  scene.textures.push_back(std::move(texture));
  return int(scene.textures.size()) - 1;
}

int add_material(Scene& scene, const std::string& name, vec3 albedo, float roughness, float metallic) {
  scene.materials.push_back({.name = name, .albedo = albedo, .roughness = roughness, .metallic = metallic});
  return int(scene.materials.size()) - 1;
}

Mesh& add_mesh(Scene& scene, const std::string& name, int material) {
  scene.meshes.push_back({.name = name, .material = material});
  return scene.meshes.back();
}

void add_box(Mesh& mesh, vec3 low, vec3 high) {
  const auto p = [&](int x, int y, int z) { return vec3(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z); };
  add_quad(mesh, p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1));
  add_quad(mesh, p(1, 0, 0), p(0, 0, 0), p(0, 1, 0), p(1, 1, 0));
  add_quad(mesh, p(1, 0, 1), p(1, 0, 0), p(1, 1, 0), p(1, 1, 1));
  add_quad(mesh, p(0, 0, 0), p(0, 0, 1), p(0, 1, 1), p(0, 1, 0));
  add_quad(mesh, p(0, 1, 1), p(1, 1, 1), p(1, 1, 0), p(0, 1, 0));
  add_quad(mesh, p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1));
}

void add_quad(Mesh& mesh, vec3 a, vec3 b, vec3 c, vec3 d, int divisions) {
  const vec3 normal = glm::normalize(glm::cross(c - a, d - b));
  const unsigned first = unsigned(mesh.positions.size());
  for (int row = 0; row <= divisions; ++row) {
    for (int column = 0; column <= divisions; ++column) {
      const float u = float(column) / float(divisions), v = float(row) / float(divisions);
      add_vertex(mesh, glm::mix(glm::mix(a, b, u), glm::mix(d, c, u), v), normal);
    }
  }
  connect_grid(mesh, first, divisions, divisions);
}

void add_triangle(Mesh& mesh, vec3 a, vec3 b, vec3 c) {
  const vec3 normal = glm::normalize(glm::cross(b - a, c - a));
  const unsigned first = add_vertex(mesh, a, normal);
  add_vertex(mesh, b, normal);
  add_vertex(mesh, c, normal);
  mesh.triangles.push_back({first, first + 1, first + 2});
}

void add_cylinder(Mesh& mesh, vec3 from, vec3 to, float radius_from, float radius_to, int sides, bool caps) {
  const vec3 axis = glm::normalize(to - from), x = any_perpendicular(axis), y = glm::cross(axis, x);
  const float lean = (radius_from - radius_to) / glm::length(to - from);
  const unsigned first = unsigned(mesh.positions.size());
  for (int row = 0; row < 2; ++row) {
    for (int i = 0; i <= sides; ++i) {
      const float angle = tau * float(i % sides) / float(sides);
      const vec3 out = std::cos(angle) * x + std::sin(angle) * y;
      add_vertex(mesh, row ? to + radius_to * out : from + radius_from * out, glm::normalize(out + lean * axis));
    }
  }
  for (int i = 0; i < sides; ++i) {
    const unsigned a = first + unsigned(i), b = a + 1, c = a + unsigned(sides) + 1;
    if (radius_from > 0) mesh.triangles.push_back({a, b, c + 1});
    if (radius_to > 0) mesh.triangles.push_back({a, c + 1, c});
  }
  if (!caps) return;
  for (int end = 0; end < 2; ++end) {
    const float radius = end ? radius_to : radius_from;
    if (radius <= 0) continue;
    const vec3 centre = end ? to : from, normal = end ? axis : -axis;
    const unsigned middle = add_vertex(mesh, centre, normal);
    for (int i = 0; i < sides; ++i) {
      const float angle = tau * float(i) / float(sides);
      add_vertex(mesh, centre + radius * (std::cos(angle) * x + std::sin(angle) * y), normal);
    }
    for (int i = 0; i < sides; ++i) {
      const unsigned a = middle + 1 + unsigned(i), b = middle + 1 + unsigned((i + 1) % sides);
      mesh.triangles.push_back(end ? glm::uvec3(middle, a, b) : glm::uvec3(middle, b, a));
    }
  }
}

void add_sphere(Mesh& mesh, vec3 centre, float radius, int segments, int rings) {
  const unsigned first = unsigned(mesh.positions.size());
  for (int ring = 0; ring <= rings; ++ring) {
    const float polar = glm::pi<float>() * float(ring) / float(rings);
    for (int i = 0; i <= segments; ++i) {
      const float angle = tau * float(i % segments) / float(segments);
      const bool pole = ring == 0 || ring == rings;
      const float across = pole ? 0 : std::sin(polar);
      const vec3 out(across * std::sin(angle), -std::cos(polar), across * std::cos(angle));
      add_vertex(mesh, centre + radius * out, out);
    }
  }
  for (int ring = 0; ring < rings; ++ring) {
    for (int i = 0; i < segments; ++i) {
      const unsigned a = first + unsigned(ring * (segments + 1) + i), b = a + 1, c = a + unsigned(segments) + 1;
      if (ring != 0) mesh.triangles.push_back({a, b, c + 1});
      if (ring != rings - 1) mesh.triangles.push_back({a, c + 1, c});
    }
  }
}

void add_lathe(Mesh& mesh, vec3 base, const std::vector<vec2>& profile, int segments) {
  // Outward normal of each piece of the profile: the tangent turned to the right.
  std::vector<vec2> pieces;
  for (size_t i = 0; i + 1 < profile.size(); ++i) {
    const vec2 along = profile[i + 1] - profile[i];
    pieces.push_back(glm::length(along) > 0 ? glm::normalize(vec2(along.y, -along.x)) : vec2(0));
  }
  const unsigned first = unsigned(mesh.positions.size());
  for (size_t row = 0; row < profile.size(); ++row) {
    const vec2 before = row > 0 ? pieces[row - 1] : vec2(0), after = row < pieces.size() ? pieces[row] : vec2(0);
    const vec2 n = mean_direction(before, after);
    for (int i = 0; i <= segments; ++i) {
      const float angle = tau * float(i % segments) / float(segments);
      const vec3 out(std::sin(angle), 0, std::cos(angle));
      add_vertex(mesh, base + profile[row].x * out + vec3(0, profile[row].y, 0), n.x * out + vec3(0, n.y, 0));
    }
  }
  for (size_t row = 0; row + 1 < profile.size(); ++row) {
    if (profile[row] == profile[row + 1]) continue;
    for (int i = 0; i < segments; ++i) {
      const unsigned a = first + unsigned(row) * unsigned(segments + 1) + unsigned(i), b = a + 1;
      const unsigned c = a + unsigned(segments) + 1;
      if (profile[row].x > 0) mesh.triangles.push_back({a, b, c + 1});
      if (profile[row + 1].x > 0) mesh.triangles.push_back({a, c + 1, c});
    }
  }
}

void add_surface(Mesh& mesh, const std::function<vec3(float u, float v)>& surface, int columns, int rows) {
  const unsigned first = unsigned(mesh.positions.size());
  const float du = 0.5f / float(columns), dv = 0.5f / float(rows);
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const float u = float(column) / float(columns), v = float(row) / float(rows);
      const vec3 across = surface(std::min(u + du, 1.0f), v) - surface(std::max(u - du, 0.0f), v);
      const vec3 up = surface(u, std::min(v + dv, 1.0f)) - surface(u, std::max(v - dv, 0.0f));
      const vec3 normal = glm::cross(across, up);
      const float length = glm::length(normal);
      add_vertex(mesh, surface(u, v), length > 0 ? normal / length : vec3(0, 1, 0));
    }
  }
  connect_grid(mesh, first, columns, rows);
}

void add_extrusion(Mesh& mesh, const std::vector<vec2>& outline, float z0, float z1) {
  add_extrusion(mesh, outline, {}, z0, z1);
}

void add_extrusion(Mesh& mesh, const std::vector<vec2>& outline, const std::vector<std::vector<vec2>>& holes, float z0,
                   float z1) {
  add_polygon(mesh, {0, 0, z1}, {1, 0, 0}, {0, 1, 0}, outline, holes);
  Mesh back;
  add_polygon(back, {0, 0, z0}, {1, 0, 0}, {0, 1, 0}, outline, holes);
  for (vec3& normal : back.normals) normal = -normal;
  for (glm::uvec3& t : back.triangles) std::swap(t.y, t.z);
  append(mesh, back, glm::mat4(1));
  const auto add_sides = [&](const std::vector<vec2>& loop, bool is_hole) {
    for (size_t i = 0; i < loop.size(); ++i) {
      vec2 a = loop[i], b = loop[(i + 1) % loop.size()];
      if (a == b) continue;
      if (is_hole) std::swap(a, b);
      add_quad(mesh, {a.x, a.y, z0}, {b.x, b.y, z0}, {b.x, b.y, z1}, {a.x, a.y, z1});
    }
  };
  add_sides(outline, false);
  for (const std::vector<vec2>& hole : holes) add_sides(hole, true);
}

void add_polygon(Mesh& mesh, vec3 origin, vec3 across, vec3 up, const std::vector<vec2>& outline,
                 const std::vector<std::vector<vec2>>& holes) {
  const std::vector<vec2> loop = joined(outline, holes);
  const vec3 normal = glm::normalize(glm::cross(across, up));
  const unsigned first = unsigned(mesh.positions.size());
  for (const vec2 p : loop) add_vertex(mesh, origin + p.x * across + p.y * up, normal);
  for (const glm::uvec3 t : triangulated(loop)) mesh.triangles.push_back(first + t);
}

void add_textured_quad(Mesh& mesh, vec3 a, vec3 b, vec3 c, vec3 d) {
  add_quad(mesh, a, b, c, d);
  mesh.uvs.insert(mesh.uvs.end(), {{0, 1}, {1, 1}, {0, 0}, {1, 0}});  // add_quad's order: rows from a-b to d-c
}

void add_chamfered_box(Mesh& mesh, vec3 low, vec3 high, float chamfer) {
  const vec3 middle = 0.5f * (low + high), half = 0.5f * (high - low);
  // The corner of the face of `axis` next to the box's corner `signs`.
  const auto corner = [&](int axis, vec3 signs) {
    vec3 reach = half - chamfer;
    reach[axis] = half[axis];
    return middle + signs * reach;
  };
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    const auto signs = [&](float sa, float sb, float sc) {
      vec3 s;
      s[a] = sa, s[b] = sb, s[c] = sc;
      return s;
    };
    for (const float s : {-1.0f, 1.0f}) {
      add_outward(mesh, middle,
                  {corner(a, signs(s, -1, -1)), corner(a, signs(s, 1, -1)), corner(a, signs(s, 1, 1)),
                   corner(a, signs(s, -1, 1))});
      for (const float t : {-1.0f, 1.0f}) {  // the edge along a
        add_outward(mesh, middle,
                    {corner(b, signs(-1, s, t)), corner(b, signs(1, s, t)), corner(c, signs(1, s, t)),
                     corner(c, signs(-1, s, t))});
      }
    }
  }
  for (int i = 0; i < 8; ++i) {
    const vec3 signs(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    add_outward(mesh, middle, {corner(0, signs), corner(1, signs), corner(2, signs)});
  }
}

void add_tube(Mesh& mesh, const std::vector<vec3>& path, float radius, int sides) {
  const unsigned first = unsigned(mesh.positions.size());
  const size_t rows = path.size();
  const auto direction = [&](size_t i) {
    return glm::normalize(path[std::min(i + 1, rows - 1)] - path[i > 0 ? i - 1 : 0]);
  };
  vec3 x = any_perpendicular(direction(0));
  std::vector<vec3> start, end;
  for (size_t row = 0; row < rows; ++row) {
    const vec3 along = direction(row);
    x = glm::normalize(x - glm::dot(x, along) * along);  // carried along, so that the tube does not twist
    const vec3 y = glm::cross(along, x);
    for (int i = 0; i <= sides; ++i) {
      const float angle = tau * float(i % sides) / float(sides);
      const vec3 out = std::cos(angle) * x + std::sin(angle) * y;
      add_vertex(mesh, path[row] + radius * out, out);
    }
  }
  connect_grid(mesh, first, sides, int(rows) - 1);
  for (const bool last : {false, true}) {
    const unsigned ring = first + (last ? unsigned(rows - 1) * unsigned(sides + 1) : 0);
    const vec3 normal = last ? direction(rows - 1) : -direction(0);
    const unsigned cap = unsigned(mesh.positions.size());
    for (unsigned i = 0; i < unsigned(sides); ++i) add_vertex(mesh, vec3(mesh.positions[ring + i]), normal);
    for (unsigned i = 1; i + 1 < unsigned(sides); ++i) {
      mesh.triangles.push_back(last ? glm::uvec3(cap, cap + i, cap + i + 1) : glm::uvec3(cap, cap + i + 1, cap + i));
    }
  }
}

void add_torus(Mesh& mesh, vec3 centre, vec3 axis, float radius, float thickness, int segments, int sides) {
  const vec3 up = glm::normalize(axis), x = any_perpendicular(up), y = glm::cross(up, x);
  const unsigned first = unsigned(mesh.positions.size());
  for (int row = 0; row <= sides; ++row) {
    const float around = tau * float(row % sides) / float(sides);
    for (int i = 0; i <= segments; ++i) {
      const float angle = tau * float(i % segments) / float(segments);
      const vec3 out = std::cos(angle) * x + std::sin(angle) * y;
      const vec3 normal = std::cos(around) * out + std::sin(around) * up;
      add_vertex(mesh, centre + radius * out + thickness * normal, normal);
    }
  }
  connect_grid(mesh, first, segments, sides);
}

std::vector<vec2> rectangle(vec2 low, vec2 high) { return {low, {high.x, low.y}, high, {low.x, high.y}}; }

std::vector<vec2> circle(vec2 centre, float radius, int sides) {
  std::vector<vec2> outline;
  for (int i = 0; i < sides; ++i) {
    const float angle = tau * float(i) / float(sides);
    outline.push_back(centre + radius * vec2(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

std::vector<vec2> arch(vec2 low, float width, float spring, int segments) {
  std::vector<vec2> outline = {low, {low.x + width, low.y}};
  const float radius = 0.5f * width;
  for (int i = 0; i <= segments; ++i) {
    const float angle = 0.5f * tau * float(i) / float(segments);
    outline.push_back(i == segments
                          ? vec2(low.x, spring)
                          : vec2(low.x + radius + radius * std::cos(angle), spring + radius * std::sin(angle)));
  }
  return outline;
}

std::vector<vec2> wall(vec2 low, vec2 high, const std::vector<std::vector<vec2>>& doors) {
  std::vector<vec2> outline = {low};
  for (const std::vector<vec2>& door : doors) {
    outline.push_back(door[0]);
    outline.insert(outline.end(), door.rbegin(), door.rend() - 1);
  }
  outline.insert(outline.end(), {{high.x, low.y}, high, {low.x, high.y}});
  return outline;
}

std::vector<vec3> hanging_rope(vec3 from, vec3 to, float sag, int count) {
  std::vector<vec3> path;
  for (int i = 0; i < count; ++i) {
    const float t = float(i) / float(count - 1);
    path.push_back(glm::mix(from, to, t) - vec3(0, 4 * sag * t * (1 - t), 0));
  }
  return path;
}

void append(Mesh& mesh, const Mesh& source, const glm::mat4& transform) {
  const unsigned first = unsigned(mesh.positions.size());
  const glm::mat3 linear(transform), normals = glm::transpose(glm::inverse(linear));
  const bool mirrors = glm::determinant(linear) < 0;
  const bool textured = mesh.uvs.size() == mesh.positions.size() && source.uvs.size() == source.positions.size();
  if (textured) mesh.uvs.insert(mesh.uvs.end(), source.uvs.begin(), source.uvs.end());
  if (!textured) mesh.uvs.clear();
  for (size_t i = 0; i < source.positions.size(); ++i) {
    add_vertex(mesh, vec3(transform * glm::vec4(source.positions[i], 1)), glm::normalize(normals * source.normals[i]));
  }
  for (const glm::uvec3 t : source.triangles) {
    mesh.triangles.push_back(first + (mirrors ? glm::uvec3(t.x, t.z, t.y) : t));
  }
}

void place(Scene& scene, const std::string& name, int material, const Mesh& shape, const glm::mat4& transform) {
  append(add_mesh(scene, name, material), shape, transform);
}

glm::mat4 moved(vec3 offset) { return glm::translate(glm::mat4(1), offset); }
glm::mat4 turned(float angle, vec3 axis) { return glm::rotate(glm::mat4(1), angle, axis); }
glm::mat4 turned_y(float angle) { return turned(angle, vec3(0, 1, 0)); }
glm::mat4 scaled(vec3 factors) { return glm::scale(glm::mat4(1), factors); }

}  // namespace gloam::scenes
