// Scenes from files: contents, conventions, and broken files.
#include "gloam/scene/import.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "gloam/error.h"
#include "gloam/scene/scene.h"

namespace gloam::import_test {
namespace {

using namespace gloam;
using nlohmann::json;
namespace fs = std::filesystem;

// --- Files

/// A folder that is removed after the test.
struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "gloam_import_XXXXXX").string();
    path = ::mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path); }
  fs::path put(const std::string& name, const std::string& bytes) const {
    std::ofstream(path / name, std::ios::binary) << bytes;
    return path / name;
  }
};

template <typename T>
void append(std::string& bytes, std::initializer_list<T> values) {
  for (T value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string base64(const std::string& bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63];
  }
  return text;
}

/// Uncompressed TGA, top row first. Texels as 0xAARRGGBB, which little-endian is TGA's own order.
std::string tga(int width, int height, const std::vector<uint32_t>& texels) {
  std::string bytes(18, '\0');
  bytes[2] = 2, bytes[12] = char(width), bytes[14] = char(height), bytes[16] = 32, bytes[17] = 0x28;
  for (uint32_t texel : texels) append(bytes, {texel});
  return bytes;
}

/// 2x2: red, green / blue, white with alpha 64.
const std::string png =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAE0lEQVR4nGP4z8DwHwyBNAg4AABJCQk46UZ9UwAAAABJRU5ErkJggg==";

/// One triangle (0,0,0) (1,0,0) (0,1,0) with normals +z and texture coordinates (0,0) (1,0) (0,1), as a glTF file with
/// one mesh and no node.
std::string triangle_bytes() {
  std::string bytes;
  append<float>(bytes, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  append<float>(bytes, {0, 0, 1, 0, 0, 1, 0, 0, 1});
  append<float>(bytes, {0, 0, 1, 0, 0, 1});
  append<uint32_t>(bytes, {0, 1, 2});
  return bytes;
}

json triangle_gltf(const std::string& bytes = triangle_bytes()) {
  json file = json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"name": "one", "mesh": 0}],
    "meshes": [{"name": "triangle", "primitives": [
      {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
      {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"},
      {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2"},
      {"bufferView": 3, "componentType": 5125, "count": 3, "type": "SCALAR"}],
    "bufferViews": [
      {"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 36},
      {"buffer": 0, "byteOffset": 72, "byteLength": 24}, {"buffer": 0, "byteOffset": 96, "byteLength": 12}]})");
  file["buffers"] = {{{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
  return file;
}

json with_material(json file, const json& material) {
  file["materials"] = json::array({material});
  file["meshes"][0]["primitives"][0]["material"] = 0;
  file["textures"] = json::array({{{"source", 0}}});
  file["images"] = json::array({{{"uri", "data:image/png;base64," + png}}});
  return file;
}

std::string glb(json file, std::string binary) {
  if (file.contains("buffers")) file["buffers"][0].erase("uri");
  std::string text = file.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4);
  std::string bytes = "glTF";
  append<uint32_t>(bytes, {2, uint32_t(28 + text.size() + binary.size()), uint32_t(text.size())});
  bytes += "JSON" + text;
  append<uint32_t>(bytes, {uint32_t(binary.size())});
  return bytes + std::string("BIN\0", 4) + binary;
}

Scene import_text(const std::string& name, const std::string& bytes) {
  const Folder folder;
  return import_scene(folder.put(name, bytes));
}
Scene import_gltf(const json& file) { return import_text("scene.gltf", file.dump()); }

// --- Properties to compare

/// Corners of a triangle in the world, in the triangle's order.
std::vector<glm::dvec3> corners(const Scene& scene, size_t mesh = 0, size_t triangle = 0) {
  const Mesh& m = scene.meshes.at(mesh);
  const glm::uvec3 t = m.triangles.at(triangle);
  std::vector<glm::dvec3> result;
  for (int i = 0; i < 3; ++i) result.push_back(glm::dvec3(m.positions.at(t[i])) + scene.origin);
  return result;
}

glm::dvec3 face_normal(const Scene& scene, size_t mesh = 0, size_t triangle = 0) {
  const auto c = corners(scene, mesh, triangle);
  return glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double bound) {
  EXPECT_LE(glm::distance(a, b), bound) << a.x << " " << a.y << " " << a.z << ", not " << b.x << " " << b.y << " "
                                        << b.z;
}

const SceneCamera& camera_named(const Scene& scene, const std::string& name) {
  for (const SceneCamera& camera : scene.cameras)
    if (camera.name == name) return camera;
  throw Error("no camera {}", name);
}

std::string all_notes(const Scene& scene) {
  std::string text;
  for (const std::string& note : scene.notes) text += note + "\n";
  return text;
}

void expect_note(const Scene& scene, const std::string& part) {
  EXPECT_NE(all_notes(scene).find(part), std::string::npos) << "no '" << part << "' in:\n" << all_notes(scene);
}

std::string refusal(const fs::path& path) {
  try {
    import_scene(path);
  } catch (const Error& e) {
    return e.what();
  }
  return "(read)";
}

const std::string one_triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

// --- Meshes

TEST(Import, ObjMeshesStandWhereTheFileSays) {
  const Scene scene = import_text("box.obj",
                                  "o first\nv 10 0 0\nv 12 0 0\nv 12 4 0\nv 10 4 0\nf 1 2 3 4\n"
                                  "o second\nv 10 0 4\nv 12 0 4\nv 12 4 4\nf 5 6 7\n");
  EXPECT_EQ(scene.name, "box.obj");
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.meshes[0].name, "first");
  EXPECT_EQ(scene.meshes[1].name, "second");
  EXPECT_EQ(scene.meshes[0].triangles.size(), 2u);
  EXPECT_EQ(scene.origin, glm::dvec3(11, 2, 2));
  EXPECT_EQ(corners(scene, 1)[2], glm::dvec3(12, 4, 4));
  EXPECT_EQ(face_normal(scene, 0, 0), glm::dvec3(0, 0, 1));
  EXPECT_EQ(face_normal(scene, 0, 1), glm::dvec3(0, 0, 1));
  EXPECT_TRUE(scene.meshes[0].normals.empty());
  EXPECT_TRUE(scene.meshes[0].uvs.empty());
  EXPECT_EQ(scene.up, glm::dvec3(0, 1, 0));
  EXPECT_EQ(scene.ao_radius, 0);  // files do not state it
  EXPECT_EQ(all_notes(scene), "");
  check(scene);
}

TEST(Import, EveryInstanceIsAMeshInPlace) {
  json file = triangle_gltf();
  file["scenes"][0]["nodes"] = {0, 1};
  file["nodes"] = json::parse(R"([{"name": "left", "mesh": 0, "translation": [1e7, 0, 0]},
    {"name": "group", "translation": [10000002, 0, 0], "children": [2]},
    {"name": "right", "mesh": 0, "translation": [0.5, 0, 0], "scale": [2, 2, 2]}])");
  const Scene scene = import_gltf(file);
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.meshes[0].name, "left");
  EXPECT_EQ(scene.meshes[1].name, "right");
  EXPECT_EQ(corners(scene, 0)[1], glm::dvec3(10000001, 0, 0));
  EXPECT_EQ(corners(scene, 1)[0], glm::dvec3(10000002.5, 0, 0));  // float has steps of 1 here
  EXPECT_EQ(corners(scene, 1)[1], glm::dvec3(10000004.5, 0, 0));
  EXPECT_EQ(all_notes(scene), "");
}

TEST(Import, MirroredInstancesKeepTheirOutside) {
  json file = triangle_gltf();
  file["nodes"][0]["scale"] = {-1, 1, 1};
  const Scene scene = import_gltf(file);
  EXPECT_EQ(face_normal(scene), glm::dvec3(0, 0, 1));
  EXPECT_EQ(scene.meshes[0].normals.at(0), glm::vec3(0, 0, 1));
  file["nodes"][0]["scale"] = {1, 1, -1};  // faces the other way
  const Scene turned = import_gltf(file);
  EXPECT_EQ(face_normal(turned), glm::dvec3(0, 0, -1));
  EXPECT_EQ(turned.meshes[0].normals.at(0), glm::vec3(0, 0, -1));
}

TEST(Import, NormalsStayPerpendicularWhereScaleIsNotUniform) {
  std::string bytes = triangle_bytes();
  const float slope = std::sqrt(0.5f);  // the triangle is tilted about x: its normal is (0, -1, 1)
  std::string tilted;
  append<float>(tilted, {0, 0, 0, 1, 0, 0, 0, 1, 1});
  append<float>(tilted, {0, -slope, slope, 0, -slope, slope, 0, -slope, slope});
  bytes.replace(0, tilted.size(), tilted);
  for (const json& scale : {json{1, 4, 1}, json{3, 0.5, -2}, json{-0.01, 100, 1}}) {
    json file = triangle_gltf(bytes);
    file["nodes"][0]["scale"] = scale;
    const Scene scene = import_gltf(file);
    expect_near(glm::dvec3(scene.meshes.at(0).normals.at(0)), face_normal(scene), 1e-6);
  }
}

TEST(Import, TextureCoordinatesStartAtTheTopLeft) {
  const Folder folder;
  folder.put("four.tga", tga(2, 2, {0xffff0000, 0xff00ff00, 0xff0000ff, 0xffffffff}));
  folder.put("a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd four.tga\n");
  const Scene obj = import_scene(folder.put("a.obj",
                                            "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0.25 1\n"
                                            "usemtl m\nf 1/1 2/2 3/3\n"));
  ASSERT_EQ(obj.textures.size(), 1u);
  EXPECT_EQ(std::vector<uint8_t>(obj.textures[0].texels.begin(), obj.textures[0].texels.begin() + 8),
            (std::vector<uint8_t>{255, 0, 0, 255, 0, 255, 0, 255}));                   // the top row
  EXPECT_EQ(obj.meshes[0].uvs, (std::vector<glm::vec2>{{0, 1}, {1, 1}, {0.25f, 0}}));  // OBJ: v up from the bottom
  const Scene gltf = import_gltf(
      with_material(triangle_gltf(), json::parse(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})")));
  ASSERT_EQ(gltf.textures.size(), 1u) << all_notes(gltf);
  EXPECT_EQ(gltf.textures[0].texels.at(5), 255);  // green, top right
  EXPECT_EQ(gltf.textures[0].texels.at(15), 64);
  EXPECT_EQ(gltf.meshes[0].uvs, (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}));
}

TEST(Import, TextureTransformsAreApplied) {
  json file = with_material(triangle_gltf(), json::parse(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0,
    "extensions": {"KHR_texture_transform": {"offset": [0.125, 0.25], "rotation": 0.5, "scale": [2, 3]}}}}})"));
  file["extensionsUsed"] = {"KHR_texture_transform"};
  const Scene scene = import_gltf(file);
  const auto expected = [](double u, double v) {  // the extension's text: offset + rotation * (scale * uv)
    const double c = std::cos(0.5), s = std::sin(0.5);
    return glm::dvec3(0.125 + c * 2 * u + s * 3 * v, 0.25 - s * 2 * u + c * 3 * v, 0);
  };
  const std::vector<glm::vec2>& uvs = scene.meshes.at(0).uvs;
  expect_near({uvs.at(0), 0}, expected(0, 0), 1e-6);
  expect_near({uvs.at(1), 0}, expected(1, 0), 1e-6);
  expect_near({uvs.at(2), 0}, expected(0, 1), 1e-6);
}

TEST(Import, OtherFormatsAreReadToo) {
  const Scene ply = import_text("a.ply",
                                "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                                "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
  EXPECT_EQ(ply.faces(), 2u);
  const Scene stl = import_text("a.stl",
                                "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                                "endloop\nendfacet\nendsolid a\n");
  EXPECT_EQ(stl.faces(), 1u);
}

// --- Materials

TEST(Import, GltfMaterialsAreTakenAsTheyAre) {
  const Scene scene = import_gltf(with_material(triangle_gltf(), json::parse(R"({"name": "lamp",
    "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 1], "roughnessFactor": 0.4, "metallicFactor": 0.6,
      "metallicRoughnessTexture": {"index": 0}},
    "emissiveFactor": [1, 0.5, 0.25], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}}})")));
  const Material& m = scene.materials.at(size_t(scene.meshes.at(0).material));
  EXPECT_EQ(m.name, "lamp");
  EXPECT_EQ(m.albedo, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(m.roughness, 0.4f);
  EXPECT_EQ(m.metallic, 0.6f);
  EXPECT_EQ(m.reflectance, 0.04f);
  EXPECT_EQ(m.emission, glm::vec3(8, 4, 2));
  EXPECT_EQ(m.albedo_texture, -1);
  EXPECT_EQ(m.roughness_texture, 0);
  EXPECT_EQ(m.metallic_texture, 0);
  EXPECT_EQ(m.emission_texture, -1);
  EXPECT_EQ(m.alpha_cutoff, 0);
}

TEST(Import, GltfAlphaBecomesACutoff) {
  const auto material = [](const char* mode, double alpha, bool textured) {
    json m = {{"name", "leaf"}, {"alphaMode", mode}, {"alphaCutoff", 0.25}};
    if (std::string(mode) != "MASK") m.erase("alphaCutoff");
    m["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, alpha};
    if (textured) m["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    return import_gltf(with_material(triangle_gltf(), m));
  };
  EXPECT_EQ(material("OPAQUE", 0.5, true).materials.at(0).alpha_cutoff, 0);
  EXPECT_EQ(material("MASK", 1, true).materials.at(0).alpha_cutoff, 0.25f);
  EXPECT_EQ(material("MASK", 0.5, true).materials.at(0).alpha_cutoff, 0.5f);  // 0.5 a < 0.25
  const Scene blended = material("BLEND", 1, true);
  EXPECT_EQ(blended.materials.at(0).alpha_cutoff, 0.5f);
  expect_note(blended, "material 'leaf': blending becomes a mask");
  const Scene glass = material("BLEND", 0.3, false);
  EXPECT_EQ(glass.materials.at(0).alpha_cutoff, 0);
  expect_note(glass, "material 'leaf': translucency is left out");
}

Scene import_mtl(const std::string& lines, const Folder& folder) {
  folder.put("a.mtl", "newmtl m\n" + lines);
  return import_scene(folder.put("a.obj",
                                 "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                                 "usemtl m\nf 1/1 2/2 3/3\n"));
}
const Material& used(const Scene& scene) { return scene.materials.at(size_t(scene.meshes.at(0).material)); }

TEST(Import, MtlMaterials) {
  const Folder folder;
  const Material phong = used(import_mtl("Kd 0.1 0.2 0.3\nKs 1 1 1\nKe 1 2 3\nNs 30\n", folder));
  EXPECT_EQ(phong.albedo, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(phong.emission, glm::vec3(1, 2, 3));
  EXPECT_FLOAT_EQ(phong.roughness, 0.5f);  // (2 / 32)^(1/4)
  EXPECT_EQ(phong.metallic, 0);
  EXPECT_EQ(phong.reflectance, 0.04f);
  EXPECT_FLOAT_EQ(used(import_mtl("Kd 1 1 1\n", folder)).roughness, 1);
  const Material physical = used(import_mtl("Kd 1 1 1\nNs 1000\nPr 0.3\nPm 0.7\n", folder));
  EXPECT_EQ(physical.roughness, 0.3f);
  EXPECT_EQ(physical.metallic, 0.7f);
  expect_note(import_mtl("Kd 1 1 1\nd 0.3\n", folder), "material 'm': translucency is left out");
}

TEST(Import, MtlOpacityMapBecomesTheAlphaOfTheAlbedo) {
  const Folder folder;
  folder.put("kd.tga", tga(1, 1, {0xff102030}));
  folder.put("d.tga", tga(2, 1, {0xff000000, 0xffc0c0c0}));
  const Scene scene = import_mtl("Kd 1 1 1\nmap_Kd kd.tga\nmap_d d.tga\n", folder);
  EXPECT_EQ(used(scene).alpha_cutoff, 0.5f);
  EXPECT_EQ(scene.textures.at(size_t(used(scene).albedo_texture)).texels,
            (std::vector<uint8_t>{0x10, 0x20, 0x30, 0, 0x10, 0x20, 0x30, 0xc0}));
  const Scene alone = import_mtl("Kd 1 1 1\nmap_d d.tga\n", folder);
  EXPECT_EQ(alone.textures.at(size_t(used(alone).albedo_texture)).texels,
            (std::vector<uint8_t>{255, 255, 255, 0, 255, 255, 255, 0xc0}));
}

TEST(Import, MtlEmissionMapShinesWithoutKe) {
  const Folder folder;
  folder.put("e.tga", tga(1, 1, {0xffffffff}));
  EXPECT_EQ(used(import_mtl("Kd 1 1 1\nmap_Ke e.tga\n", folder)).emission, glm::vec3(1));
  EXPECT_EQ(used(import_mtl("Kd 1 1 1\nmap_Ke nowhere.tga\nKe 1 1 1\n", folder)).emission, glm::vec3(0));
}

TEST(Import, TexturesAreFoundByOtherSpellings) {
  const Folder folder;
  fs::create_directory(folder.path / "maps");
  folder.put("maps/a b.tga", tga(1, 1, {0xffffffff}));
  folder.put("c.tga", tga(1, 1, {0xffffffff}));
  for (const char* name : {"maps\\a b.tga", "maps/a%20b.tga", "/home/someone/c.tga", "C:\\work\\c.tga"})
    EXPECT_EQ(used(import_mtl(fmt::format("Kd 1 1 1\nmap_Kd {}\n", name), folder)).albedo_texture, 0) << name;
}

TEST(Import, TexturesThatCannotBeReadAreNoted) {
  const Folder folder;
  folder.put("text.png", "this is no picture");
  folder.put("cut.tga", tga(2, 2, {0xffffffff}).substr(0, 10));
  std::string huge = tga(1, 1, {});
  huge[12] = huge[13] = huge[14] = huge[15] = char(0xff);  // claims 65535x65535 texels
  folder.put("huge.tga", huge);
  for (const char* name : {"nowhere.png", "text.png", "cut.tga", "huge.tga"}) {
    const Scene scene = import_mtl(fmt::format("Kd 0.1 0.2 0.3\nmap_Kd {}\n", name), folder);
    EXPECT_EQ(used(scene).albedo_texture, -1) << name;
    EXPECT_EQ(used(scene).albedo, glm::vec3(0.1f, 0.2f, 0.3f));
    expect_note(scene, fmt::format("texture '{}' cannot be read (", name));
  }
  folder.put("one.tga", tga(1, 1, {0xffffffff}));
  expect_note(import_mtl("Kd 1 1 1\nmap_Kd -clamp on one.tga\n", folder), "1 texture is clamped or mirrored");
}

TEST(Import, MissingMaterialFileIsNoted) {
  expect_note(import_text("a.obj", "mtllib nowhere.mtl\nusemtl m\n" + one_triangle), "material file 'nowhere.mtl'");
}

TEST(Import, MaterialFileWithoutAMaterialIsNoted) {
  const Folder folder;
  folder.put("a.mtl", "# words\nKd 1 0 0\nmap_Kd kd.tga\nPr 0.3\n");  // assimp 5.2 ends the program here
  expect_note(import_scene(folder.put("a.obj", "mtllib a.mtl\nusemtl m\n" + one_triangle)), "material file 'a.mtl'");
}

TEST(Import, GlbWithATexture) {
  std::string png_bytes;
  {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    unsigned word = 0, bits = 0;
    for (char c : png) {
      if (c == '=') break;
      word = word << 6 | unsigned(digits.find(c));
      if ((bits += 6) >= 8) png_bytes += char(word >> (bits -= 8) & 255);
    }
  }
  const std::string mesh = triangle_bytes();
  json file =
      with_material(triangle_gltf(), json::parse(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})"));
  file["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", mesh.size()}, {"byteLength", png_bytes.size()}});
  file["buffers"][0]["byteLength"] = mesh.size() + png_bytes.size();
  file["images"][0] = {{"bufferView", 4}, {"mimeType", "image/png"}};
  const Scene scene = import_text("a.glb", glb(file, mesh + png_bytes));
  ASSERT_EQ(scene.textures.size(), 1u) << all_notes(scene);
  EXPECT_EQ(scene.textures[0].width, 2);
  EXPECT_EQ(scene.textures[0].texels.at(15), 64);
  EXPECT_EQ(scene.meshes.at(0).positions.size(), 3u);
}

// --- Cameras

TEST(Import, GltfCameras) {
  json file = triangle_gltf();
  file["cameras"] =
      json::parse(R"([{"type": "perspective", "perspective": {"yfov": 0.8, "aspectRatio": 1.5, "znear": 1}},
    {"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 2, "znear": 1, "zfar": 10}},
    {"type": "perspective", "name": "own", "perspective": {"yfov": 0.8, "znear": 1}},
    {"type": "perspective", "perspective": {"yfov": 4, "znear": 1}}])");
  file["nodes"] = json::parse(R"([{"name": "one", "mesh": 0},
    {"name": "eye", "camera": 0, "translation": [1, 2, 3], "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476]},
    {"name": "moved", "translation": [10000000, 0, 0], "scale": [2, 2, 2], "children": [3]},
    {"name": "flat", "camera": 1, "translation": [4, 5, 6.125]},
    {"camera": 2}, {"name": "eye", "camera": 0}, {"name": "bad", "camera": 3}])");
  file["scenes"][0]["nodes"] = {0, 1, 2, 4, 5, 6};
  const Scene scene = import_gltf(file);
  ASSERT_EQ(scene.cameras.size(), 5u);
  const SceneCamera& eye = scene.cameras[0];
  EXPECT_EQ(eye.name, "eye");
  // tan of half the angle grows with the width, not the angle itself.
  EXPECT_NEAR(eye.fov_degrees, 2 * std::atan(std::tan(0.4) * 1.5) * 180 / glm::pi<double>(), 1e-9);
  EXPECT_EQ(eye.pose.position, glm::dvec3(1, 2, 3));
  // A quarter turn about y takes -z, where it looks, to -x.
  expect_near(eye.pose.world_to_view * glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, -1), 1e-12);
  expect_near(eye.pose.world_to_view * glm::dvec3(0, 1, 0), glm::dvec3(0, 1, 0), 1e-12);
  const SceneCamera& flat = scene.cameras[1];
  EXPECT_EQ(flat.name, "flat");
  EXPECT_TRUE(flat.orthographic);
  EXPECT_EQ(flat.width, 6);
  EXPECT_EQ(flat.pose.position, glm::dvec3(10000008, 10, 12.25));
  EXPECT_EQ(camera_named(scene, "own").pose.position, glm::dvec3(0));
  EXPECT_NEAR(camera_named(scene, "own").fov_degrees, 0.8 * 180 / glm::pi<double>(), 1e-9);
  EXPECT_EQ(camera_named(scene, "eye 2").pose.position, glm::dvec3(0));
  EXPECT_EQ(scene.cameras.back().name, "overview");
  expect_note(scene, "camera 'bad'");
}

TEST(Import, OverviewSeesEverything) {
  for (const char* size : {"1 1 1", "100 1 1", "1 100 1", "1 0 100", "0.001 0.002 0.003"}) {
    float x, y, z;
    ASSERT_EQ(std::sscanf(size, "%f %f %f", &x, &y, &z), 3);
    const Scene scene =
        import_text("a.obj", fmt::format("v 500 0 0\nv {} {} {}\nv {} 0 0\nf 1 2 3\n", 500 + x, y, z, 500 + x));
    ASSERT_EQ(scene.cameras.size(), 1u);
    const SceneCamera& overview = scene.cameras[0];
    EXPECT_EQ(overview.name, "overview");
    const Camera camera = camera_for(overview, 1600, 900);
    double left = 1600, right = 0, top = 900, bottom = 0;
    for (int i = 0; i < 8; ++i) {
      const glm::dvec3 corner(500 + (i & 1 ? x : 0), i & 2 ? y : 0, i & 4 ? z : 0);
      const glm::dvec3 v = overview.pose.world_to_view * (corner - overview.pose.position);
      ASSERT_LT(v.z, 0) << size;
      const double px = camera.cx - camera.fx * v.x / v.z, py = camera.cy + camera.fy * v.y / v.z;
      left = std::min(left, px), right = std::max(right, px), top = std::min(top, py), bottom = std::max(bottom, py);
    }
    EXPECT_GE(left, 0) << size;
    EXPECT_LE(right, 1600) << size;
    EXPECT_GE(top, 0) << size;
    EXPECT_LE(bottom, 900) << size;
    EXPECT_GT(std::max((right - left) / 1600, (bottom - top) / 900), 0.45) << size;         // and not from afar
    EXPECT_GT((glm::transpose(overview.pose.world_to_view) * glm::dvec3(0, 0, 1)).y, 0.3);  // from above
  }
}

// --- Repairs

TEST(Import, TrianglesOfNoUseAreLeftOut) {
  const Scene scene = import_text("a.obj", one_triangle +
                                               "v nan 0 0\nv 1 inf 0\nv 2 2 2\nv 0.5 0.5 0\n"
                                               "f 1 2 4\nf 1 2 5\nf 1 2 2\nf 2 7 3\np 1\nl 1 2\nl 1 3\n");
  EXPECT_EQ(scene.faces(), 1u);
  expect_note(scene, "2 triangles were left out, with vertices that are not finite");
  expect_note(scene, "2 triangles were left out, without an area");
  expect_note(scene, "3 points and lines were left out");
  EXPECT_EQ(scene.origin, glm::dvec3(0.5, 0.5, 0));  // neither the stray vertex nor infinity counts
  check(scene);
}

TEST(Import, BrokenNormalsAreMadeFromTheFaces) {
  const std::string positions = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nvn nan 0 1\nvn 0 0.6 0.8\n";
  const Scene some = import_text("a.obj", positions + "f 1//1 2//2 3//3\n");
  EXPECT_EQ(some.meshes.at(0).normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 1}, {0, 0.6f, 0.8f}}));
  expect_note(some, "2 vertex normals were zero or not finite");
  const Scene all = import_text("a.obj", positions + "f 1//1 2//2 3//1\n");
  EXPECT_TRUE(all.meshes.at(0).normals.empty());
  expect_note(all, "3 vertex normals were zero or not finite");
}

TEST(Import, CoordinatesFarFromZero) {
  const auto at = [](const char* x) { return fmt::format("v {0} 0 0\nv {0} 1000 0\nv {0} 0 1000\nf 1 2 3\n", x); };
  const Scene far = import_text("a.obj", at("1e7"));
  EXPECT_EQ(far.origin.x, 1e7);
  EXPECT_EQ(far.meshes.at(0).positions.at(0).x, 0);
  expect_note(far, "vertices lie up to 1e+07 from zero, where float has steps of 1");
  EXPECT_EQ(all_notes(import_text("a.obj", at("1000"))), "");
  const Folder folder;
  EXPECT_NE(refusal(folder.put("b.obj", at("1e16"))).find("has a vertex at (1e+16, "), std::string::npos);
}

// --- Refusals

TEST(Import, RefusalsAreOneLineThatNamesFileAndReason) {
  const Folder folder;
  fs::create_directory(folder.path / "folder.obj");
  json no_bin = triangle_gltf(), draco = triangle_gltf(), old = triangle_gltf(), circle = triangle_gltf(), deep;
  no_bin["buffers"][0]["uri"] = "nowhere.bin";
  draco["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  old["asset"]["version"] = "1.0";
  circle["nodes"] = json::parse(R"([{"children": [1]}, {"children": [0]}])");
  json chain = triangle_gltf();
  for (int i = 1; i < 5000; ++i) {
    chain["nodes"].push_back({{"mesh", 0}});
    chain["nodes"][size_t(i) - 1] = {{"children", {i}}};
  }
  const std::string whole = glb(triangle_gltf(), triangle_bytes());
  const std::vector<std::array<std::string, 3>> cases = {
      {"nowhere.obj", "", "no such file"},
      {"folder.obj", "", "is a folder"},
      {"empty.obj", "", "is empty"},
      {"empty.glb", "", "is empty"},
      {"text.txt", "Some words, and then some more of them.\n", "is no scene"},
      {"text.obj", "Some words, and then some more of them.\n", "has no triangles"},
      {"points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\nl 1 2\n", "has no triangles, only"},
      {"flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "has no triangles, only 1 triangle without an area"},
      {"range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "out of range"},
      {"range.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n4 0 1 2 9000000\n",
       "has a face with vertex 9000000, and there are 3"},
      {"endless.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nelement fa", "it ends too early"},
      {"unfaced.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0",
       "has no triangles"},
      {"nothing.gltf", R"({"asset": {"version": "2.0"}})", "No scene"},
      {"cut.gltf", triangle_gltf().dump().substr(0, 200), "is not glTF: parse error at line 1"},
      {"words.gltf", "not json at all", "is not glTF"},
      {"list.gltf", "[1, 2]", "it has no asset.version"},
      {"no_bin.gltf", no_bin.dump(), "nowhere.bin"},
      {"draco.gltf", draco.dump(), "KHR_draco_mesh_compression"},
      {"old.gltf", old.dump(), "is glTF 1.0; glTF 2 is read"},
      {"circle.gltf", circle.dump(), "or is its own"},
      {"chain.gltf", chain.dump(), "more than 1000 levels deep"},
      {"deep.gltf",
       R"({"asset": {"version": "2.0"}, "extras": )" + std::string(200000, '[') + std::string(200000, ']') + "}",
       "more than 200 levels deep"},
      {"magic.glb", "this is text, not a binary glTF file", "does not begin with"},
      {"short.glb", "glTF", "is cut short: a GLB file has 20 bytes and more, and there are 4"},
      {"cut.glb", whole.substr(0, whole.size() - 40), "is cut short: its header says"},
  };
  for (const auto& [name, text, reason] : cases) {
    if (reason != "no such file" && reason != "is a folder") folder.put(name, text);
    const std::string said = refusal(folder.path / name);
    EXPECT_NE(said.find(reason), std::string::npos) << name << ": " << said;
    EXPECT_NE(said.find(name), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    EXPECT_EQ(said.find("\\x"), std::string::npos) << said;
  }
}

TEST(Import, FilesWithoutPermissionAreRefused) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const Folder folder;
  const fs::path path = folder.put("a.obj", one_triangle);
  fs::permissions(path, fs::perms::none);
  EXPECT_NE(refusal(path).find("cannot be opened"), std::string::npos);
}

/// Any damaged or incomplete file is either a scene that can be traced, or one line.
void expect_scene_or_line(const fs::path& path, const std::string& what) {
  try {
    const Scene scene = import_scene(path);
    check(scene);
    EXPECT_FALSE(scene.cameras.empty()) << what;
  } catch (const Error& e) {
    const std::string said = e.what();
    EXPECT_FALSE(said.empty()) << what;
    EXPECT_EQ(said.find('\n'), std::string::npos) << what << ": " << said;
  }
}

TEST(Import, DamagedFilesAreReadOrRefused) {
  const Folder folder;
  folder.put("a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd four.tga\n");
  folder.put("four.tga", tga(2, 2, {0xffff0000, 0xff00ff00, 0xff0000ff, 0xffffffff}));
  json file =
      with_material(triangle_gltf(), json::parse(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})"));
  const std::vector<std::pair<std::string, std::string>> wholes = {
      {"a.glb", glb(file, triangle_bytes())},
      {"a.obj",
       "mtllib a.mtl\no first\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nusemtl m\n"
       "f 1/1/1 2/2/1 3/3/1\nf 1//1 2//1 3//1 4//1\no second\nf -4 -3 -1\ns off\nl 1 2\n"}};
  for (const auto& [name, whole] : wholes) {
    std::mt19937 random(7);
    for (int i = 0; i < 300; ++i) {
      std::string damaged = whole.substr(0, i < 150 ? random() % (whole.size() + 1) : whole.size());
      const int flips = i < 100 ? 0 : 1 + int(random() % 4);
      for (int k = 0; k < flips && !damaged.empty(); ++k) damaged[random() % damaged.size()] = char(random());
      // A cut GLB states its length in its header, and would be refused for that alone.
      if (name == "a.glb" && damaged.size() >= 12 && i % 2 == 0) {
        const uint32_t size = uint32_t(damaged.size());
        std::memcpy(damaged.data() + 8, &size, 4);
      }
      expect_scene_or_line(folder.put(name, damaged), fmt::format("{}, variant {}", name, i));
    }
  }
}

}  // namespace

}  // namespace gloam::import_test
