#include "gloam/scene/outlines.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <glm/gtc/constants.hpp>

#include "base/elapsed.h"
#include "scene/textures.h"

namespace gloam {
namespace {

using glm::dvec3;

/// A face nearer to a ray's end than this share of its length counts as at the end: depths are stored as floats, and outlines may
/// touch other objects.
constexpr double at_end = 1e-6;

/// Faces entered minus faces left.
template <typename Counts>
int entered_less_left(const Tracer& tracer, const TracerRay& ray, const Counts& counts) {
  thread_local std::vector<Crossing> crossings;
  tracer.crossings(ray, crossings);
  int sum = 0;
  for (const Crossing& crossing : crossings) {
    if (counts(crossing)) sum += crossing.back_face ? -1 : 1;
  }
  return sum;
}

/// Directions all over the sphere (a Fibonacci lattice, none along an axis).
dvec3 direction(int i, int of) {
  const double z = 1 - (2 * i + 1.0) / of, angle = 2.4 * i + 0.7, radius = std::sqrt(1 - z * z);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

}  // namespace

Outlines::Outlines(const Tracer& tracer, const OutlineOptions& options) : objects_(tracer), options_(options) {
  const auto start = std::chrono::steady_clock::now();
  const Scene& objects = tracer.scene();
  scene_.name = objects.name;
  scene_.origin = objects.origin;
  scene_.cameras = objects.cameras;
  scene_.materials.emplace_back();
  scene_.meshes.resize(objects.meshes.size());
  closed_.resize(objects.meshes.size());
  std::exception_ptr failure;  // an exception may not leave a parallel loop
#pragma omp parallel for schedule(dynamic)
  for (size_t i = 0; i < objects.meshes.size(); ++i) {
    try {
      Outline outline = outline_of(objects.meshes[i], options);
      // A ray may pass through holes that the outline of the object lacks.
      if (has_holes(objects, objects.meshes[i])) std::fill(outline.closed.begin(), outline.closed.end(), char(0));
      scene_.meshes[i] = std::move(outline.mesh);
      closed_[i] = std::move(outline.closed);
    } catch (...) {
#pragma omp critical
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
  outlines_ = std::make_unique<Tracer>(scene_);
  build_seconds_ = seconds_since(start);
}

int Outlines::crossings(const TracerRay& ray) const {
  TracerRay longer = ray;  // faces at the end are decided in double
  longer.far *= 1 + 1e-4;
  return entered_less_left(*outlines_, longer,
                           [&](const Crossing& crossing) { return crossing.distance < ray.far * (1 - at_end); });
}

/// On the way from a point inside to infinity, in any direction, a closed surface is left once more than it is entered: minus the
/// crossings of the whole ray tell how often it encloses the start. Of the outline alone this would count an eye in a room whose
/// walls face outwards as inside a larger solid, and one deep in a room that faces inwards as -1, since such an outline shrinks.
/// Subtracting the object's own count leaves only the layer between the two, where a ray from free space arrives at the visible
/// surface. A surface with a border has neither inside nor outside: its count would depend on the ray, so it is left out, and an
/// eye between such a surface and its outline counts one too few.
int Outlines::around(const dvec3& point, const dvec3& direction) const {
  const TracerRay ray{point, direction};
  const auto is_closed = [&](const Crossing& crossing) {
    return closed_[size_t(crossing.mesh)][crossing.triangle] != 0;
  };
  return entered_less_left(objects_, ray, is_closed) - entered_less_left(*outlines_, ray, is_closed);
}

int Outlines::around(const dvec3& point) const {
  // All but those that meet an edge agree: the median is right.
  std::array<int, 15> counts;
  for (size_t i = 0; i < counts.size(); ++i) counts[i] = around(point, direction(int(i), int(counts.size())));
  std::nth_element(counts.begin(), counts.begin() + counts.size() / 2, counts.end());
  return counts[counts.size() / 2];
}

}  // namespace gloam
