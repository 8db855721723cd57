#include "scene/textures.h"

#include <array>
#include <climits>
#include <cmath>
#include <fstream>
#include <glm/common.hpp>
#include <memory>

#include "base/file_ledger.h"
#include "base/files.h"
#include "base/srgb.h"
#include "gloam/error.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC  // other libraries bring versions of their own
#define STBI_NO_STDIO
#ifdef __SANITIZE_ADDRESS__
#define STBI_NO_SIMD  // GCC refuses its intrinsics where shifts are watched
#endif
#include <stb/stb_image.h>

namespace gloam {
namespace {

/// 16384 x 16384: a gigabyte of texels. A header may overstate its size.
constexpr size_t most_texels = size_t(1) << 28;

std::string failure() {
  const char* reason = stbi_failure_reason();
  return reason && *reason ? reason : "damaged";
}

std::array<float, 256> srgb_table() {
  std::array<float, 256> table;
  for (int i = 0; i < 256; ++i) table[size_t(i)] = float(linear_of_srgb(i / 255.0));
  return table;
}

/// The remainder in [0, n), whatever the sign.
int wrapped(double index, int n) {
  const double rest = std::fmod(index, double(n));
  return std::min(int(rest < 0 ? rest + n : rest), n - 1);
}

glm::vec4 at(const Texture& texture, int x, int y, bool srgb) {
  static const std::array<float, 256> linear = srgb_table();
  const uint8_t* p = texture.texels.data() + 4 * (size_t(y) * size_t(texture.width) + size_t(x));
  const auto colour = [&](uint8_t v) { return srgb ? linear[v] : float(v) / 255; };
  return {colour(p[0]), colour(p[1]), colour(p[2]), float(p[3]) / 255};
}

}  // namespace

Texture decode_image(const std::string& name, const uint8_t* bytes, size_t size) {
  if (size == 0) throw Error("the file is empty");
  if (size > size_t(INT_MAX)) throw Error("the file has over 2 GB");
  Texture texture;
  texture.name = name;
  int channels = 0;
  if (!stbi_info_from_memory(bytes, int(size), &texture.width, &texture.height, &channels)) throw Error(failure());
  if (texture.width <= 0 || texture.height <= 0 || size_t(texture.width) > most_texels / size_t(texture.height))
    throw Error("{}x{} texels; up to 16384x16384 are read", texture.width, texture.height);
  const std::unique_ptr<stbi_uc, void (*)(void*)> texels(
      stbi_load_from_memory(bytes, int(size), &texture.width, &texture.height, &channels, 4), stbi_image_free);
  if (!texels) throw Error(failure());
  texture.texels.assign(texels.get(), texels.get() + size_t(4) * size_t(texture.width) * size_t(texture.height));
  return texture;
}

Texture read_image(const std::filesystem::path& path) {
  check_regular(path);
  std::error_code failed;
  const auto size = std::filesystem::file_size(path, failed);
  std::ifstream file(path, std::ios::binary);
  if (failed || !file) throw Error("the file cannot be opened");
  opens_file(path);
  if (size > size_t(INT_MAX)) throw Error("the file has over 2 GB");
  std::vector<uint8_t> bytes(size);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(size))) throw Error("the file cannot be read");
  return decode_image(path.filename().string(), bytes.data(), bytes.size());
}

glm::vec4 texel(const Texture& texture, glm::vec2 uv, bool srgb) {
  const double x = double(uv.x) * texture.width - 0.5, y = double(uv.y) * texture.height - 0.5;
  if (!std::isfinite(x) || !std::isfinite(y)) return at(texture, 0, 0, srgb);
  const double left = std::floor(x), top = std::floor(y);
  const int x0 = wrapped(left, texture.width), x1 = (x0 + 1) % texture.width;
  const int y0 = wrapped(top, texture.height), y1 = (y0 + 1) % texture.height;
  const float right = float(x - left), down = float(y - top);
  return glm::mix(glm::mix(at(texture, x0, y0, srgb), at(texture, x1, y0, srgb), right),
                  glm::mix(at(texture, x0, y1, srgb), at(texture, x1, y1, srgb), right), down);
}

bool has_holes(const Scene& scene, const Mesh& mesh) {
  const Material& material = scene.materials[size_t(mesh.material)];
  return material.alpha_cutoff > 0 && material.albedo_texture >= 0 && !mesh.uvs.empty();
}

}  // namespace gloam
