// The built-in scenes hairball, fence, foliage and statue: closed where they must be, and with the number of faces asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <map>
#include <utility>
#include <vector>

#include "gloam/error.h"
#include "gloam/scene/scene.h"
#include "support/long.h"

namespace gloam::scenes_organic_test {
namespace {

const Mesh& mesh_named(const Scene& scene, const std::string& name) {
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.name == name) return mesh;
  }
  throw Error("{}: no mesh '{}'", scene.name, name);
}

/// Edges that are not shared by exactly two triangles, one in each direction.
size_t open_edges(const Mesh& mesh) {
  std::map<std::pair<unsigned, unsigned>, int> uses;  // by direction
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) ++uses[{t[i], t[(i + 1) % 3]}];
  }
  size_t open = 0;
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    open += count != 1 || back == uses.end() || back->second != 1;
  }
  return open;
}

/// Positive if triangles are counter-clockwise seen from outside.
double signed_volume(const Mesh& mesh, size_t first, size_t count) {
  double volume = 0;
  for (size_t i = first; i < first + count; ++i) {
    const glm::uvec3 t = mesh.triangles[i];
    const glm::dvec3 origin(mesh.positions[mesh.triangles[first].x]);  // near, so that little is lost to rounding
    const glm::dvec3 a = glm::dvec3(mesh.positions[t.x]) - origin, b = glm::dvec3(mesh.positions[t.y]) - origin;
    volume += glm::dot(a, glm::cross(b, glm::dvec3(mesh.positions[t.z]) - origin)) / 6;
  }
  return volume;
}

/// Share of triangles whose winding disagrees with the normals of their vertices.
double share_against_normals(const Mesh& mesh) {
  size_t against = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    against += glm::dot(glm::cross(b - a, c - a), mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z]) < 0;
  }
  return double(against) / double(mesh.triangles.size());
}

/// The number of the mesh's parts that share no vertex.
size_t parts(const Mesh& mesh) {
  std::vector<unsigned> parent(mesh.positions.size());
  for (size_t i = 0; i < parent.size(); ++i) parent[i] = unsigned(i);
  const auto root = [&](unsigned i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const glm::uvec3& t : mesh.triangles) {
    parent[root(t.x)] = root(t.y);
    parent[root(t.z)] = root(t.y);
  }
  size_t count = 0;
  for (size_t i = 0; i < parent.size(); ++i) count += parent[i] == i;
  return count;
}

template <typename T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void expect_same_scene(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (size_t i = 0; i < a.meshes.size(); ++i) {
    const Mesh &x = a.meshes[i], &y = b.meshes[i];
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.material, y.material) << x.name;
    EXPECT_TRUE(same_bits(x.positions, y.positions)) << x.name;
    EXPECT_TRUE(same_bits(x.normals, y.normals)) << x.name;
    EXPECT_TRUE(same_bits(x.triangles, y.triangles)) << x.name;
  }
}

void expect_refused(const std::string& scene, const Settings& settings) {
  try {
    load_scene(scene, settings);
    ADD_FAILURE() << scene << " takes " << settings[0].first << " = " << settings[0].second;
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find(settings[0].first), std::string::npos) << error.what();
  }
}

class OrganicScene : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(All, OrganicScene, testing::Values("hairball", "fence", "foliage", "statue"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(OrganicScene, CanBeTracedAndSeen) {
  const Scene scene = load_scene(GetParam(), {});
  EXPECT_NO_THROW(check(scene));
  ASSERT_GE(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[0].name, "main");
  for (const Mesh& mesh : scene.meshes) {
    ASSERT_FALSE(mesh.triangles.empty()) << mesh.name;
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size()) << mesh.name;
    for (const glm::vec3& normal : mesh.normals) ASSERT_NEAR(glm::length(normal), 1, 1e-3) << mesh.name;
  }
}

TEST_P(OrganicScene, FacesTheWayItsNormalsSay) {
  for (const Mesh& mesh : load_scene(GetParam(), {}).meshes) EXPECT_LE(share_against_normals(mesh), 0.02) << mesh.name;
}

TEST_P(OrganicScene, HasNoTriangleWithoutArea) {
  for (const Mesh& mesh : load_scene(GetParam(), {}).meshes) {
    size_t without = 0;
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
      without += !(glm::length(glm::cross(b - a, c - a)) > 0);
    }
    EXPECT_EQ(without, 0u) << mesh.name;
  }
}

TEST_P(OrganicScene, IsTheSameEveryTime) {
  const Settings few = std::string(GetParam()) == "statue" ? Settings{{"faces", "30000"}} : Settings{};
  expect_same_scene(load_scene(GetParam(), few), load_scene(GetParam(), few));
}

TEST(OrganicScenes, AreAsBusyAsTheySay) {
  const auto faces = [](const char* name) { return load_scene(name, {}).faces(); };
  EXPECT_GE(faces("hairball"), 300000u);
  EXPECT_LE(faces("hairball"), 1000000u);
  EXPECT_GE(faces("foliage"), 200000u);
  EXPECT_LE(faces("foliage"), 800000u);
  EXPECT_GE(faces("fence"), 200000u);
}

TEST(Hairball, FacesFollowStrands) {
  const size_t floor = mesh_named(load_scene("hairball", {{"strands", "10"}}), "floor").triangles.size();
  for (const size_t strands : {10u, 100u, 1000u})
    EXPECT_EQ(load_scene("hairball", {{"strands", std::to_string(strands)}}).faces(), floor + 330 * strands);
}

TEST(Hairball, EveryStrandIsClosedAndTurnedOutward) {
  const Scene scene = load_scene("hairball", {{"strands", "200"}});
  size_t strands = 0;
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.name == "floor") continue;
    EXPECT_EQ(open_edges(mesh), 0u) << mesh.name;
    ASSERT_EQ(mesh.triangles.size() % 330, 0u) << mesh.name;
    EXPECT_EQ(parts(mesh), mesh.triangles.size() / 330) << mesh.name;
    for (size_t first = 0; first < mesh.triangles.size(); first += 330, ++strands)
      EXPECT_GT(signed_volume(mesh, first, 330), 0) << mesh.name << ", strand from triangle " << first;
  }
  EXPECT_EQ(strands, 200u);
}

TEST(Hairball, StaysAboveItsFloor) {
  for (const Mesh& mesh : load_scene("hairball", {}).meshes) {
    for (const glm::vec3& p : mesh.positions) ASSERT_GE(p.y, 0) << mesh.name;
  }
}

TEST(Hairball, RefusesStrandsOutOfRange) {
  for (const char* strands : {"9", "20001", "-1", "many"}) expect_refused("hairball", {{"strands", strands}});
}

TEST(Statue, IsOneClosedSurfaceAtEveryNumberOfFaces) {
  ONLY_IN_LONG_RUN();
  for (const char* faces : {"5000", "50000", "200000", "500000"}) {
    const Scene scene = load_scene("statue", {{"faces", faces}});
    const Mesh& statue = mesh_named(scene, "statue");
    EXPECT_EQ(open_edges(statue), 0u) << faces;
    EXPECT_GT(signed_volume(statue, 0, statue.triangles.size()), 0) << faces;
    EXPECT_EQ(parts(statue), 1u) << faces;
    EXPECT_GT(double(statue.triangles.size()), 0.5 * std::stod(faces));
  }
}

TEST(Statue, FacesAreAsAskedFor) {
  ONLY_IN_LONG_RUN();
  for (const double faces : {5000, 7000, 20000, 50000, 200000, 500000}) {
    const Scene scene = load_scene("statue", {{"faces", std::to_string(int(faces))}});
    EXPECT_NEAR(double(scene.faces()), faces, 0.02 * faces);
  }
  for (const double faces : {1000, 1500, 3000}) {
    const Scene scene = load_scene("statue", {{"faces", std::to_string(int(faces))}});
    EXPECT_NEAR(double(scene.faces()), faces, 0.15 * faces);
  }
}

TEST(Statue, RefusesFacesOutOfRange) {
  for (const char* faces : {"999", "5000001", "-5", "lots"}) expect_refused("statue", {{"faces", faces}});
}

TEST(FenceAndFoliage, HaveNoSettings) {
  expect_refused("fence", {{"rows", "3"}});
  expect_refused("foliage", {{"trees", "3"}});
}

}  // namespace
}  // namespace gloam::scenes_organic_test
