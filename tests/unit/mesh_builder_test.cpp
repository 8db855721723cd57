// The shapes of the built-in scenes, and the scenes themselves.
#include "scene/built_in/mesh_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <utility>

#include "gloam/scene/camera_ray.h"
#include "gloam/scene/tracer.h"

namespace gloam::scenes::mesh_builder_test {
namespace {

using glm::dvec3;
constexpr double pi = 3.14159265358979323846;

/// A number for each vertex, the same for vertices at the same position (bit for bit, except for the sign of zero).
std::vector<int> merged(const Mesh& mesh) {
  std::map<std::array<float, 3>, int> places;
  std::vector<int> ids;
  for (const vec3& p : mesh.positions) {
    const std::array<float, 3> key = {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
    ids.push_back(places.emplace(key, int(places.size())).first->second);
  }
  return ids;
}

/// Number of directed edges without exactly one partner in the other direction; 0 for a closed, consistently wound surface.
int unmatched_edges(const Mesh& mesh) {
  const std::vector<int> ids = merged(mesh);
  std::map<std::pair<int, int>, int> edges;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) ++edges[{ids[t[k]], ids[t[(k + 1) % 3]]}];
  }
  int unmatched = 0;
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    unmatched += count != 1 || back == edges.end() || back->second != 1;
  }
  return unmatched;
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    sum += glm::dot(a, glm::cross(b, c)) / 6;
  }
  return sum;
}

dvec3 winding_normal(const Mesh& mesh, const glm::uvec3& t) {
  const dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  return glm::cross(b - a, c - a);
}

/// Smallest cosine between a triangle and the normals of its corners.
double agreement(const Mesh& mesh) {
  double least = 1;
  for (const glm::uvec3& t : mesh.triangles) {
    const dvec3 n = glm::normalize(winding_normal(mesh, t));
    for (int k = 0; k < 3; ++k) least = std::min(least, glm::dot(n, dvec3(mesh.normals[t[k]])));
  }
  return least;
}

/// `relative`: tolerance of the volume. `cosine`: least agreement of a normal with its triangles.
void expect_closed(const Mesh& mesh, double expected_volume, double relative, double cosine) {
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  EXPECT_EQ(unmatched_edges(mesh), 0);
  EXPECT_NEAR(volume(mesh), expected_volume, relative * expected_volume);
  EXPECT_GT(agreement(mesh), cosine);
  for (const vec3& n : mesh.normals) ASSERT_NEAR(glm::length(n), 1, 1e-5);
  for (const glm::uvec3& t : mesh.triangles) ASSERT_GT(glm::length(winding_normal(mesh, t)), 0);
}

/// Ratio of a regular polygon's area to its circle's: of a prism of `sides` to a cylinder.
double polygon_share(int sides) { return sides / (2 * pi) * std::sin(2 * pi / sides); }

const std::vector<vec2> letter_l = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};

Mesh box() {
  Mesh mesh;
  add_box(mesh, {-1, 2, 3}, {1, 3, 6});
  return mesh;
}

TEST(MeshBuilder, BoxIsClosed) {
  expect_closed(box(), 6, 1e-6, 0.9999);
  EXPECT_EQ(box().triangles.size(), 12u);
}

TEST(MeshBuilder, ChamferedBoxIsClosed) {
  Mesh mesh;
  add_chamfered_box(mesh, {-1, 2, 3}, {1, 3, 6}, 0.125f);
  EXPECT_EQ(mesh.triangles.size(), 44u);
  // Volume cut off: a prism of c^2 / 2 along each edge, less the part that prisms count more than once in corners: c^3 (3/2 -
  // 5/6) per corner.
  const double c = 0.125, cut = 0.5 * c * c * 4 * (2 + 1 + 3) - 8 * c * c * c * (1.5 - 5.0 / 6);
  expect_closed(mesh, 6 - cut, 1e-5, 0.9999);
}

TEST(MeshBuilder, CylinderAndConeAreClosed) {
  Mesh cylinder, frustum, cone, point;
  add_cylinder(cylinder, {1, 0, 0}, {1, 2, 0}, 0.5f, 0.5f, 24);
  expect_closed(cylinder, pi * 0.25 * 2 * polygon_share(24), 1e-5, 0.99);
  add_cylinder(frustum, {0, 0, 0}, {0, 0, 3}, 1, 0.5f, 40);
  expect_closed(frustum, pi * 3 / 3 * (1 + 0.5 + 0.25) * polygon_share(40), 1e-5, 0.99);
  add_cylinder(cone, {0, 0, 0}, {2, 0, 0}, 1, 0, 32);
  expect_closed(cone, pi * 2 / 3 * polygon_share(32), 1e-5, 0.98);
  add_cylinder(point, {0, 0, 0}, {2, 0, 0}, 0, 1, 32);
  expect_closed(point, pi * 2 / 3 * polygon_share(32), 1e-5, 0.98);
}

TEST(MeshBuilder, SphereIsClosed) {
  Mesh mesh;
  add_sphere(mesh, {1, 2, 3}, 2, 64, 32);
  expect_closed(mesh, 4.0 / 3 * pi * 8, 0.005, 0.99);
  EXPECT_LT(volume(mesh), 4.0 / 3 * pi * 8);
  for (const vec3& p : mesh.positions) EXPECT_NEAR(glm::length(p - vec3(1, 2, 3)), 2, 1e-5);
}

TEST(MeshBuilder, LatheClosedAtBothEnds) {
  Mesh mesh;
  add_lathe(mesh, {0, 1, 0}, {{0, 0}, {2, 0}, {2, 0}, {1, 3}, {1, 3}, {0, 3}}, 48);
  expect_closed(mesh, pi * 3 / 3 * (4 + 2 + 1) * polygon_share(48), 1e-5, 0.99);
}

TEST(MeshBuilder, LatheCreasesWhereAPointRepeats) {
  Mesh creased, smooth;
  add_lathe(creased, vec3(0), {{0, 0}, {1, 0}, {1, 0}, {1, 1}, {1, 1}, {0, 1}}, 32);
  add_lathe(smooth, vec3(0), {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 32);
  EXPECT_GT(agreement(creased), 0.99);
  EXPECT_LT(agreement(smooth), 0.75);
}

TEST(MeshBuilder, LatheSurvivesRepeatedEndsAndSpikes) {
  Mesh mesh;
  add_lathe(mesh, vec3(0), {{0.5f, 0}, {0.5f, 0}, {0.5f, 1}, {0.5f, 0.5f}, {0, 0.5f}, {0, 0.5f}}, 8);
  for (const vec3& n : mesh.normals) EXPECT_NEAR(glm::length(n), 1, 1e-5);
}

TEST(MeshBuilder, TubeAndTorusAreClosed) {
  Mesh bar, bent, ring;
  add_tube(bar, {{0, 0, 0}, {0, 1, 0}, {0, 4, 0}}, 0.5f, 12);
  expect_closed(bar, pi * 0.25 * 4 * polygon_share(12), 1e-4, 0.9);
  add_tube(bent, {{0, 0, 0}, {0, 1, 0}, {0.5f, 2, 0}, {1.5f, 2.5f, 0.5f}}, 0.1f, 12);
  EXPECT_EQ(unmatched_edges(bent), 0);
  EXPECT_GT(volume(bent), 0);
  add_torus(ring, {1, 1, 1}, {1, 2, 0}, 2, 0.5f, 96, 48);
  expect_closed(ring, 2 * pi * 2 * pi * 0.25, 0.01, 0.99);
}

TEST(MeshBuilder, ExtrusionOfAConcaveOutlineIsClosed) {
  Mesh mesh;
  add_extrusion(mesh, letter_l, 1, 3);
  expect_closed(mesh, 4 * 2, 1e-6, 0.9999);
}

TEST(MeshBuilder, ExtrusionWithHolesIsClosed) {
  Mesh mesh;
  const double round_hole = pi * 0.04 * polygon_share(16);
  add_extrusion(mesh, rectangle({0, 0}, {8, 3}),
                {rectangle({1, 1}, {2, 2}), rectangle({3, 1}, {4, 2}), circle({6, 1.5f}, 0.2f, 16),
                 rectangle({5, 0.5f}, {5.5f, 2.5f})},
                -0.5f, 0);
  expect_closed(mesh, 0.5 * (24 - 1 - 1 - round_hole - 1), 1e-5, 0.9999);
}

TEST(MeshBuilder, HolesBehindHolesAreCutToo) {
  // A grid of holes: from most of them, other holes hide the outline.
  std::vector<std::vector<vec2>> holes;
  for (int i = 0; i < 9; ++i) {
    for (int k = 0; k < 5; ++k) {
      const vec2 low(0.5f + float(i), 0.5f + float(k));
      holes.push_back(rectangle(low, low + 0.5f));
    }
  }
  Mesh mesh;
  add_extrusion(mesh, rectangle({0, 0}, {9.5f, 5.5f}), holes, 0, 1);
  expect_closed(mesh, 9.5 * 5.5 - 45 * 0.25, 1e-5, 0.9999);
}

TEST(MeshBuilder, WallWithDoorsIsClosed) {
  Mesh mesh;
  const double half_disc = 0.5 * pi * 0.25 * polygon_share(24);  // 12 segments of the half
  add_extrusion(mesh, wall({0, 0}, {6, 3}, {arch({1, 0}, 1, 1.5f, 12), rectangle({3, 0}, {4, 2})}),
                {rectangle({4.5f, 1}, {5.5f, 2})}, 0, 0.5f);
  expect_closed(mesh, 0.5 * (18 - 1.5 - half_disc - 2 - 1), 1e-5, 0.9999);
}

TEST(MeshBuilder, PolygonFacesAcrossTimesUp) {
  Mesh mesh;
  add_polygon(mesh, {1, 2, 3}, {0, 0, 1}, {1, 0, 0}, letter_l);
  double area = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    EXPECT_GT(winding_normal(mesh, t).y, 0);
    area += 0.5 * glm::length(winding_normal(mesh, t));
  }
  EXPECT_NEAR(area, 4, 1e-5);
  for (const vec3& n : mesh.normals) EXPECT_EQ(n, vec3(0, 1, 0));
}

TEST(MeshBuilder, SurfaceFacesTheViewerWhenUGoesRight) {
  Mesh mesh;
  add_surface(
      mesh, [](float u, float v) { return vec3(u, v, 0.1f * std::sin(6 * u) * v); }, 20, 10);
  EXPECT_EQ(mesh.triangles.size(), 400u);
  for (const glm::uvec3& t : mesh.triangles) EXPECT_GT(winding_normal(mesh, t).z, 0);
  EXPECT_GT(agreement(mesh), 0.97);
}

TEST(MeshBuilder, TexturedQuadHasTheTextureUpright) {
  Mesh mesh;
  add_textured_quad(mesh, {0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0});
  ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
  for (size_t i = 0; i < mesh.uvs.size(); ++i) {
    EXPECT_EQ(mesh.uvs[i], vec2(mesh.positions[i].x / 2, 1 - mesh.positions[i].y));
  }
}

TEST(MeshBuilder, AppendKeepsWindingOutward) {
  const glm::mat4 skew = moved({3, -2, 1}) * turned(0.7f, {1, 2, 3}) * scaled({2, 0.5f, 3});
  for (const vec3 mirror : {vec3(1), vec3(-1, 1, 1), vec3(1, -1, 1), vec3(-1, -1, 1), vec3(-1)}) {
    Mesh mesh;
    append(mesh, box(), skew * scaled(mirror));
    expect_closed(mesh, 6 * 3, 1e-4, 0.999);
  }
}

TEST(MeshBuilder, AppendKeepsTextureCoordinatesOnlyWhereAllHaveThem) {
  Mesh textured, both, mixed;
  add_textured_quad(textured, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  append(both, textured, moved({1, 0, 0}));
  append(both, textured, moved({2, 0, 0}));
  EXPECT_EQ(both.uvs.size(), 8u);
  append(mixed, textured, moved({1, 0, 0}));
  append(mixed, box(), moved({0, 0, 0}));
  EXPECT_TRUE(mixed.uvs.empty());
}

TEST(MeshBuilder, TurnedYTakesZToX) {
  const glm::vec4 p = turned_y(float(pi / 2)) * glm::vec4(0, 0, 1, 1);
  EXPECT_NEAR(p.x, 1, 1e-6);
  EXPECT_NEAR(p.z, 0, 1e-6);
}

TEST(MeshBuilder, RopeSagsInTheMiddle) {
  const std::vector<vec3> rope = hanging_rope({0, 2, 0}, {4, 2, 0}, 0.5f, 17);
  ASSERT_EQ(rope.size(), 17u);
  EXPECT_EQ(rope.front(), vec3(0, 2, 0));
  EXPECT_EQ(rope.back(), vec3(4, 2, 0));
  EXPECT_NEAR(rope[8].y, 1.5, 1e-6);
}

TEST(MeshBuilder, HashIsUniformAndDependsOnEveryArgument) {
  double sum = 0;
  for (uint32_t i = 0; i < 10000; ++i) {
    const float value = hash01(i, 3, 5);
    ASSERT_GE(value, 0);
    ASSERT_LT(value, 1);
    sum += value;
  }
  EXPECT_NEAR(sum / 10000, 0.5, 0.01);
  const std::set<float> values = {hash01(1), hash01(2), hash01(1, 1), hash01(1, 2), hash01(1, 1, 1), hash01(1, 1, 2)};
  EXPECT_EQ(values.size(), 6u);
}

// --- Every built-in scene.

class BuiltinScene : public testing::TestWithParam<std::string> {
 protected:
  Scene scene() const { return load_scene(GetParam(), {}); }
};

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const SceneRecipe& recipe : builtin_scenes()) names.push_back(recipe.name);
  return names;
}

TEST_P(BuiltinScene, IsSound) {
  const Scene made = scene();
  EXPECT_NO_THROW(check(made));
  EXPECT_GT(made.ao_radius, 0);
  EXPECT_FALSE(find_builtin_scene(GetParam())->summary.empty());
  for (const Mesh& mesh : made.meshes) {
    EXPECT_FALSE(mesh.triangles.empty()) << mesh.name;
    EXPECT_TRUE(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size()) << mesh.name;
    int not_unit = 0;
    for (const vec3& n : mesh.normals) not_unit += !(std::abs(glm::length(n) - 1) < 1e-4f);
    EXPECT_EQ(not_unit, 0) << mesh.name;
  }
  for (const Material& material : made.materials) {
    for (const int texture :
         {material.albedo_texture, material.roughness_texture, material.metallic_texture, material.emission_texture}) {
      EXPECT_GE(texture, -1) << material.name;
      EXPECT_LT(texture, int(made.textures.size())) << material.name;
    }
    EXPECT_GE(std::min({material.albedo.x, material.albedo.y, material.albedo.z}), 0) << material.name;
    EXPECT_LE(std::max({material.albedo.x, material.albedo.y, material.albedo.z}), 1) << material.name;
  }
  for (const Texture& texture : made.textures) {
    EXPECT_EQ(texture.texels.size(), 4 * size_t(texture.width) * size_t(texture.height)) << texture.name;
  }
}

TEST_P(BuiltinScene, IsTheSameEveryTime) {
  const Scene a = scene(), b = scene();
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (size_t i = 0; i < a.meshes.size(); ++i) {
    ASSERT_EQ(a.meshes[i].name, b.meshes[i].name);
    ASSERT_EQ(a.meshes[i].material, b.meshes[i].material);
    ASSERT_EQ(a.meshes[i].positions, b.meshes[i].positions) << a.meshes[i].name;
    ASSERT_EQ(a.meshes[i].normals, b.meshes[i].normals) << a.meshes[i].name;
    ASSERT_EQ(a.meshes[i].uvs, b.meshes[i].uvs) << a.meshes[i].name;
    ASSERT_EQ(a.meshes[i].triangles, b.meshes[i].triangles) << a.meshes[i].name;
  }
  ASSERT_EQ(a.textures.size(), b.textures.size());
  for (size_t i = 0; i < a.textures.size(); ++i) ASSERT_EQ(a.textures[i].texels, b.textures[i].texels);
}

TEST_P(BuiltinScene, EveryCameraSeesSomething) {
  const Scene made = scene();
  const Tracer tracer(made);
  ASSERT_FALSE(made.cameras.empty());
  EXPECT_EQ(made.cameras.front().name, "main");
  for (const SceneCamera& from : made.cameras) {
    const Camera camera = camera_for(from, 32, 18);
    int hits = 0;
    for (int y = 0; y < 18; ++y) {
      for (int x = 0; x < 32; ++x) hits += tracer.first(camera_ray(camera, made.origin, x + 0.5, y + 0.5)).has_value();
    }
    EXPECT_GT(hits, 32 * 18 / 10) << from.name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, BuiltinScene, testing::ValuesIn(scene_names()), [](const auto& scene) {
  std::string name = scene.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

// --- The architectural scenes, which are meant to be busy and solid.

class BusyScene : public BuiltinScene {};

TEST_P(BusyScene, HasManyFacesAndObjects) {
  const Scene made = scene();
  EXPECT_GE(made.faces(), 40'000u);
  EXPECT_LE(made.faces(), 400'000u);
  EXPECT_GE(made.meshes.size(), 100u);
  EXPECT_GE(made.cameras.size(), 2u);
  EXPECT_LE(made.cameras.size(), 3u);
}

TEST_P(BusyScene, ShowsFrontsButForSheets) {
  const std::set<std::string> sheets = {"leaves", "grass", "cypress needles", "washing", "banner", "curtain", "paper"};
  const Scene made = scene();
  const Tracer tracer(made);
  for (const SceneCamera& from : made.cameras) {
    const Camera camera = camera_for(from, 320, 180);
    std::map<std::string, int> backs;
    for (int y = 0; y < 180; ++y) {
      for (int x = 0; x < 320; ++x) {
        const auto hit = tracer.first(camera_ray(camera, made.origin, x + 0.5, y + 0.5));
        if (hit && hit->back_face) ++backs[made.meshes[size_t(hit->mesh)].name];
      }
    }
    for (const auto& [name, pixels] : backs) {
      EXPECT_TRUE(sheets.count(name)) << from.name << ": " << pixels << " pixels show the back of '" << name << "'";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, BusyScene,
                         testing::Values("courtyard", "temple", "corridor", "colonnade", "gallery", "lounge",
                                         "banquet"),
                         [](const auto& scene) { return scene.param; });

TEST(Corridor, ShellIsOneConnectedMeshWithConcaveCorners) {
  const Scene scene = load_scene("corridor", {});
  const auto room =
      std::find_if(scene.meshes.begin(), scene.meshes.end(), [](const Mesh& m) { return m.name == "room"; });
  ASSERT_NE(room, scene.meshes.end());
  const std::vector<int> ids = merged(*room);
  std::vector<int> parent(ids.size());
  for (size_t i = 0; i < parent.size(); ++i) parent[i] = int(i);
  const auto root = [&](int i) {
    while (parent[size_t(i)] != i) i = parent[size_t(i)] = parent[size_t(parent[size_t(i)])];
    return i;
  };
  // Concave: the two triangles of an edge lean towards each other on the visible side.
  std::map<std::pair<int, int>, const glm::uvec3*> by_edge;
  for (const glm::uvec3& t : room->triangles) {
    for (int k = 0; k < 3; ++k) {
      const int a = ids[t[k]], b = ids[t[(k + 1) % 3]];
      by_edge[{a, b}] = &t;
      parent[size_t(root(a))] = root(b);
    }
  }
  std::set<int> roots;
  for (const int id : ids) roots.insert(root(id));
  EXPECT_EQ(roots.size(), 1u);
  int concave = 0, convex = 0;
  for (const auto& [edge, t] : by_edge) {
    const auto other = by_edge.find({edge.second, edge.first});
    if (other == by_edge.end() || edge.first > edge.second) continue;
    const dvec3 n = glm::normalize(winding_normal(*room, *t));
    const glm::uvec3& u = *other->second;
    double lean = 0;
    for (int k = 0; k < 3; ++k) {
      const double side = glm::dot(n, dvec3(room->positions[u[k]]) - dvec3(room->positions[t->x]));
      if (std::abs(side) > std::abs(lean)) lean = side;
    }
    concave += lean > 1e-3;
    convex += lean < -1e-3;
  }
  EXPECT_GT(concave, 100);
  EXPECT_GT(convex, 50);
}

}  // namespace
}  // namespace gloam::scenes::mesh_builder_test
