#include "gloam/scene/environment_reference.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "base/low_discrepancy.h"
#include "gloam/environment_map.h"
#include "gloam/error.h"
#include "scene/cosine_rays.h"
#include "scene/fingerprint.h"

namespace gloam {
namespace {

/// Draws directions in proportion to what texels have above the mean of the map, interpolated as its radiance is (what is below is
/// left to directions drawn another way: Karlik et al. 2019).
class BrightTexels {
 public:
  explicit BrightTexels(const EnvironmentMap& map);

  /// False if the map is so even that drawing texels would not help.
  bool any() const { return !rows_.empty(); }

  /// For u in [0,1)^2; only if there are any.
  glm::dvec3 direction(const glm::dvec2& u) const;
  /// Density of `direction`, per steradian; 0 if there are no bright texels.
  double density(const glm::dvec3& direction) const;

 private:
  double probability(int x, int y) const;

  const EnvironmentMap& map_;
  std::vector<double> rows_;     ///< cumulated, ending with 1
  std::vector<double> columns_;  ///< cumulated within each row, ending with 1; of rows without bright texels 0
};

using glm::dvec2;
using glm::dvec3;
using glm::vec3;

constexpr double pi = glm::pi<double>();

/// A map whose bright texels hold less than this share of its light is even.
constexpr double least_share = 0.02;

/// Sine of the angle to the pole in the middle of a row: the size of its texels.
double size_of(int row, int height) { return std::sin(pi * (row + 0.5) / height); }

/// Replaces weights by their cumulated shares; returns their sum.
double cumulate(double* weights, size_t count) {
  double sum = 0;
  for (size_t i = 0; i < count; ++i) weights[i] = sum += weights[i];
  if (sum > 0) {
    for (size_t i = 0; i < count; ++i) weights[i] /= sum;
    weights[count - 1] = 1;
  }
  return sum;
}

/// The interval of cumulated shares that holds u, which becomes the place within it.
int drawn(const double* shares, int count, double& u) {
  const int i = std::min(int(std::upper_bound(shares, shares + count, u) - shares), count - 1);
  const double before = i > 0 ? shares[i - 1] : 0, width = shares[i] - before;
  u = width > 0 ? std::clamp((u - before) / width, 0.0, 1.0) : 0.5;
  return i;
}

/// From -1 to 1, with the density of a tent: how much a texel counts at this distance from its middle.
double tent(double u) { return u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u); }

BrightTexels::BrightTexels(const EnvironmentMap& map) : map_(map) {
  const int width = map.width(), height = map.height();
  const auto row_of = [&](int y) { return columns_.data() + size_t(y) * size_t(width); };
  columns_.reserve(map.texels().size());
  for (const vec3& texel : map.texels()) columns_.push_back(double(texel.x) + double(texel.y) + double(texel.z));
  double light = 0, sizes = 0;
  for (int y = 0; y < height; ++y) {
    sizes += width * size_of(y, height);
    for (int x = 0; x < width; ++x) light += row_of(y)[x] * size_of(y, height);
  }
  for (double& brightness : columns_) brightness = std::max(brightness - light / sizes, 0.0);
  double above = 0;
  for (int y = 0; y < height; ++y) {
    rows_.push_back(size_of(y, height) * cumulate(row_of(y), size_t(width)));
    above += rows_.back();
  }
  if (above > least_share * light)
    cumulate(rows_.data(), rows_.size());
  else
    rows_.clear();
}

double BrightTexels::probability(int x, int y) const {
  const double* columns = columns_.data() + size_t(y) * size_t(map_.width());
  const double row = rows_[size_t(y)] - (y > 0 ? rows_[size_t(y) - 1] : 0);
  return row * (columns[x] - (x > 0 ? columns[x - 1] : 0));
}

dvec3 BrightTexels::direction(const dvec2& u) const {
  double across = u.x, down = u.y;
  const int row = drawn(rows_.data(), map_.height(), down);
  const int column = drawn(columns_.data() + size_t(row) * size_t(map_.width()), map_.width(), across);
  // Beyond a pole lies the same row again, as in the map's own radiance.
  double y = std::abs(row + 0.5 + tent(down));
  if (y > map_.height()) y = 2 * map_.height() - y;
  return map_.direction({column + 0.5 + tent(across), y});
}

double BrightTexels::density(const dvec3& direction) const {
  if (!any()) return 0;
  const dvec2 place = map_.place(direction), at = place - 0.5;
  const double left = std::floor(at.x), top = std::floor(at.y), u = at.x - left, v = at.y - top;
  const auto texel = [&](int dx, int dy) {
    return probability((int(left) + dx + map_.width()) % map_.width(), std::clamp(int(top) + dy, 0, map_.height() - 1));
  };
  const double per_texel =
      (1 - v) * ((1 - u) * texel(0, 0) + u * texel(1, 0)) + v * ((1 - u) * texel(0, 1) + u * texel(1, 1));
  const double from_pole = place.y / map_.height() * pi;
  const double size = 2 * pi / map_.width() * pi / map_.height() * std::max(std::sin(from_pole), 1e-12);
  return per_texel / size;
}

using glm::dvec3;
using glm::vec3;

class EnvironmentTracer {
 public:
  EnvironmentTracer(const Tracer& tracer, const EnvironmentMap& map, double radius)
      : tracer_(tracer), map_(map), bright_(map), radius_(float(radius)) {}

  int sorts_of_rays() const { return bright_.any() ? 2 : 1; }

  /// Mean light of one half of the rays.
  dvec3 half(const Site& site, int samples, uint32_t seed) const {
    dvec3 sum(0);
    for (int first = 0; first < samples; first += rays_per_packet) {
      const CosineRays rays = cosine_rays(site, seed, first);
      sum += light(site, rays);
      if (bright_.any()) sum += light(site, bright_rays(site, hash(seed + 0x9e3779b9u), first));
    }
    return sum / double(samples);
  }

 private:
  CosineRays bright_rays(const Site& site, uint32_t seed, int first) const {
    CosineRays rays;
    for (int i = 0; i < rays_per_packet; ++i) {
      const dvec3 direction = bright_.direction(scrambled_sobol(uint32_t(first + i), seed));
      const double cosine = glm::dot(direction, site.to_world[2]);
      if (cosine <= 0 || glm::dot(vec3(direction), site.facing) <= 0) continue;
      rays.cosines[rays.count] = float(cosine);
      rays.directions[rays.count++] = vec3(direction);
    }
    return rays;
  }

  /// Light of one sort of rays: each counts by the share that cosine-weighted ones have of both sorts.
  dvec3 light(const Site& site, const CosineRays& rays) const {
    bool blocked[rays_per_packet];
    tracer_.blocked(site.origin, rays.directions, rays.count, radius_, blocked);
    dvec3 sum(0);
    for (int i = 0; i < rays.count; ++i) {
      if (blocked[i]) continue;
      const dvec3 direction(rays.directions[i]);
      const double cosine_weighted = double(rays.cosines[i]) / glm::pi<double>(), bright = bright_.density(direction);
      const double share = bright > 0 ? cosine_weighted / (cosine_weighted + bright) : 1;
      sum += share * map_.radiance(direction);
    }
    return sum;
  }

  const Tracer& tracer_;
  const EnvironmentMap& map_;
  BrightTexels bright_;
  float radius_;
};

}  // namespace

Reference environment_reference(const Tracer& tracer, const Frame& frame, const EnvironmentMap& map,
                                const ReferenceOptions& options) {
  check_radius(options.radius);
  check_samples(options.samples);
  check_views(frame);
  const int samples = rounded_samples(options.samples);
  const EnvironmentTracer pixels(tracer, map, options.radius);
  RowsOptions rows = rows_of("environment", {0, 0, 0}, options);
  Fingerprint print;
  print.add(map.texels());
  print.add(map.width());
  print.add(map.direction({0, 0.5 * map.height()}));  // tells axes and turn
  print.add(map.direction({0, 0}));
  rows.key = fmt::format("{} radius {} samples {} seed {}", print.text(), options.radius, samples, options.seed);
  rows.trace = [&](const ViewTracer&, const Site& site, int, int, uint32_t pixel, float* value, float& noise) {
    const auto seeds = seeds_of_halves(pixel, options.seed);
    noise = mean_of_halves(pixels.half(site, samples / 2, seeds[0]), pixels.half(site, samples / 2, seeds[1]), value);
    return (long long)(samples)*pixels.sorts_of_rays();
  };
  Reference result = trace_rows(tracer, frame, rows);
  describe(result, "environment", samples,
           "mean over cosine-weighted directions of the environment's radiance where nothing is within "
           "environmentRadius, else 0 (irradiance / pi)");
  result.frame.numbers["environmentRadius"] = options.radius;
  return result;
}

}  // namespace gloam
