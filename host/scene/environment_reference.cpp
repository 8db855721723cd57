#include "gloam/scene/environment_reference.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "base/low_discrepancy.h"
#include "scene/bright_texels.h"
#include "scene/cosine_rays.h"
#include "scene/fingerprint.h"

namespace gloam {
namespace {

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
