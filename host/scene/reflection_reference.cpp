#include "gloam/scene/reflection_reference.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/low_discrepancy.h"
#include "gloam/error.h"
#include "gloam/projection.h"
#include "gloam/scene/radiance.h"
#include "scene/fingerprint.h"
#include "scene/ggx.h"
#include "scene/reference_rows.h"

namespace gloam {
namespace {

using glm::dvec3;
using glm::vec3;

/// Rays of a mirror; they differ in the points of the sun that their hits are lit by.
constexpr int mirror_samples = 2 * rays_per_packet;

/// Percentile of the largest component over reflecting pixels that the exposure brings to 1.
constexpr double white_percentile = 0.99;

struct Gloss {
  float roughness = 1;
  dvec3 reflectance{0.0};
};

dvec3 fresnel(const dvec3& reflectance, double cosine) {
  return reflectance + (1.0 - reflectance) * std::pow(std::max(1 - cosine, 0.0), 5.0);
}

/// The points that the views of the frame show: those that a screen-space ray could meet.
class Shown {
 public:
  explicit Shown(const Tracer& tracer, const Frame& frame) : tracer_(tracer), frame_(frame) {}

  /// Whether a view shows the point, relative to Scene::origin.
  bool point(const dvec3& position) const {
    return in_a_view(position + tracer_.scene().origin, 1, [](double there, float shown) {
      return !is_background(shown) && std::abs(there - double(shown)) <= 0.01 * there;
    });
  }

  bool sky(const dvec3& direction) const {
    return in_a_view(direction, 0, [](double, float shown) { return is_background(shown); });
  }

 private:
  template <typename Fits>
  bool in_a_view(const dvec3& world, double w, const Fits& fits) const {
    return std::any_of(frame_.views.begin(), frame_.views.end(), [&](const View& view) {
      const Camera& camera = *view.camera;
      const std::optional<glm::dvec2> place = pixel_of_world(camera, world, w);
      if (!place) return false;
      const dvec3 p = camera.pose->world_to_view * (world - w * camera.pose->position);
      const double x = std::floor(place->x) - frame_.window.x0, y = std::floor(place->y) - frame_.window.y0;
      if (!(x >= 0 && y >= 0 && x < frame_.width() && y < frame_.height())) return false;
      return fits(-p.z, view.planes.at("depth").channels[0].at(int(x), int(y)));
    });
  }

  const Tracer& tracer_;
  const Frame& frame_;
};

/// Sums over one half of a pixel's rays.
struct Half {
  dvec3 radiance{0.0};
  double weights = 0, shown = 0;
};

class ReflectionTracer {
 public:
  ReflectionTracer(const Tracer& tracer, const Frame& frame, const ReflectionReferenceOptions& options)
      : tracer_(tracer), shown_(tracer, frame), options_(options) {}

  long long trace(const ViewTracer& pixels, const Site& site, int x, int y, uint32_t pixel, float* value,
                  float& noise) const {
    const Gloss gloss = gloss_at(pixels.view(), site, x, y);
    std::fill(value, value + 4, 0.0f);
    if (gloss.reflectance == dvec3(0)) return 0;
    const GgxLobe lobe(gloss.roughness, glm::transpose(site.to_world) * site.to_eye);
    const int samples = lobe.is_mirror() ? mirror_samples : rounded_samples(options_.samples);
    const auto seeds = seeds_of_halves(pixel, options_.seed);
    const Half a = half(site, lobe, gloss.reflectance, samples / 2, seeds[0]),
               b = half(site, lobe, gloss.reflectance, samples / 2, seeds[1]);
    const dvec3 mean = (a.radiance + b.radiance) / double(samples), off = (a.radiance - b.radiance) / double(samples);
    for (int i = 0; i < 3; ++i) value[i] = float(mean[i]);
    const double weights = a.weights + b.weights;
    value[3] = weights > 0 ? float((a.shown + b.shown) / weights) : 0;
    noise = float(std::abs(off.x + off.y + off.z) / 3);
    return 2LL * samples;
  }

 private:
  Gloss gloss_at(const View& view, const Site& site, int x, int y) const {
    SurfaceMaterial material;
    if (site.surface) material = tracer_.material(*site.surface);
    if (const Plane* roughness = view.find("roughness")) material.roughness = roughness->channels[0].at(x, y);
    if (const Plane* reflectance = view.find("reflectance")) {
      for (size_t i = 0; i < 3; ++i) material.reflectance[int(i)] = reflectance->channels[i].at(x, y);
    }
    return {material.roughness, dvec3(material.reflectance)};
  }

  Half half(const Site& site, const GgxLobe& lobe, const dvec3& reflectance, int samples, uint32_t seed) const {
    Half sum;
    for (int i = 0; i < samples; ++i) {
      const GgxLobe::Sample sample = lobe.sample(scrambled_sobol(uint32_t(i), seed));
      if (sample.direction.z <= 0) continue;
      const dvec3 weight = sample.weight * fresnel(reflectance, sample.cosine);
      add(sum, site, glm::normalize(site.to_world * sample.direction), weight, hash(seed + uint32_t(i)));
    }
    return sum;
  }

  void add(Half& sum, const Site& site, const dvec3& direction, const dvec3& weight, uint32_t seed) const {
    const double mean_weight = (weight.x + weight.y + weight.z) / 3;
    sum.weights += mean_weight;
    if (glm::dot(direction, dvec3(site.facing)) <= 0) return;
    const std::optional<Surface> met = tracer_.first_from(site.origin, direction);
    const vec3 light = met ? radiance(tracer_, *met, seed, 1).all : sky_radiance(tracer_.scene(), direction);
    sum.radiance += weight * dvec3(light);
    if (met ? shown_.point(met->position) : shown_.sky(direction)) sum.shown += mean_weight;
  }

  const Tracer& tracer_;
  Shown shown_;
  const ReflectionReferenceOptions& options_;
};

/// The exposure that brings the largest component of nearly all reflecting pixels to at most 1.
double exposure_for(const Frame& frame) {
  std::vector<float> largest;
  for (const View& view : frame.views) {
    const std::vector<Channel>& c = view.planes.at("reflection").channels;
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) {
        const float value = std::max({c[0].at(x, y), c[1].at(x, y), c[2].at(x, y)});
        if (value > 0) largest.push_back(value);
      }
    }
  }
  if (largest.empty()) return 1;
  const auto at = largest.begin() + std::ptrdiff_t(white_percentile * double(largest.size() - 1));
  std::nth_element(largest.begin(), at, largest.end());
  return 1 / double(*at);
}

}  // namespace

Reference reflection_reference(const Tracer& tracer, const Frame& frame, const ReflectionReferenceOptions& options) {
  check_samples(options.samples);
  check_views(frame);
  const ReflectionTracer pixels(tracer, frame, options);
  RowsOptions rows = rows_of("reflection", {0, 0, 0, 0}, options);
  Fingerprint print;
  print.add_light(tracer.scene());
  print.add_gloss(frame);
  rows.key = fmt::format("{} samples {} seed {}", print.text(), rounded_samples(options.samples), options.seed);
  rows.trace = [&](const ViewTracer& view, const Site& site, int x, int y, uint32_t pixel, float* value, float& noise) {
    return pixels.trace(view, site, x, y, pixel, value, noise);
  };
  Reference result = trace_rows(tracer, frame, rows);
  describe(result, "reflection", rounded_samples(options.samples),
           "light that visible surfaces reflect towards the eye (GGX, Smith, Schlick) from what leaves others the same "
           "in every direction, and from the sky; A is the share of it that the frame shows");
  result.frame.numbers["gloamExposure"] = exposure_for(result.frame);
  return result;
}

}  // namespace gloam
