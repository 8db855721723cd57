#include "gloam/scene/outline_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>
#include <tuple>

#include "gloam/error.h"

namespace gloam {
namespace {

using glm::dvec3;
using glm::vec3;

/// Vertices at exactly the same position, as one place.
struct Places {
  std::vector<unsigned> of;  ///< place of each vertex
  size_t count = 0;
};

Places places_of(const std::vector<vec3>& positions) {
  std::vector<unsigned> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](unsigned i) { return std::tie(positions[i].x, positions[i].y, positions[i].z); };
  std::sort(order.begin(), order.end(), [&](unsigned a, unsigned b) { return key(a) < key(b); });
  Places places{std::vector<unsigned>(positions.size()), 0};
  for (size_t i = 0; i < order.size(); ++i) {
    places.count += i == 0 || key(order[i - 1]) != key(order[i]);
    places.of[order[i]] = unsigned(places.count - 1);
  }
  return places;
}

dvec3 unit_or_zero(const dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : dvec3(0);
}

/// Zero for a face without an area.
dvec3 face_normal(const Mesh& mesh, const glm::uvec3& t) {
  const dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
  return unit_or_zero(glm::cross(b - a, c - a));
}

vec3 pushed(const vec3& position, const dvec3& direction, double extent) {
  return vec3(dvec3(position) + extent * direction);
}

/// Steps 1 and 2 of algorithm 2: the distinct normals of the faces around each place.
std::vector<std::vector<dvec3>> distinct_normals(const Mesh& mesh, const Places& places, double angle) {
  std::vector<std::vector<dvec3>> normals(places.count);
  for (const glm::uvec3& t : mesh.triangles) {
    const dvec3 normal = face_normal(mesh, t);
    if (normal == dvec3(0)) continue;
    // By sine and cosine: the cosine of a small angle has few digits left.
    const auto is_same = [&](const dvec3& other) {
      return std::atan2(glm::length(glm::cross(normal, other)), glm::dot(normal, other)) <= angle;
    };
    for (int i = 0; i < 3; ++i) {
      std::vector<dvec3>& around = normals[places.of[t[i]]];
      if (std::none_of(around.begin(), around.end(), is_same)) around.push_back(normal);
    }
  }
  return normals;
}

/// Step 3: the normalised mean of the normals; zero if they cancel.
dvec3 integrated_normal(const std::vector<dvec3>& normals) {
  const dvec3 sum = std::accumulate(normals.begin(), normals.end(), dvec3(0));
  return glm::length(sum) > 1e-6 * double(normals.size()) ? glm::normalize(sum) : dvec3(0);
}

/// How far a vertex is to move along the integrated normal for its faces to move by 1.
double mitre(const dvec3& integrated, const std::vector<dvec3>& normals) {
  double least = 1;
  for (const dvec3& normal : normals) least = std::min(least, glm::dot(integrated, normal));
  return 1 / std::max(least, 1 / most_mitre);
}

void push_integrated(Mesh& mesh, const Places& places, const OutlineOptions& options) {
  const std::vector<std::vector<dvec3>> normals = distinct_normals(mesh, places, glm::radians(options.angle_degrees));
  std::vector<dvec3> moves;
  for (const std::vector<dvec3>& around : normals) {
    const dvec3 integrated = integrated_normal(around);
    moves.push_back(options.method == OutlineMethod::mitre ? mitre(integrated, around) * integrated : integrated);
  }
  for (size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.positions[i] = pushed(mesh.positions[i], moves[places.of[i]], options.extent);
}

void scale(Mesh& mesh, double extent) {
  dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const vec3& p : mesh.positions) low = glm::min(low, dvec3(p)), high = glm::max(high, dvec3(p));
  const dvec3 centre = 0.5 * (low + high), half = 0.5 * (high - low);
  const double largest = std::max({half.x, half.y, half.z});
  if (!(largest > 0)) return;
  const double growth = extent / largest;
  for (vec3& p : mesh.positions) p = pushed(p, dvec3(p) - centre, growth);
}

void push_along_vertex_normals(Mesh& mesh, const std::vector<vec3>& normals, double extent) {
  for (size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.positions[i] = pushed(mesh.positions[i], unit_or_zero(normals[i]), extent);
}

void push_faces(Mesh& mesh, double extent) {
  std::vector<vec3> positions;
  positions.reserve(3 * mesh.triangles.size());
  for (glm::uvec3& t : mesh.triangles) {
    const dvec3 normal = face_normal(mesh, t);
    const unsigned first = unsigned(positions.size());
    for (int i = 0; i < 3; ++i) positions.push_back(pushed(mesh.positions[t[i]], normal, extent));
    t = {first, first + 1, first + 2};
  }
  mesh.positions = std::move(positions);
}

/// Connected parts of a mesh: places joined by triangles.
class Parts {
 public:
  Parts(const Mesh& mesh, const Places& places) : parent_(places.count), open_(places.count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    for (const glm::uvec3& t : mesh.triangles) {
      for (const int i : {1, 2}) parent_[root(places.of[t[i]])] = root(places.of[t[0]]);
    }
  }
  void open(unsigned place) { open_[root(place)] = 1; }
  bool is_open(unsigned place) { return open_[root(place)]; }

 private:
  unsigned root(unsigned place) {
    for (; parent_[place] != place; place = parent_[place]) parent_[place] = parent_[parent_[place]];
    return place;
  }
  std::vector<unsigned> parent_;
  std::vector<char> open_;
};

/// Marks parts as open that have an edge used more often one way than the other.
void open_at_borders(Parts& parts, const Mesh& mesh, const Places& places) {
  struct Edge {
    unsigned low, high;
    int way;
    bool operator<(const Edge& other) const { return std::tie(low, high) < std::tie(other.low, other.high); }
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const unsigned from = places.of[t[i]], to = places.of[t[(i + 1) % 3]];
      if (from != to) edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
    }
  }
  std::sort(edges.begin(), edges.end());
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto end = std::upper_bound(edge, edges.end(), *edge);
    if (std::accumulate(edge, end, 0, [](int sum, const Edge& e) { return sum + e.way; }) != 0) parts.open(edge->low);
    edge = end;
  }
}

/// Marks parts as open that have come apart: triangles that met in a place and no longer do.
void open_where_torn(Parts& parts, const Mesh& mesh, const Places& places, const Mesh& outline) {
  std::vector<const vec3*> moved_to(places.count, nullptr);
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const unsigned place = places.of[mesh.triangles[i][k]];
      const vec3& here = outline.positions[outline.triangles[i][k]];
      if (!moved_to[place]) moved_to[place] = &here;
      if (*moved_to[place] != here) parts.open(place);
    }
  }
}

std::vector<char> closed_triangles(const Mesh& mesh, const Places& places, const Mesh& outline) {
  Parts parts(mesh, places);
  open_at_borders(parts, mesh, places);
  open_where_torn(parts, mesh, places, outline);
  std::vector<char> closed;
  closed.reserve(mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) closed.push_back(!parts.is_open(places.of[t[0]]));
  return closed;
}

void check(const OutlineOptions& options) {
  if (!(options.extent > 0 && options.extent <= 1e15))
    throw UsageError("outlines {:g} scene units away cannot be made; more than 0 and up to 1e15 can", options.extent);
  if (!(options.angle_degrees >= 0 && options.angle_degrees <= 90))
    throw UsageError("normals {:g} degrees apart cannot be told apart; give 0 to 90", options.angle_degrees);
}

}  // namespace

const std::vector<std::string>& outline_methods() {
  static const std::vector<std::string> names = {"mitre", "integrated", "scaling", "normal"};
  return names;
}

bool has_angle(OutlineMethod method) {
  return method == OutlineMethod::mitre || method == OutlineMethod::integrated;
}

Outline outline_of(const Mesh& mesh, const OutlineOptions& options) {
  check(options);
  const Places places = places_of(mesh.positions);
  Outline outline{{mesh.name, 0, mesh.positions, {}, {}, mesh.triangles}, {}};
  if (has_angle(options.method))
    push_integrated(outline.mesh, places, options);
  else if (options.method == OutlineMethod::scaling)
    scale(outline.mesh, options.extent);
  else if (!mesh.normals.empty())
    push_along_vertex_normals(outline.mesh, mesh.normals, options.extent);
  else
    push_faces(outline.mesh, options.extent);
  outline.closed = closed_triangles(mesh, places, outline.mesh);
  return outline;
}

}  // namespace gloam
