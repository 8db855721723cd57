#include "gloam/scene/specular_occlusion_reference.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/low_discrepancy.h"
#include "scene/fingerprint.h"
#include "scene/ggx.h"
#include "scene/reference_rows.h"

namespace gloam {
namespace {

using glm::vec3;

/// Sums of weights over one half of a pixel's rays.
struct OpenHalf {
  double open = 0, all = 0;

  /// A lobe that leaves the surface nowhere counts as closed.
  double share() const { return all > 0 ? open / all : 0; }
};

class LobeTracer {
 public:
  LobeTracer(const Tracer& tracer, double radius) : tracer_(tracer), radius_(float(radius)) {}

  OpenHalf half(const Site& site, const GgxLobe& lobe, int samples, uint32_t seed) const {
    OpenHalf sum;
    for (int first = 0; first < samples; first += rays_per_packet)
      add_packet(sum, site, lobe, seed, first, rays_per_packet);
    return sum;
  }

  /// Openness of the one direction of a mirror.
  double mirror(const Site& site, const GgxLobe& lobe) const {
    OpenHalf sum;
    add_packet(sum, site, lobe, 0, 0, 1);
    return sum.share();
  }

 private:
  void add_packet(OpenHalf& sum, const Site& site, const GgxLobe& lobe, uint32_t seed, int first, int samples) const {
    vec3 directions[rays_per_packet];
    double weights[rays_per_packet];
    int count = 0;
    for (int i = 0; i < samples; ++i) {
      const GgxLobe::Sample sample = lobe.sample(scrambled_sobol(uint32_t(first + i), seed));
      if (sample.direction.z <= 0) continue;
      sum.all += sample.weight;
      const vec3 direction(glm::normalize(site.to_world * sample.direction));
      if (glm::dot(direction, site.facing) <= 0) continue;  // the surface itself is in the way
      weights[count] = sample.weight;
      directions[count++] = direction;
    }
    bool blocked[rays_per_packet];
    tracer_.blocked(site.origin, directions, count, radius_, blocked);
    for (int i = 0; i < count; ++i) {
      if (!blocked[i]) sum.open += weights[i];
    }
  }

  const Tracer& tracer_;
  float radius_;
};

float roughness_at(const Tracer& tracer, const View& view, const Site& site, int x, int y) {
  if (const Plane* roughness = view.find("roughness")) return roughness->channels[0].at(x, y);
  return site.surface ? tracer.material(*site.surface).roughness : 1.0f;
}

}  // namespace

Reference specular_occlusion_reference(const Tracer& tracer, const Frame& frame, const ReferenceOptions& options) {
  check_radius(options.radius);
  check_samples(options.samples);
  check_views(frame);
  const int samples = rounded_samples(options.samples);
  const LobeTracer lobes(tracer, options.radius);
  RowsOptions rows = rows_of("specular_occlusion", {1}, options);
  Fingerprint print;
  print.add_light(tracer.scene());
  print.add_gloss(frame);
  rows.key = fmt::format("{} radius {} samples {} seed {}", print.text(), options.radius, samples, options.seed);
  rows.trace = [&](const ViewTracer& pixels, const Site& site, int x, int y, uint32_t pixel, float* value,
                   float& noise) -> long long {
    const GgxLobe lobe(roughness_at(tracer, pixels.view(), site, x, y), glm::transpose(site.to_world) * site.to_eye);
    if (lobe.is_mirror()) {
      *value = float(lobes.mirror(site, lobe));
      return 1;
    }
    const auto seeds = seeds_of_halves(pixel, options.seed);
    const OpenHalf a = lobes.half(site, lobe, samples / 2, seeds[0]), b = lobes.half(site, lobe, samples / 2, seeds[1]);
    *value = float(OpenHalf{a.open + b.open, a.all + b.all}.share());
    noise = float(std::abs(a.share() - b.share()) / 2);
    return samples;
  };
  Reference result = trace_rows(tracer, frame, rows);
  describe(result, "specular_occlusion", samples,
           "share of the light of a GGX lobe (height-correlated Smith, alpha = roughness^2, without Fresnel) about the "
           "normal, seen from the eye, whose directions are open within specular_occlusionRadius");
  result.frame.numbers["specular_occlusionRadius"] = options.radius;
  return result;
}

}  // namespace gloam
