#include "scene/gltf_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "base/file_ledger.h"
#include "base/files.h"
#include "base/json_text.h"
#include "base/words.h"
#include "gloam/error.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// assimp's parser and its walk over nodes recurse; some ten thousand levels end the program. The JSON is shallow, since only
/// shallow JSON is read (json_text.h).
constexpr int deepest_node = 1000;

// --- The JSON text

uint32_t word(const std::array<char, 20>& header, size_t index) {
  std::array<uint8_t, 4> bytes;
  std::memcpy(bytes.data(), header.data() + 4 * index, 4);
  return uint32_t(bytes[0]) | uint32_t(bytes[1]) << 8 | uint32_t(bytes[2]) << 16 | uint32_t(bytes[3]) << 24;
}

/// The first chunk of a GLB: magic, version, length of the file; then length, "JSON" and text of the chunk.
std::string json_of_glb(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  opens_file(path);
  const uint64_t size = fs::file_size(path);
  std::array<char, 20> header{};
  if (!file.read(header.data(), header.size()))
    throw Error("{}: is cut short: a GLB file has 20 bytes and more, and there are {}", path.string(), size);
  if (std::string_view(header.data(), 4) != "glTF")
    throw Error("{}: is not a GLB file: it does not begin with \"glTF\"", path.string());
  if (word(header, 1) != 2) throw Error("{}: is GLB version {}; version 2 is read", path.string(), word(header, 1));
  if (word(header, 2) > size)
    throw Error("{}: is cut short: its header says {} bytes, and there are {}", path.string(), word(header, 2), size);
  if (word(header, 3) > size - header.size())
    throw Error("{}: its JSON claims {} bytes, and {} are left", path.string(), word(header, 3), size - header.size());
  std::string text(word(header, 3), '\0');
  file.read(text.data(), std::streamsize(text.size()));
  return text;
}

json parsed(const fs::path& path) {
  const std::string ending = path.extension().string();
  const bool binary = ending.size() == 4;
  const std::string text = binary ? json_of_glb(path) : read_text(path);
  return standard_json(text, path.string(), "is not glTF");
}

// --- Fields that may be missing or of another type

const json& member(const json& object, const char* name) {
  static const json none;
  if (!object.is_object()) return none;
  const auto found = object.find(name);
  return found == object.end() ? none : *found;
}

const json& element(const json& list, const json& index) {
  static const json none;
  if (!list.is_array() || !index.is_number_unsigned() || index.get<size_t>() >= list.size()) return none;
  return list[index.get<size_t>()];
}

std::string text_of(const json& value) { return value.is_string() ? value.get<std::string>() : ""; }
double number_of(const json& value, double otherwise) { return value.is_number() ? value.get<double>() : otherwise; }

template <int N>
std::array<double, N> numbers_of(const json& value, std::array<double, N> otherwise) {
  if (!value.is_array() || value.size() != N) return otherwise;
  for (int i = 0; i < N; ++i) otherwise[size_t(i)] = number_of(value[size_t(i)], otherwise[size_t(i)]);
  return otherwise;
}

// --- What is refused

void check_version(const json& file, const fs::path& path) {
  const std::string version = text_of(member(member(file, "asset"), "version"));
  if (version.empty()) throw Error("{}: is not glTF: it has no asset.version", path.string());
  if (!version.starts_with("2")) throw Error("{}: is glTF {}; glTF 2 is read", path.string(), version);
}

void check_extensions(const json& file, const fs::path& path) {
  const std::set<std::string> unreadable = {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                            "KHR_mesh_quantization"};
  for (const json& name : member(file, "extensionsRequired")) {
    if (unreadable.count(text_of(name)))
      throw Error("{}: its meshes need {}, which is not read; export it without compression", path.string(),
                  text_of(name));
  }
}

// --- Nodes and cameras

glm::dmat4 transform_of(const json& node) {
  if (member(node, "matrix").is_array()) {
    const auto m = numbers_of<16>(node["matrix"], {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = m[size_t(i)];  // both by columns
    return matrix;
  }
  const auto t = numbers_of<3>(member(node, "translation"), {0, 0, 0});
  const auto r = numbers_of<4>(member(node, "rotation"), {0, 0, 0, 1});
  const auto s = numbers_of<3>(member(node, "scale"), {1, 1, 1});
  const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), glm::dvec3(t[0], t[1], t[2]));
  return glm::scale(moved * glm::mat4_cast(glm::normalize(glm::dquat(r[3], r[0], r[1], r[2]))),
                    glm::dvec3(s[0], s[1], s[2]));
}

struct PlacedNode {
  const json* node;
  glm::dmat4 to_world;
  int depth;
};

/// The nodes of the default scene, parents before children.
std::vector<PlacedNode> placed_nodes(const json& file, const fs::path& path) {
  const json& all = member(file, "nodes");
  std::vector<PlacedNode> placed, open;
  const auto add = [&](const json& list, const glm::dmat4& to_world, int depth) {
    for (size_t i = list.is_array() ? list.size() : 0; i-- > 0;) {
      const json& node = element(all, list[i]);
      if (node.is_object()) open.push_back({&node, to_world * transform_of(node), depth});
    }
  };
  const json& chosen = member(file, "scene");
  add(member(element(member(file, "scenes"), chosen.is_number() ? chosen : json(0u)), "nodes"), glm::dmat4(1.0), 1);
  while (!open.empty()) {
    const PlacedNode next = open.back();
    open.pop_back();
    if (next.depth > deepest_node)
      throw Error("{}: its nodes are more than {} levels deep (or in a circle), which is not read", path.string(),
                  deepest_node);
    if (placed.size() >= all.size()) throw Error("{}: a node of it has two parents, or is its own", path.string());
    placed.push_back(next);
    add(member(*next.node, "children"), next.to_world, next.depth + 1);
  }
  return placed;
}

bool finite_matrix(const glm::dmat4& m) {
  double sum = 0;
  for (int i = 0; i < 16; ++i) sum += std::abs(m[i / 4][i % 4]);
  return std::isfinite(sum);
}

/// Returns false if the camera's numbers are unusable.
bool set_lens(const json& camera, SceneCamera& to) {
  if (text_of(member(camera, "type")) == "orthographic") {
    to.orthographic = true;
    to.width = 2 * number_of(member(member(camera, "orthographic"), "xmag"), 0);
    return to.width > 0 && std::isfinite(to.width);
  }
  const json& lens = member(camera, "perspective");
  const double yfov = number_of(member(lens, "yfov"), 0), aspect = number_of(member(lens, "aspectRatio"), 1);
  to.fov_degrees = 2 * std::atan(std::tan(yfov / 2) * aspect) * 180 / glm::pi<double>();
  return yfov > 0 && yfov < glm::pi<double>() && aspect > 0 && to.fov_degrees > 0 && to.fov_degrees < 179.9;
}

void add_camera(const json& file, const PlacedNode& placed, GltfJson& to) {
  const json& camera = element(member(file, "cameras"), member(*placed.node, "camera"));
  const std::string own = text_of(member(camera, "name")), of_node = text_of(member(*placed.node, "name"));
  const glm::dvec3 forward = -glm::dvec3(placed.to_world[2]), up(placed.to_world[1]);
  SceneCamera made;
  const bool stands = finite_matrix(placed.to_world) && glm::length(glm::cross(forward, up)) > 0;
  const std::string name = of_node.empty() ? own : of_node;
  if (!stands || !set_lens(camera, made)) {
    to.notes.push_back(fmt::format("camera '{}' has no usable field of view or transform and was left out", name));
    return;
  }
  made.pose = looking_at(name, glm::dvec3(0.0), glm::normalize(forward), made.fov_degrees, glm::normalize(up)).pose;
  made.pose.position = glm::dvec3(placed.to_world[3]);
  made.name = name;
  to.cameras.push_back(made);
}

// --- Materials

void add_emissive_strengths(const json& file, GltfJson& to) {
  std::map<std::string, int> uses;
  for (const json& material : member(file, "materials")) ++uses[text_of(member(material, "name"))];
  size_t lost = 0;
  for (const json& material : member(file, "materials")) {
    const json& extension = member(member(material, "extensions"), "KHR_materials_emissive_strength");
    if (!extension.is_object()) continue;
    const std::string name = text_of(member(material, "name"));
    if (name.empty() || uses[name] > 1)
      ++lost;  // assimp reorders materials, so only names identify them
    else
      to.emissive_strength[name] = float(number_of(member(extension, "emissiveStrength"), 1));
  }
  if (lost > 0)
    to.notes.push_back(fmt::format("{} emissive strength{} left out, as the material has no name of its own", lost,
                                   lost == 1 ? " was" : "s were"));
}

}  // namespace

bool has_gltf_ending(const fs::path& path) {
  const std::string ending = lower(path.extension().string());
  return ending == ".gltf" || ending == ".glb";
}

GltfJson read_gltf_json(const fs::path& path) {
  const json file = parsed(path);
  check_version(file, path);
  check_extensions(file, path);
  GltfJson result;
  for (const PlacedNode& placed : placed_nodes(file, path)) {
    if (placed.node->contains("camera")) add_camera(file, placed, result);
  }
  add_emissive_strengths(file, result);
  return result;
}

}  // namespace gloam
