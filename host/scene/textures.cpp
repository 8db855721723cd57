#include "scene/textures.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "base/srgb.h"

namespace gloam {
namespace {

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
