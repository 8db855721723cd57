#include "gloam/scene/bounces_reference.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "base/low_discrepancy.h"
#include "base/random.h"
#include "gloam/error.h"
#include "scene/cosine_rays.h"
#include "scene/fingerprint.h"
#include "scene/scene_checks.h"

namespace gloam {
namespace {

using glm::dvec3;
using glm::vec3;

/// Paths whose weight is below this may end at random.
constexpr double roulette_below = 0.25;

class BouncesTracer {
 public:
  BouncesTracer(const Tracer& tracer, const BouncesReferenceOptions& options)
      : tracer_(tracer), options_(options), half_(rounded_samples(options.samples) / 2) {}

  int paths_per_pixel() const { return 2 * half_; }

  /// Mean light of one half of the paths. Adds the rays that it took.
  dvec3 half(const Site& site, uint32_t seed, long long& rays) const {
    dvec3 sum(0);
    for (int first = 0; first < half_; first += rays_per_packet) {
      const CosineRays starts = cosine_rays(site, seed, first);
      for (int i = 0; i < starts.count; ++i) {
        // Only the first direction is of a low-discrepancy set; a path has too many dimensions for one.
        Random random(seed, uint64_t(first + i));
        sum += arriving(site.origin, dvec3(starts.directions[i]), random, rays);
      }
    }
    return sum / double(half_);
  }

 private:
  /// Light that a path brings which leaves the pixel's surface in a direction.
  dvec3 arriving(vec3 origin, dvec3 direction, Random& random, long long& rays) const {
    dvec3 weight(1);
    for (int bounces = 0;; ++bounces) {
      ++rays;
      const std::optional<Surface> met = tracer_.first_from(origin, direction, options_.radius);
      if (!met) return weight;
      if (bounces == options_.bounces) return dvec3(0);
      weight *= dvec3(tracer_.material(*met).albedo);
      const double most = std::max({weight.x, weight.y, weight.z});
      if (most < roulette_below) {
        if (random.uniform(0, 1) * roulette_below >= most) return dvec3(0);
        weight *= roulette_below / most;
      }
      const double u = random.uniform(0, 1), v = random.uniform(0, 1);
      direction = frame_about(met->normal) * cosine_direction({u, v});
      if (glm::dot(direction, met->facing) <= 0) return dvec3(0);
      origin = tracer_.lifted(*met);
    }
  }

  const Tracer& tracer_;
  const BouncesReferenceOptions& options_;
  int half_;
};

}  // namespace

Reference bounces_reference(const Tracer& tracer, const Frame& frame, const BouncesReferenceOptions& options) {
  check_radius(options.radius);
  check_samples(options.samples);
  if (options.bounces < 0 || options.bounces > most_bounces)
    throw UsageError("{} bounces are not allowed; 0 to {} are", options.bounces, most_bounces);
  check_views(frame);
  check_albedo(tracer.scene());
  const BouncesTracer pixels(tracer, options);
  RowsOptions rows = rows_of("bounces", {1, 1, 1}, options);
  Fingerprint print;
  print.add_light(tracer.scene());
  rows.key = fmt::format("{} radius {} samples {} bounces {} seed {}", print.text(), options.radius,
                         rounded_samples(options.samples), options.bounces, options.seed);
  rows.trace = [&](const ViewTracer&, const Site& site, int, int, uint32_t pixel, float* value, float& noise) {
    const auto seeds = seeds_of_halves(pixel, options.seed);
    long long rays = 0;
    const dvec3 a = pixels.half(site, seeds[0], rays), b = pixels.half(site, seeds[1], rays);
    noise = mean_of_halves(a, b, value);
    return rays;
  };
  Reference result = trace_rows(tracer, frame, rows);
  describe(result, "bounces", pixels.paths_per_pixel(),
           "mean over cosine-weighted directions of 1 where nothing is within bouncesRadius, else of albedo times the "
           "same mean at what is met, up to bouncesMost reflections");
  result.frame.numbers["bouncesRadius"] = options.radius;
  result.frame.numbers["bouncesMost"] = options.bounces;
  return result;
}

}  // namespace gloam
