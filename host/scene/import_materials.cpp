#include "scene/import_materials.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <set>

#include "gloam/error.h"
#include "scene/textures.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

// --- Properties

std::optional<float> number(const aiMaterial& from, const char* key, unsigned type, unsigned index) {
  ai_real value;
  if (from.Get(key, type, index, value) != aiReturn_SUCCESS || !std::isfinite(value)) return {};
  return float(value);
}

std::optional<glm::vec3> colour(const aiMaterial& from, const char* key, unsigned type, unsigned index) {
  aiColor3D value;
  if (from.Get(key, type, index, value) != aiReturn_SUCCESS) return {};
  const glm::vec3 c(value.r, value.g, value.b);
  if (!std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z)) return {};
  return c;
}

std::string text(const aiMaterial& from, const char* key, unsigned type, unsigned index) {
  aiString value;
  return from.Get(key, type, index, value) == aiReturn_SUCCESS ? value.C_Str() : "";
}

/// Perceptual roughness from a Phong exponent: GGX alpha = sqrt(2 / (exponent + 2)) (Walter et al. 2007, around eq. 35, the match
/// of Phong and Beckmann lobes); alpha is the square of the perceptual roughness.
float roughness_of_exponent(float exponent) { return std::pow(2 / (std::max(exponent, 0.0f) + 2), 0.25f); }

// --- Finding textures

/// The path as written, with its escapes decoded, or, for files from another machine, the file name alone.
fs::path find_file(const fs::path& folder, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::string decoded = percent_decoded(name);
  std::error_code ignored;
  for (const fs::path& candidate : {folder / name, folder / decoded, folder / fs::path(decoded).filename()}) {
    if (fs::is_regular_file(candidate, ignored)) return candidate;
  }
  throw Error("no such file");
}

Texture embedded_texture(const aiTexture& from, const std::string& name) {
  if (from.mHeight == 0) return decode_image(name, reinterpret_cast<const uint8_t*>(from.pcData), from.mWidth);
  Texture texture{name, int(from.mWidth), int(from.mHeight), {}};
  const size_t count = size_t(from.mWidth) * from.mHeight;
  texture.texels.reserve(4 * count);
  for (size_t i = 0; i < count; ++i) {
    const aiTexel& t = from.pcData[i];
    texture.texels.insert(texture.texels.end(), {t.r, t.g, t.b, t.a});
  }
  return texture;
}

bool has_holes(const Texture& texture) {
  for (size_t i = 3; i < texture.texels.size(); i += 4) {
    if (texture.texels[i] < 255) return true;
  }
  return false;
}

/// `albedo` (white if null) with the opacity of another picture: its alpha if it has one, else its red. The result has the size
/// of the larger one.
Texture with_opacity(const Texture* albedo, const Texture& opacity) {
  const size_t channel = has_holes(opacity) ? 3 : 0;
  Texture result;
  result.name = albedo ? albedo->name + " with " + opacity.name : opacity.name;
  result.width = std::max(opacity.width, albedo ? albedo->width : 1);
  result.height = std::max(opacity.height, albedo ? albedo->height : 1);
  result.texels.resize(size_t(4) * size_t(result.width) * size_t(result.height), 255);
  const auto texel = [&](const Texture& from, int x, int y) {
    const size_t column = size_t(x) * size_t(from.width) / size_t(result.width);
    const size_t row = size_t(y) * size_t(from.height) / size_t(result.height);
    return from.texels.data() + 4 * (row * size_t(from.width) + column);
  };
  uint8_t* to = result.texels.data();
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x, to += 4) {
      if (albedo) std::copy_n(texel(*albedo, x, y), 3, to);
      to[3] = texel(opacity, x, y)[channel];
    }
  }
  return result;
}

// --- Texture coordinates

/// assimp turns glTF's transform (scale, rotation about the top left, offset) into one about the centre with v up, but does not
/// invert it correctly if there is a rotation; so it is decomposed here, by the formula of assimp's importer.
UvUse uv_use(const aiMaterial& from, aiTextureType type, unsigned set) {
  UvUse use;
  use.set = set;
  aiUVTransform t;
  const bool is_gltf = !text(from, AI_MATKEY_GLTF_ALPHAMODE).empty();
  if (!is_gltf || from.Get(AI_MATKEY_UVTRANSFORM(type, 0), t) != aiReturn_SUCCESS) return use;
  use.rotation = -double(t.mRotation);
  use.scale = {t.mScaling.x, t.mScaling.y};
  const double c = std::cos(use.rotation), s = std::sin(use.rotation);
  use.offset.x = t.mTranslation.x - 0.5 * use.scale.x * (1 - c + s);
  use.offset.y = 0.5 * use.scale.y * (s + c - 1) + 1 - use.scale.y - t.mTranslation.y;
  return use;
}

// --- One scene's materials

/// Materials that share a note: "3 materials (the first is 'leaf')".
struct Named {
  size_t count = 0;
  std::string first;
  void add(const std::string& name) {
    if (count++ == 0) first = name;
  }
  std::string text(const char* what) const {
    return count == 1 ? fmt::format("{} '{}'", what, first)
                      : fmt::format("{} {}s (the first is '{}')", count, what, first);
  }
};

class Importer {
 public:
  Importer(const aiScene& from, fs::path folder, Scene& scene)
      : from_(from), folder_(std::move(folder)), scene_(scene) {}

  void add(const aiMaterial& from, const std::map<std::string, float>& emissive_strength);
  void add_notes();
  std::vector<UvUse> uv_uses;

 private:
  int texture(const aiMaterial& from, aiTextureType type);
  int loaded(const std::string& name);
  int combined(int albedo, int opacity);
  void set_base(const aiMaterial& from, Material& to);
  void set_opacity(const aiMaterial& from, Material& to);
  void set_reflection(const aiMaterial& from, Material& to);
  void set_emission(const aiMaterial& from, float strength, Material& to);

  const aiScene& from_;
  fs::path folder_;
  Scene& scene_;
  std::map<std::string, int> by_name_;
  std::map<std::pair<int, int>, int> combined_;
  std::vector<UvUse> uses_;  // of the material at hand, by texture
  std::set<std::string> not_repeating_;
  Named blending_, translucent_, several_;
};

int Importer::loaded(const std::string& name) {
  const auto [entry, is_new] = by_name_.emplace(name, -1);
  if (!is_new) return entry->second;
  const aiTexture* embedded = from_.GetEmbeddedTexture(name.c_str());
  const std::string shown = name.starts_with("*") ? "embedded " + name.substr(1) : name;
  try {
    if (name.starts_with("*") && !embedded) throw Error("there is none of this number");
    scene_.textures.push_back(embedded ? embedded_texture(*embedded, shown) : read_image(find_file(folder_, name)));
    entry->second = int(scene_.textures.size()) - 1;
  } catch (const UsageError&) {  // an output is this file
    throw;
  } catch (const std::exception& e) {
    scene_.notes.push_back(fmt::format("texture '{}' cannot be read ({}) and was left out", shown, e.what()));
  }
  return entry->second;
}

/// Index of the texture; -1 if the material has none of this type, or it cannot be read.
int Importer::texture(const aiMaterial& from, aiTextureType type) {
  const std::string name = text(from, AI_MATKEY_TEXTURE(type, 0));
  if (name.empty()) return -1;
  const int index = loaded(name);
  if (index < 0) return -1;
  int set = 0, across = aiTextureMapMode_Wrap, down = aiTextureMapMode_Wrap;
  from.Get(AI_MATKEY_UVWSRC(type, 0), set);
  from.Get(AI_MATKEY_MAPPINGMODE_U(type, 0), across);
  from.Get(AI_MATKEY_MAPPINGMODE_V(type, 0), down);
  if (across != aiTextureMapMode_Wrap || down != aiTextureMapMode_Wrap) not_repeating_.insert(name);
  uses_.push_back(uv_use(from, type, unsigned(std::max(set, 0))));
  return index;
}

int Importer::combined(int albedo, int opacity) {
  const auto [entry, is_new] = combined_.emplace(std::pair(albedo, opacity), -1);
  if (is_new) {
    const Texture* colours = albedo < 0 ? nullptr : &scene_.textures[size_t(albedo)];
    Texture made = with_opacity(colours, scene_.textures[size_t(opacity)]);
    scene_.textures.push_back(std::move(made));
    entry->second = int(scene_.textures.size()) - 1;
  }
  return entry->second;
}

void Importer::set_base(const aiMaterial& from, Material& to) {
  const auto base = colour(from, AI_MATKEY_BASE_COLOR), diffuse = colour(from, AI_MATKEY_COLOR_DIFFUSE);
  to.albedo = glm::clamp(base.value_or(diffuse.value_or(to.albedo)), 0.0f, 1.0f);
  to.albedo_texture = texture(from, aiTextureType_BASE_COLOR);
  if (to.albedo_texture < 0) to.albedo_texture = texture(from, aiTextureType_DIFFUSE);
}

/// Opacity becomes a mask: nothing is translucent.
void Importer::set_opacity(const aiMaterial& from, Material& to) {
  const std::string mode = text(from, AI_MATKEY_GLTF_ALPHAMODE);
  const float opacity = number(from, AI_MATKEY_OPACITY).value_or(1);
  const int mask = mode.empty() ? texture(from, aiTextureType_OPACITY) : -1;
  const bool holes = to.albedo_texture >= 0 && has_holes(scene_.textures[size_t(to.albedo_texture)]);
  if (mask >= 0) {
    to.albedo_texture = combined(to.albedo_texture, mask);
    to.alpha_cutoff = 0.5f;
  } else if (mode == "MASK" && to.albedo_texture >= 0) {
    to.alpha_cutoff = number(from, AI_MATKEY_GLTF_ALPHACUTOFF).value_or(0.5f) / std::max(opacity, 1e-6f);
  } else if (mode == "BLEND" && holes) {
    to.alpha_cutoff = 0.5f;
    blending_.add(to.name);
  } else if (mode != "OPAQUE" && opacity < 1) {
    translucent_.add(to.name);
  }
}

void Importer::set_reflection(const aiMaterial& from, Material& to) {
  const auto roughness = number(from, AI_MATKEY_ROUGHNESS_FACTOR), metallic = number(from, AI_MATKEY_METALLIC_FACTOR);
  const auto exponent = number(from, AI_MATKEY_SHININESS);
  // glTF has both in one texture; other formats have one each, or none.
  const int both = texture(from, aiTextureType_UNKNOWN);
  to.roughness_texture = both >= 0 ? both : texture(from, aiTextureType_DIFFUSE_ROUGHNESS);
  to.metallic_texture = both >= 0 ? both : texture(from, aiTextureType_METALNESS);
  to.roughness = roughness                   ? *roughness
                 : to.roughness_texture >= 0 ? 1
                 : exponent                  ? roughness_of_exponent(*exponent)
                                             : 1;
  to.metallic = metallic.value_or(to.metallic_texture >= 0 ? 1.0f : 0.0f);
  to.roughness = glm::clamp(to.roughness, 0.0f, 1.0f);
  to.metallic = glm::clamp(to.metallic, 0.0f, 1.0f);
}

void Importer::set_emission(const aiMaterial& from, float strength, Material& to) {
  to.emission = glm::max(colour(from, AI_MATKEY_COLOR_EMISSIVE).value_or(glm::vec3(0)), 0.0f);
  to.emission_texture = texture(from, aiTextureType_EMISSIVE);
  const bool is_gltf = !text(from, AI_MATKEY_GLTF_ALPHAMODE).empty();
  const bool lost = to.emission_texture < 0 && !text(from, AI_MATKEY_TEXTURE(aiTextureType_EMISSIVE, 0)).empty();
  // A lost texture turns emission off: otherwise the whole surface would shine. OBJ files give map_Ke without Ke, which assimp
  // makes black.
  if (lost) to.emission = glm::vec3(0);
  if (to.emission_texture >= 0 && to.emission == glm::vec3(0) && !is_gltf) to.emission = glm::vec3(1);
  if (std::isfinite(strength) && strength >= 0) to.emission *= strength;
}

void Importer::add(const aiMaterial& from, const std::map<std::string, float>& emissive_strength) {
  Material made;
  aiString name;
  if (from.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) made.name = name.C_Str();
  const auto strength = emissive_strength.find(made.name);
  uses_.clear();
  set_base(from, made);
  set_opacity(from, made);
  set_reflection(from, made);
  set_emission(from, strength == emissive_strength.end() ? 1 : strength->second, made);
  const UvUse use = uses_.empty() ? UvUse{} : uses_.front();
  if (std::any_of(uses_.begin(), uses_.end(), [&](const UvUse& other) { return other != use; }))
    several_.add(made.name);
  uv_uses.push_back(use);
  scene_.materials.push_back(made);
}

void Importer::add_notes() {
  const auto note = [&](const Named& materials, const char* what) {
    if (materials.count) scene_.notes.push_back(fmt::format("{}: {}", materials.text("material"), what));
  };
  note(blending_, "blending becomes a mask, with no surface where the texture's alpha is below 0.5");
  note(translucent_, "translucency is left out, the surface is solid");
  note(several_, "the texture coordinates of the first texture serve all of them");
  if (const size_t n = not_repeating_.size())
    scene_.notes.push_back(fmt::format("{} texture{} clamped or mirrored outside of [0, 1], and repeat{} here", n,
                                       n == 1 ? " is" : "s are", n == 1 ? "s" : ""));
}

}  // namespace

std::string percent_decoded(const std::string& uri) {
  const auto hex = [](char c) { return std::isxdigit(static_cast<unsigned char>(c)) != 0; };
  std::string result;
  for (size_t i = 0; i < uri.size(); ++i) {
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() && hex(uri[i + 1]) && hex(uri[i + 2]);
    result += escaped ? char(std::stoi(uri.substr(i + 1, 2), nullptr, 16)) : uri[i];
    if (escaped) i += 2;
  }
  return result;
}

glm::vec2 UvUse::operator()(const glm::dvec2& uv) const {
  const double c = std::cos(rotation), s = std::sin(rotation), u = scale.x * uv.x, v = scale.y * uv.y;
  return {offset.x + c * u + s * v, offset.y - s * u + c * v};
}

std::vector<UvUse> import_materials(const aiScene& from, const fs::path& folder,
                                    const std::map<std::string, float>& emissive_strength, Scene& scene) {
  Importer importer(from, folder, scene);
  for (unsigned i = 0; i < from.mNumMaterials; ++i) importer.add(*from.mMaterials[i], emissive_strength);
  importer.add_notes();
  scene.materials.push_back({});
  importer.uv_uses.push_back({});
  return importer.uv_uses;
}

}  // namespace gloam
