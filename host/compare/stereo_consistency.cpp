#include "gloam/stereo_consistency.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>

#include "frame/two_cameras.h"
#include "gloam/error.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

/// One view as the comparison needs it.
struct ComparedEye : Eye {
  const Plane& values;
  const Plane* normal;  ///< null: no normal-check
  bool are_directions;  ///< values are unit vectors in view space
};

// ---------------------------------------------------------------------------------------------------------------------
// Neighbours

/// The one or two pixels of a row or column around a position.
struct Between {
  int first;
  double weight;  ///< of the pixel after `first`; 0: that pixel is not used
};

Between between(double place) {
  const double from_centre = place - 0.5, first = std::floor(from_centre + on_centre), weight = from_centre - first;
  return {int(first), weight < on_centre ? 0 : weight};
}

/// Up to four pixels with their weights, which add up to 1.
struct Neighbours {
  struct One {
    int x, y;
    double weight;
  };
  std::array<One, 4> pixels;
  int count = 0;
  const One* begin() const { return pixels.data(); }
  const One* end() const { return pixels.data() + count; }
};

Neighbours neighbours_of(const glm::dvec2& place) {
  const Between across = between(place.x), down = between(place.y);
  Neighbours all;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const double weight = (i ? across.weight : 1 - across.weight) * (j ? down.weight : 1 - down.weight);
      if (weight > 0) all.pixels[size_t(all.count++)] = {across.first + i, down.first + j, weight};
    }
  }
  return all;
}

glm::dvec3 vector_at(const Plane& plane, int x, int y) {
  return {plane.channels[0].at(x, y), plane.channels[1].at(x, y), plane.channels[2].at(x, y)};
}

/// Normals need not be unit: renderers that filter them shorten some. NaN and zero length always fail.
bool is_within(double cosine, const glm::dvec3& a, const glm::dvec3& b) {
  const double lengths = glm::length(a) * glm::length(b);
  return lengths > 0 && glm::dot(a, b) >= cosine * lengths;
}

// ---------------------------------------------------------------------------------------------------------------------
// One pixel

/// From one eye to the other.
struct Lookup {
  const ComparedEye &own, &other;
  CameraMotion there, back;
  double cosine;  ///< of the normal-check
};

/// The result of the checks on the neighbours that I is made from.
StereoPixel verdict_of(const Lookup& lookup, int x, int y, const Neighbours& neighbours) {
  const ComparedEye& other = lookup.other;
  for (const auto& n : neighbours) {
    if (!other.holds(n.x, n.y)) return StereoPixel::outside;
  }
  const bool with_normals = lookup.own.normal && other.normal;
  const glm::dvec3 normal = with_normals ? lookup.there.rotation * vector_at(*lookup.own.normal, x, y) : glm::dvec3(0);
  for (const auto& n : neighbours) {
    if (is_background(other.depth.at(n.x, n.y))) return StereoPixel::edge;
    if (with_normals && !is_within(lookup.cosine, normal, vector_at(*other.normal, n.x, n.y))) return StereoPixel::edge;
  }
  return StereoPixel::counted;
}

double interpolated(const Channel& channel, const Neighbours& neighbours) {
  double sum = 0;
  for (const auto& n : neighbours) sum += n.weight * double(channel.at(n.x, n.y));
  return sum;
}

/// |A(p) - I(p)|
double error_at(const Lookup& lookup, int x, int y, const Neighbours& neighbours) {
  const Plane &own = lookup.own.values, &other = lookup.other.values;
  if (lookup.own.are_directions) {
    const glm::dvec3 there(interpolated(other.channels[0], neighbours), interpolated(other.channels[1], neighbours),
                           interpolated(other.channels[2], neighbours));
    return glm::distance(lookup.there.rotation * vector_at(own, x, y), there);
  }
  double squares = 0;
  for (size_t c = 0; c < own.channels.size(); ++c) {
    const double difference = double(own.channels[c].at(x, y)) - interpolated(other.channels[c], neighbours);
    squares += difference * difference;
  }
  return std::sqrt(squares);
}

/// Sets `error` if the pixel counts.
StereoPixel look_up(const Lookup& lookup, int x, int y, float& error) {
  if (is_background(lookup.own.depth.at(x, y))) return StereoPixel::background;
  const glm::dvec2 place = pixel_of(lookup.other, lookup.there.of_point(point_of(lookup.own, x, y)));
  if (!is_inside(lookup.other, place)) return StereoPixel::outside;
  if (!comes_back(lookup.own, lookup.other, lookup.back, x, y, place)) return StereoPixel::hidden;
  const Neighbours neighbours = neighbours_of(place);
  const StereoPixel verdict = verdict_of(lookup, x, y, neighbours);
  if (verdict == StereoPixel::counted) error = float(error_at(lookup, x, y, neighbours));
  return verdict;
}

// ---------------------------------------------------------------------------------------------------------------------
// All pixels

StereoErrors errors_of(const Lookup& lookup) {
  const Layout& layout = lookup.own.depth.layout();
  const int width = layout.width, height = layout.height;
  StereoErrors errors;
  errors.error = Channel(layout, std::numeric_limits<float>::quiet_NaN());
  errors.pixels.resize(size_t(width) * size_t(height));
#pragma omp parallel for schedule(dynamic, 16) if (size_t(width) * size_t(height) > 65536)
  for (int y = 0; y < height; ++y) {
    float* row = errors.error.row(y);
    StereoPixel* pixels = errors.pixels.data() + size_t(y) * size_t(width);
    for (int x = 0; x < width; ++x) pixels[x] = look_up(lookup, x, y, row[x]);
  }
  return errors;
}

void count(StereoFigures& figures, StereoPixel pixel) {
  figures.surfaces += pixel != StereoPixel::background;
  figures.outside += pixel == StereoPixel::outside;
  figures.hidden += pixel == StereoPixel::hidden;
  figures.edge += pixel == StereoPixel::edge;
  figures.counted += pixel == StereoPixel::counted;
}

/// Figures of counted errors. Doubles, added in pixel order on one thread: the same bits every time.
void measure(StereoFigures& figures, std::vector<float>& errors) {
  if (errors.empty()) return;
  double sum = 0, squares = 0;
  for (const float e : errors) {
    sum += double(e);
    squares += double(e) * double(e);
  }
  const size_t n = errors.size(), rank = (99 * n + 99) / 100 - 1;
  figures.mean = sum / double(n);
  figures.rmse = std::sqrt(squares / double(n));
  std::nth_element(errors.begin(), errors.begin() + long(rank), errors.end());
  figures.p99 = double(errors[rank]);
  figures.max = double(*std::max_element(errors.begin() + long(rank), errors.end()));
}

/// Figures over one view or several.
StereoFigures figures_of(const std::vector<const StereoErrors*>& views) {
  StereoFigures figures;
  std::vector<float> errors;
  for (const StereoErrors* view : views) {
    const Layout& layout = view->error.layout();
    const StereoPixel* pixel = view->pixels.data();
    for (int y = 0; y < layout.height; ++y) {
      for (int x = 0; x < layout.width; ++x, ++pixel) {
        count(figures, *pixel);
        if (*pixel == StereoPixel::counted) errors.push_back(view->error.at(x, y));
      }
    }
  }
  measure(figures, errors);
  return figures;
}

void check_finite(const StereoErrors& errors, const std::string& view, const std::string& plane) {
  const Layout& layout = errors.error.layout();
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      const bool counts = errors.pixels[size_t(y) * size_t(layout.width) + size_t(x)] == StereoPixel::counted;
      if (!counts || std::isfinite(errors.error.at(x, y))) continue;
      throw Error("'{}' is not finite at pixel ({}, {}) of view '{}', or where the other view shows the same surface",
                  plane, x, y, view);
    }
  }
}

// ---------------------------------------------------------------------------------------------------------------------
// What is needed

void check_views(const Frame& frame, const std::string& plane, const Layout& layout) {
  if (frame.views.size() != 2)
    throw Error("the stereo inconsistency is between two views, and the frame has {}", frame.views.size());
  for (const View& view : frame.views) check_eye(view, layout);
  const size_t a = plane_in(frame.views[0], plane, layout).channels.size();
  const size_t b = plane_in(frame.views[1], plane, layout).channels.size();
  if (a != b) throw Error("'{}' has {} components in one view and {} in the other", plane, a, b);
}

bool has_normals(const Frame& frame) {
  return std::all_of(frame.views.begin(), frame.views.end(), [](const View& view) { return view.find("normal"); });
}

ComparedEye eye_of(const Frame& frame, const View& view, const std::string& plane, bool with_normals,
                   const Layout& layout) {
  const bool are_directions = plane_kind(plane).meaning == PlaneKind::unit_vector;
  return {{*view.camera, frame.window, plane_in(view, "depth", layout).channels[0]},
          plane_in(view, plane, layout),
          with_normals ? &plane_in(view, "normal", layout) : nullptr,
          are_directions};
}

/// Lookups from either eye to the other. `cosine`: of the normal-check.
std::array<Lookup, 2> lookups(const Frame& frame, const std::array<ComparedEye, 2>& eyes, double cosine) {
  const Pose &first = *frame.views[0].camera->pose, &second = *frame.views[1].camera->pose;
  const CameraMotion there = motion_between(first, second), back = motion_between(second, first);
  return {{{eyes[0], eyes[1], there, back, cosine}, {eyes[1], eyes[0], back, there, cosine}}};
}

}  // namespace

StereoInconsistency stereo_inconsistency(const Frame& frame, const std::string& plane, const StereoOptions& options) {
  const Layout layout(frame.width(), frame.height());
  check_views(frame, plane, layout);
  StereoInconsistency result;
  if (has_normals(frame)) result.normal_check = options.normal_check;
  const double cosine = std::cos(result.normal_check.value_or(0) * std::numbers::pi / 180);
  const auto eye = [&](size_t i) {
    return eye_of(frame, frame.views[i], plane, result.normal_check.has_value(), layout);
  };
  const std::array<ComparedEye, 2> eyes = {eye(0), eye(1)};
  const std::array<Lookup, 2> both = lookups(frame, eyes, cosine);
  for (size_t i = 0; i < 2; ++i) result.views[i] = errors_of(both[i]);
  for (size_t i = 0; i < 2; ++i) {
    check_finite(result.views[i], frame.views[i].name, plane);
    result.views[i].figures = figures_of({&result.views[i]});
  }
  result.both = figures_of({&result.views[0], &result.views[1]});
  if (result.both.counted == 0)
    throw Error("the views '{}' and '{}' have no surface in common: of {} pixels with a surface none counts",
                frame.views[0].name, frame.views[1].name, result.both.surfaces);
  return result;
}

}  // namespace gloam
