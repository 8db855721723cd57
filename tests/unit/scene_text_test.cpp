// OBJ, MTL and glTF files in forms that are legal and rare: numbers, line ends, statements, names.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "gloam/error.h"
#include "gloam/scene/capture.h"
#include "gloam/scene/import.h"
#include "gloam/scene/scene.h"
#include "gloam/scene/tracer.h"

namespace gloam::scene_text_test {
namespace {

using namespace gloam;
namespace fs = std::filesystem;

class SceneText : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "gloam_scene_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path put(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  Scene obj(const std::string& text) const { return import_scene(put("scene.obj", text)); }
  std::string refusal(const std::string& text) const {
    try {
      obj(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "(read)";
  }
  static std::string notes_of(const Scene& scene) {
    std::string all;
    for (const std::string& note : scene.notes) all += note + "\n";
    return all;
  }

  fs::path folder_;
};

/// Positions of the corners of all triangles.
std::vector<glm::dvec3> corners_of(const Scene& scene) {
  std::vector<glm::dvec3> corners;
  for (const Mesh& mesh : scene.meshes)
    for (const glm::uvec3& t : mesh.triangles)
      for (const unsigned i : {t.x, t.y, t.z}) corners.push_back(scene.origin + glm::dvec3(mesh.positions[i]));
  return corners;
}

void expect_same(const Scene& scene, const Scene& expected, const std::string& what) {
  const auto a = corners_of(scene), b = corners_of(expected);
  ASSERT_EQ(a.size(), b.size()) << what;
  for (size_t i = 0; i < a.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[i][axis], b[i][axis], 1e-6) << what << " corner " << i;
}

TEST_F(SceneText, NumbersOfEveryFormAreRead) {
  const Scene plain = obj("v 0.5 0 0\nv -0.5 0 0\nv 5.0 0.001 0\nv 1 0.25 -0.125\nf 1 2 3\nf 2 3 4\n");
  ASSERT_EQ(corners_of(plain).size(), 6u);
  for (const std::string& text :
       {std::string("v .5 0 0\nv -.5 0 0\nv 5. 1e-3 0\nv +1 +.25 -.125\nf 1 2 3\nf 2 3 4\n"),
        std::string("v\t.5\t0\t0\r\nv -.5 0 0\r\nv 5 1E-3 .0\r\nv 1. 25e-2 -125.e-3\r\nf 1 2 3\r\nf 2 3 4"),
        std::string("v .5 \\\n0 0\nv -.5 0 \\\n 0\nv 5 .001 0 1\nv 1 .25 -.125 1.0\nf -4 -3 -2\nf 2 \\\n3 4\n"),
        std::string("# a comment\nv .5 0 0 .1 .2 .3\nv -.5 0 0 1 1 1\nv 5 .001 0 0 0 0\nv 1 .25 -.125 .5 .5 .5\n"
                    "vt .5 .5\nvn 0 .0 1.\nf 1/1/1 2/1/1 3/1/1\nf 2//1 3//1 4//1\n")})
    expect_same(obj(text), plain, text);
}

TEST_F(SceneText, AVertexThatIsNoNumberLeavesTheOthersWhereTheyAre) {
  for (const char* odd : {"nan", "inf", "-inf", "1e999", "-nan(ind)", "1.#QNAN"}) {
    const Scene scene =
        obj(std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nv ") + odd + " 0 0\nv 0 0 7\nf 1 2 3\nf 2 3 4\nf 1 2 5\n");
    const auto corners = corners_of(scene);
    ASSERT_EQ(corners.size(), 6u) << odd;
    EXPECT_NEAR(corners[5].z, 7, 1e-6) << odd;
    EXPECT_NE(notes_of(scene).find("1 triangle was left out, with a vertex that is not finite"), std::string::npos)
        << odd;
  }
}

TEST_F(SceneText, AWordInPlaceOfANumberIsRefusedWithItsLine) {
  const std::string said = refusal("v 0 0 0\nv 1 0 0\n\nv 0 x1 0\nf 1 2 3\n");
  EXPECT_NE(said.find("scene.obj: line 4: 'x1' of 'v' is no number"), std::string::npos) << said;
}

TEST_F(SceneText, StatementsThatAreNotKnownLeaveTheMaterialAsItIs) {
  put("scene.mtl",
      "newmtl a\nKd .25 .5 1.\naniso .5\nanisor .25\nNs +10.\nd -halo .5\nnewmtl b\nKd spectral grey.rfl 1\nKe xyz 1 1 "
      "1\n"
      "Pr .5\nillum 2\n");
  const Scene scene = obj("mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n");
  ASSERT_EQ(scene.meshes.size(), 2u);
  const Material& a = scene.materials[size_t(scene.meshes[0].material)];
  EXPECT_NEAR(a.albedo.y, 0.5, 0.3);
  EXPECT_LT(a.albedo.x, a.albedo.y);
  EXPECT_LT(a.albedo.y, a.albedo.z);
  EXPECT_NE(notes_of(scene).find("Kd spectral"), std::string::npos) << notes_of(scene);
  EXPECT_NE(notes_of(scene).find("Ke xyz"), std::string::npos) << notes_of(scene);
}

TEST_F(SceneText, BuffersWhoseNamesHaveEscapesAreFound) {
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 2, 0};
  put("my buffer.bin", std::string(reinterpret_cast<const char*>(positions), sizeof positions));
  const fs::path path = put("scene.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "buffers": [{"uri": "my%20buffer.bin", "byteLength": 36}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 2, 0]}]})");
  const auto corners = corners_of(import_scene(path));
  ASSERT_EQ(corners.size(), 3u);
  EXPECT_EQ(corners[2], glm::dvec3(0, 2, 0));
}

/// Embree ends the program if a ray or a vertex is farther away.
TEST_F(SceneText, WhatIsTooFarAwayToTraceIsRefusedWithItsNumber) {
  const std::string far = refusal("v 0 0 0\nv 1e20 0 0\nv 0 1e20 0\nf 1 2 3\n");
  EXPECT_NE(far.find("1e+20"), std::string::npos) << far;
  Scene scene = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Tracer tracer(scene);
  for (const double away : {1e19, 1e20, 1e30}) {
    for (const glm::dvec3& direction : {glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0)}) {
      try {
        tracer.first({glm::dvec3(-0.2, -0.2, away), direction});
        FAIL() << away;
      } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("up to 1e+18 is traced"), std::string::npos) << error.what();
      }
    }
  }
  EXPECT_TRUE(tracer.first({glm::dvec3(-0.2, -0.2, 1e6), glm::dvec3(0, 0, -1)}));
  scene.meshes[0].positions[1].x = 1e19f;
  try {
    const Tracer beyond(scene);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("1e+19"), std::string::npos) << error.what();
  }
}

}  // namespace

}  // namespace gloam::scene_text_test
