#include "normalise/normal_samples.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "base/low_discrepancy.h"
#include "gloam/projection.h"

namespace gloam {
namespace {

using glm::dvec3;

/// Distances in pixels at which neighbours are asked: the larger one where the smaller shows a smooth surface at few samples, as with a depth
/// that is stored as half: its steps hide the surface.
constexpr int reaches[] = {1, 8};
constexpr double least_share_smooth = 0.1;
/// Cosine between the normals of opposite corners about a pixel; a surface that is bent more tells no normal.
constexpr double least_smooth = 0.97;

/// What shows the surface at a pixel.
class Surface {
 public:
  Surface(const NormalSamples::DepthAt& depth, const Layout& image, const Window& window, const Camera& camera)
      : depth_(depth), image_(image), window_(window), camera_(camera) {}

  /// The normal by the four neighbours at this distance; none beside an edge or the background.
  std::optional<dvec3> normal(int x, int y, int reach) const {
    if (x < reach || y < reach || x + reach >= image_.width || y + reach >= image_.height) return {};
    const dvec3 here = position(x, y);
    const dvec3 left = here - position(x - reach, y), right = position(x + reach, y) - here;
    const dvec3 above = here - position(x, y - reach), below = position(x, y + reach) - here;
    if (!is_smooth(above, left, below, right) || !is_smooth(above, right, below, left)) return {};
    // Towards the eye: y runs down in the image, up in space.
    const dvec3 normal = glm::cross(above + below, left + right);
    const double length = glm::length(normal);
    return length > 0 && std::isfinite(length) ? std::optional(normal / length) : std::nullopt;
  }

 private:
  dvec3 position(int x, int y) const {
    const std::optional<ViewRay> ray = view_ray(camera_, {window_.x0 + x + 0.5, window_.y0 + y + 0.5});
    const float depth = depth_(x, y);
    // Infinite minus infinite is NaN, which no comparison below passes.
    return ray && !is_background(depth) ? ray->at(depth) : dvec3(std::numeric_limits<double>::quiet_NaN());
  }
  static bool is_smooth(const dvec3& down, const dvec3& right, const dvec3& other_down, const dvec3& other_right) {
    const dvec3 one = glm::cross(down, right), other = glm::cross(other_down, other_right);
    return glm::dot(one, other) > least_smooth * std::sqrt(glm::dot(one, one) * glm::dot(other, other));
  }

  const NormalSamples::DepthAt& depth_;
  const Layout image_;
  const Window& window_;
  const Camera& camera_;
};

}  // namespace

NormalSamples::NormalSamples(const Layout& image) : image_(image) {
  const int width = image.width, height = image.height;
  const int cell = std::max(1, int(std::sqrt(double(width) * height / 4096)));
  for (int cell_y = 0; cell_y < height; cell_y += cell)
    for (int cell_x = 0; cell_x < width; cell_x += cell) {
      const uint32_t random = hash(uint32_t(cell_y) * 65537u + uint32_t(cell_x));
      samples_.push_back({std::min(width - 1, cell_x + int(random % uint32_t(cell))),
                          std::min(height - 1, cell_y + int(random / 65536u % uint32_t(cell))),
                          dvec3(std::numeric_limits<double>::quiet_NaN())});
    }
}

void NormalSamples::take(const Plane& normal, int first_row) {
  const int rows = normal.channels.front().layout().height;
  for (Sample& sample : samples_) {
    const int y = sample.y - first_row;
    if (y < 0 || y >= rows) continue;
    for (int c : {0, 1, 2}) sample.normal[c] = normal.channels[size_t(c)].at(sample.x, y);
  }
}

void NormalSamples::take(const float* values) {
  for (Sample& sample : samples_) {
    const float* const pixel = values + 3 * (size_t(sample.y) * size_t(image_.width) + size_t(sample.x));
    sample.normal = {pixel[0], pixel[1], pixel[2]};
  }
}

std::vector<NormalPair> NormalSamples::pairs(const DepthAt& depth, const Window& window, const Camera& camera) const {
  const Surface surface(depth, image_, window, camera);
  std::vector<NormalPair> pairs;
  for (const int reach : reaches) {
    double surfaces = 0;
    for (const Sample& sample : samples_) {
      const double length = glm::length(sample.normal);
      if (!(length > 0) || !std::isfinite(length) || is_background(depth(sample.x, sample.y))) continue;
      ++surfaces;
      if (const std::optional<dvec3> normal = surface.normal(sample.x, sample.y, reach))
        pairs.push_back({sample.normal, *normal});
    }
    if (double(pairs.size()) >= least_share_smooth * surfaces) break;
  }
  return pairs;
}

std::vector<NormalPair> NormalSamples::pairs(const Channel& depth, const Window& window, const Camera& camera) const {
  return pairs([&](int x, int y) { return depth.at(x, y); }, window, camera);
}

}  // namespace gloam
