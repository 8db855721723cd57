#include "gloam/scene/reference.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/low_discrepancy.h"
#include "gloam/error.h"
#include "scene/reference_rows.h"

namespace gloam {
namespace {

using glm::dvec3;
using glm::vec3;

constexpr int packet = rays_per_packet;

/// The estimate from one half of the rays.
class Estimator {
 public:
  Estimator(const Tracer& tracer, const AoReferenceOptions& options)
      : tracer_(tracer), options_(options), half_(rounded_samples(options.samples) / 2) {}

  /// Open share of the hemisphere, from `half_` rays of the set with this `seed`.
  double open_share(const Site& site, uint32_t seed) const {
    double closed = 0;
    for (int first = 0; first < half_; first += packet) closed += closed_by_packet(site, seed, first);
    return 1 - closed / half_;
  }

  int rays_per_pixel() const { return 2 * half_; }

 private:
  double closed_by_packet(const Site& site, uint32_t seed, int first) const {
    vec3 directions[packet];
    float cosines[packet];
    int count = 0;
    double closed = 0;
    for (int i = 0; i < packet; ++i) {
      const dvec3 local = cosine_direction(scrambled_sobol(uint32_t(first + i), seed));
      const vec3 direction(site.to_world * local);
      if (glm::dot(direction, site.facing) <= 0) {
        closed += taken(float(local.z), 0);  // the surface itself is in the way
        continue;
      }
      cosines[count] = float(local.z);
      directions[count++] = direction;
    }
    if (!options_.contribution) {
      bool blocked[packet];
      tracer_.blocked(site.origin, directions, count, float(options_.radius), blocked);
      return closed + double(std::count(blocked, blocked + count, true));
    }
    float distances[packet];
    tracer_.distances(site.origin, directions, count, float(options_.radius), distances);
    for (int i = 0; i < count; ++i) {
      if (std::isfinite(distances[i])) closed += taken(cosines[i], double(distances[i]) / options_.radius);
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

void check_inputs(const Frame& frame, const AoReferenceOptions& options) {
  if (!(options.radius > 0))
    throw UsageError("a reference of radius {:g} is open everywhere; give more than 0", options.radius);
  if (options.samples < 1 || options.samples > (1 << 24))
    throw UsageError("{} samples are not allowed; 1 to {} are", options.samples, 1 << 24);
  check_views(frame);
}

void describe(Frame& frame, const AoReferenceOptions& options, int rays_per_pixel, double noise) {
  frame.numbers["aoRadius"] = options.radius;
  frame.numbers["aoSamples"] = rays_per_pixel;
  frame.numbers["aoNoise"] = noise;
  frame.attributes["aoFalloff"] = options.falloff;
  if (!options.falloff_parameters.empty()) frame.attributes["aoFalloffParameters"] = options.falloff_parameters;
  frame.attributes["aoDefinition"] =
      options.falloff == "none"
          ? "cosine-weighted share of directions in which nothing is nearer than aoRadius"
          : fmt::format("1 - cosine-weighted mean of the contribution of {} at the first hit within aoRadius",
                        options.falloff);
}

}  // namespace

AoReference ao_reference(const Tracer& tracer, const Frame& frame, const AoReferenceOptions& options) {
  check_inputs(frame, options);
  const Estimator estimator(tracer, options);
  RowsOptions rows;
  rows.value = "ao";
  rows.noise = "ao_noise";
  rows.background = {1};
  rows.key = fmt::format("radius {} samples {} seed {} falloff {} {}", options.radius, rounded_samples(options.samples),
                         options.seed, options.falloff, options.falloff_parameters);
  rows.checkpoint = options.checkpoint;
  rows.checkpoint_seconds = options.checkpoint_seconds;
  rows.progress = options.progress;
  rows.poll = options.poll;
  rows.trace = [&](const ViewTracer&, const Site& site, int, int, uint32_t pixel, float* value, float& noise) {
    const uint32_t seed = pixel + options.seed;
    const double a = estimator.open_share(site, hash(2 * seed)), b = estimator.open_share(site, hash(2 * seed + 1));
    *value = float(std::clamp((a + b) / 2, 0.0, 1.0));
    noise = float(std::abs(a - b) / 2);
    return (long long)estimator.rays_per_pixel();
  };
  AoReference result = trace_rows(tracer, frame, rows);
  describe(result.frame, options, estimator.rays_per_pixel(), result.noise);
  return result;
}

}  // namespace gloam
