#include "gloam/scene/reference.h"

#include <algorithm>
#include <cmath>

#include "scene/cosine_rays.h"

namespace gloam {
namespace {

/// The estimate from one half of the rays.
class Estimator {
 public:
  Estimator(const Tracer& tracer, const AoReferenceOptions& options)
      : tracer_(tracer), options_(options), half_(rounded_samples(options.samples) / 2) {}

  /// Open share of the hemisphere, from `half_` rays of the set with this `seed`.
  double open_share(const Site& site, uint32_t seed) const {
    double closed = 0;
    for (int first = 0; first < half_; first += rays_per_packet) closed += closed_by_packet(site, seed, first);
    return 1 - closed / half_;
  }

  int rays_per_pixel() const { return 2 * half_; }

 private:
  double closed_by_packet(const Site& site, uint32_t seed, int first) const {
    const CosineRays rays = cosine_rays(site, seed, first);
    double closed = 0;
    for (int i = 0; i < rays.count_below; ++i) closed += taken(rays.cosines_below[i], 0);  // by the surface itself
    if (!options_.contribution) {
      bool blocked[rays_per_packet];
      tracer_.blocked(site.origin, rays.directions, rays.count, float(options_.radius), blocked);
      return closed + double(std::count(blocked, blocked + rays.count, true));
    }
    float distances[rays_per_packet];
    tracer_.distances(site.origin, rays.directions, rays.count, float(options_.radius), distances);
    for (int i = 0; i < rays.count; ++i) {
      if (std::isfinite(distances[i])) closed += taken(rays.cosines[i], double(distances[i]) / options_.radius);
    }
    return closed;
  }

  double taken(double cosine, double distance) const {
    return options_.contribution ? options_.contribution(cosine, distance) : 1;
  }

  const Tracer& tracer_;
  const AoReferenceOptions& options_;
  int half_;
};

std::string definition(const std::string& falloff) {
  return falloff == "none"
             ? "cosine-weighted share of directions in which nothing is nearer than aoRadius"
             : fmt::format("1 - cosine-weighted mean of the contribution of {} at the first hit within aoRadius",
                           falloff);
}

}  // namespace

AoReference ao_reference(const Tracer& tracer, const Frame& frame, const AoReferenceOptions& options) {
  check_radius(options.radius);
  check_samples(options.samples);
  check_views(frame);
  const Estimator estimator(tracer, options);
  RowsOptions rows = rows_of("ao", {1}, options);
  rows.key = fmt::format("radius {} samples {} seed {} falloff {} {}", options.radius, rounded_samples(options.samples),
                         options.seed, options.falloff, options.falloff_parameters);
  rows.trace = [&](const ViewTracer&, const Site& site, int, int, uint32_t pixel, float* value, float& noise) {
    const auto seeds = seeds_of_halves(pixel, options.seed);
    const double a = estimator.open_share(site, seeds[0]), b = estimator.open_share(site, seeds[1]);
    *value = float(std::clamp((a + b) / 2, 0.0, 1.0));
    noise = float(std::abs(a - b) / 2);
    return (long long)estimator.rays_per_pixel();
  };
  AoReference result = trace_rows(tracer, frame, rows);
  describe(result, "ao", estimator.rays_per_pixel(), definition(options.falloff));
  result.frame.numbers["aoRadius"] = options.radius;
  Frame& out = result.frame;
  out.attributes["aoFalloff"] = options.falloff;
  if (!options.falloff_parameters.empty()) out.attributes["aoFalloffParameters"] = options.falloff_parameters;
  return result;
}

}  // namespace gloam
