#include "gloam/scene/indirect_reference.h"

#include "base/low_discrepancy.h"
#include "gloam/scene/radiance.h"
#include "scene/cosine_rays.h"
#include "scene/fingerprint.h"
#include "scene/scene_checks.h"

namespace gloam {
namespace {

using glm::dvec3;

/// Mean light of one half of the rays. Adds the rays that it took.
dvec3 half_of(const Tracer& tracer, const Site& site, double radius, int samples, uint32_t seed,
              long long& rays_traced) {
  dvec3 sum(0);
  for (int first = 0; first < samples; first += rays_per_packet) {
    const CosineRays rays = cosine_rays(site, seed, first);
    for (int i = 0; i < rays.count; ++i) {
      const std::optional<Surface> met = tracer.first_from(site.origin, dvec3(rays.directions[i]), radius);
      rays_traced += met ? 2 : 1;  // the second towards the sun
      // Each hit asks for one point of the sun: there are many hits.
      if (met) sum += dvec3(radiance(tracer, *met, hash(seed + uint32_t(first + i)), 1).all);
    }
  }
  return sum / double(samples);
}

}  // namespace

Reference indirect_reference(const Tracer& tracer, const Frame& frame, const ReferenceOptions& options) {
  check_radius(options.radius);
  check_samples(options.samples);
  check_views(frame);
  check_albedo(tracer.scene());
  check_light(tracer.scene());
  const int samples = rounded_samples(options.samples);
  RowsOptions rows = rows_of("indirect", {0, 0, 0}, options);
  Fingerprint print;
  print.add_light(tracer.scene());
  rows.key = fmt::format("{} radius {} samples {} seed {}", print.text(), options.radius, samples, options.seed);
  rows.trace = [&](const ViewTracer&, const Site& site, int, int, uint32_t pixel, float* value, float& noise) {
    const auto seeds = seeds_of_halves(pixel, options.seed);
    long long rays = 0;
    const dvec3 a = half_of(tracer, site, options.radius, samples / 2, seeds[0], rays),
                b = half_of(tracer, site, options.radius, samples / 2, seeds[1], rays);
    noise = mean_of_halves(a, b, value);
    return rays;
  };
  Reference result = trace_rows(tracer, frame, rows);
  describe(result, "indirect", samples,
           "mean over cosine-weighted directions of what the first surface within indirectRadius sends by emission and "
           "by reflecting sun and sky once (irradiance / pi)");
  result.frame.numbers["indirectRadius"] = options.radius;
  return result;
}

}  // namespace gloam
