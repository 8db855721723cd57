#include "gloam/scene/contact_reference.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <map>

#include "base/files.h"
#include "base/low_discrepancy.h"
#include "gloam/error.h"
#include "scene/fingerprint.h"
#include "scene/reference_rows.h"
#include "scene/scene_checks.h"

namespace gloam {
namespace {

using glm::dvec3;
using glm::vec3;

/// Shadow rays end this share of the distance before a light, which may stand on a surface.
constexpr double before_light = 1e-5;

bool is_finite(const dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// A light, relative to Scene::origin.
struct ShadowLight {
  bool is_point = false;
  dvec3 at{0.0};      ///< a position, or the unit direction towards it
  double disc = 0;    ///< tangent of the angular radius
  double length = 0;  ///< of shadow rays
};

class ContactTracer {
 public:
  ContactTracer(const Tracer& tracer, const ShadowLight& light) : tracer_(tracer), light_(light) {}

  /// Mean over the disc, of one half of its points, or over its middle alone for one sample.
  double half(const Site& site, const dvec3& position, int samples, uint32_t seed) const {
    const dvec3 towards = light_.is_point ? light_.at - position : light_.at;
    const double distance = light_.is_point ? glm::length(towards) : std::numeric_limits<double>::infinity();
    if (distance == 0) return 1;
    const glm::dmat3 about = frame_about(glm::normalize(towards));
    const double far = std::min(light_.length, distance * (1 - before_light));
    int lit = 0;
    for (int first = 0; first < samples; first += rays_per_packet)
      lit += lit_of_packet(site, about, float(far), std::min(rays_per_packet, samples - first), first, seed);
    return double(lit) / samples;
  }

 private:
  int lit_of_packet(const Site& site, const glm::dmat3& about, float far, int samples, int first, uint32_t seed) const {
    vec3 directions[rays_per_packet];
    bool blocked[rays_per_packet];
    int count = 0;
    for (int i = 0; i < samples; ++i) {
      const glm::dvec2 u = scrambled_sobol(uint32_t(first + i), seed);
      const double radius = light_.disc * std::sqrt(u.x), angle = glm::two_pi<double>() * u.y;
      const dvec3 direction = glm::normalize(about * dvec3(radius * std::cos(angle), radius * std::sin(angle), 1.0));
      if (glm::dot(direction, site.to_world[2]) <= 0 || glm::dot(vec3(direction), site.facing) <= 0) continue;
      directions[count++] = vec3(direction);
    }
    tracer_.blocked(site.origin, directions, count, far, blocked);
    return count - int(std::count(blocked, blocked + count, true));
  }

  const Tracer& tracer_;
  ShadowLight light_;
};

ShadowLight light_of(const Scene& scene, const ContactReferenceOptions& options) {
  if (options.light_direction && options.light_position)
    throw UsageError("a light has a direction or a position; both are given, so leave one out");
  for (const auto& [name, given] :
       {std::pair("direction", options.light_direction), std::pair("position", options.light_position)}) {
    if (given && !is_finite(*given))
      throw UsageError("the light's {} {} is not allowed; finite numbers are", name, in_words(*given));
  }
  if (options.light_direction && !(glm::length(*options.light_direction) > 0))
    throw UsageError("the light's direction {} is not allowed; one that is not 0 is",
                     in_words(*options.light_direction));
  if (!(options.light_angle >= 0 && options.light_angle <= most_light_angle))
    throw UsageError("a light of the angular radius {:g} is not allowed; 0 to {:g} degrees are", options.light_angle,
                     most_light_angle);
  ShadowLight light;
  light.is_point = options.light_position.has_value();
  light.disc = std::tan(options.light_angle * glm::pi<double>() / 180);
  light.length = options.radius;
  if (light.is_point) {
    light.at = *options.light_position - scene.origin;
    return light;
  }
  if (!options.light_direction) check_sun_direction(scene);
  light.at = glm::normalize(options.light_direction.value_or(dvec3(scene.light.to_sun)));
  return light;
}

bool shows_lit(const Frame& result) {
  for (const View& view : result.views) {
    const Channel &contact = view.planes.at("contact").channels[0], &depth = view.planes.at("depth").channels[0];
    for (int y = 0; y < result.height(); ++y) {
      for (int x = 0; x < result.width(); ++x) {
        if (!is_background(depth.at(x, y)) && contact.at(x, y) > 0) return true;
      }
    }
  }
  return false;
}

/// How often a ray leaves each mesh, less how often it enters it.
std::map<int, int> times_left(const Tracer& tracer, const dvec3& point, const dvec3& direction) {
  std::vector<Crossing> crossings;
  tracer.crossings({point, direction}, crossings);
  std::map<int, int> times;
  for (const Crossing& crossing : crossings) times[crossing.mesh] += crossing.back_face ? 1 : -1;
  return times;
}

/// The mesh that a point lies in: one that rays leave to both sides. Empty if there is none.
std::string mesh_around(const Tracer& tracer, const dvec3& point) {
  const dvec3 any(0.31, 0.83, 0.47);
  const std::map<int, int> ahead = times_left(tracer, point, any), behind = times_left(tracer, point, -any);
  for (const auto& [mesh, times] : ahead) {
    const auto there = behind.find(mesh);
    if (times > 0 && there != behind.end() && there->second > 0) return tracer.scene().meshes[size_t(mesh)].name;
  }
  return "";
}

void note_darkness(Reference& reference, const Tracer& tracer, const ShadowLight& light) {
  if (shows_lit(reference.frame)) return;
  const std::string mesh = light.is_point ? mesh_around(tracer, light.at) : "";
  reference.notes.push_back(
      mesh.empty()
          ? "the light reaches no surface that the frame shows"
          : fmt::format("the light reaches no surface that the frame shows: it lies inside '{}'", printable(mesh)));
}

}  // namespace

Reference contact_reference(const Tracer& tracer, const Frame& frame, const ContactReferenceOptions& options) {
  check_radius(options.radius);
  check_samples(options.samples);
  check_views(frame);
  const ShadowLight light = light_of(tracer.scene(), options);
  const int samples = light.disc > 0 ? rounded_samples(options.samples) : 1;
  const ContactTracer pixels(tracer, light);
  RowsOptions rows = rows_of("contact", {1}, options);
  rows.key = fmt::format("{} {} disc {} length {} samples {} seed {}", light.is_point ? "position" : "direction",
                         in_words(light.at), light.disc, options.radius, samples, options.seed);
  rows.trace = [&](const ViewTracer&, const Site& site, int, int, uint32_t pixel, float* value,
                   float& noise) -> long long {
    const dvec3 position = site.surface ? site.surface->position : dvec3(site.origin);
    if (samples == 1) {
      *value = float(pixels.half(site, position, 1, 0));
      return 1;
    }
    const auto seeds = seeds_of_halves(pixel, options.seed);
    const double a = pixels.half(site, position, samples / 2, seeds[0]),
                 b = pixels.half(site, position, samples / 2, seeds[1]);
    *value = float((a + b) / 2);
    noise = float(std::abs(a - b) / 2);
    return samples;
  };
  Reference result = trace_rows(tracer, frame, rows);
  describe(result, "contact", samples,
           "share of the light with nothing between it and the surface within contactLength; 0 on surfaces that face "
           "away");
  result.frame.numbers["contactLength"] = options.radius;
  note_darkness(result, tracer, light);
  return result;
}

}  // namespace gloam
