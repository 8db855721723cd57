#include "gloam/flicker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "frame/two_cameras.h"
#include "gloam/error.h"
#include "gloam/projection.h"

namespace gloam {
namespace {

/// Share by which a surface's depth may differ from the one expected, as for techniques with a history.
constexpr double same_depth = 0.05;

/// Least sum of the weights of the pixels around a place that show the surface: for a comparison, and for the surface to have been
/// in view, as for techniques with a history. At an edge a surface may be in view by less than what a comparison needs.
constexpr double least_weight = 0.5, least_weight_in_view = 0.01;

/// Age of surfaces that the first frame shows.
constexpr unsigned char always = 255;

bool has_pose(const Surfaces& surfaces) { return surfaces.camera && surfaces.camera->pose; }

/// Where a surface was in the frame before: pixels from the centre of the window's first pixel, and its depth there.
struct Place {
  glm::dvec2 at;
  double depth;
};

/// Up to four pixels of the frame before that show a surface; weights add up to 1.
struct Past {
  std::array<int, 4> x{}, y{};
  std::array<double, 4> weight{};
  int count = 0;
  double sum = 0;  ///< of the weights, before they were scaled

  bool is_in_view() const { return sum > least_weight_in_view; }
  bool is_comparable() const { return sum >= least_weight; }
  double value_of(const Channel& channel) const {
    double value = 0;
    for (size_t k = 0; k < size_t(count); ++k) value += weight[k] * double(channel.at(x[k], y[k]));
    return value;
  }
};

/// Surfaces of two neighbouring frames.
class Pair {
 public:
  Pair(const SequenceFramePlanes& now, const SequenceFramePlanes& before)
      : now_(now.surfaces),
        before_(before.surfaces),
        mask_(before.foreground),
        source_(motion_source(now.surfaces, before.surfaces)),
        has_cameras_(has_pose(now_) && has_pose(before_)),
        width_(now.test.channels[0].layout().width),
        height_(now.test.channels[0].layout().height) {
    if (has_cameras_) camera_motion_ = motion_between(*now_.camera->pose, *before_.camera->pose);
  }

  MotionSource source() const { return source_; }

  /// Pixels of the frame before that show the surface of a pixel of the foreground.
  Past past_of(int x, int y) const {
    const std::optional<Place> place = place_of(x, y);
    return place ? around(*place, slope_at(x, y)) : Past{};
  }

 private:
  std::optional<Place> place_of(int x, int y) const {
    const double depth = now_.depth ? double(now_.depth->at(x, y)) : 0;
    Place place{{x, y}, depth};
    if (has_cameras_ && now_.depth) {
      const std::optional<ViewRay> ray = view_ray(*now_.camera, {now_.window.x0 + x + 0.5, now_.window.y0 + y + 0.5});
      if (!ray) return {};
      const glm::dvec3 point = camera_motion_.of_point(ray->at(depth));
      place.depth = -point.z;
      if (source_ == MotionSource::cameras) {
        const std::optional<glm::dvec2> at = pixel_of(*before_.camera, point);
        if (!at) return {};
        place.at = *at - glm::dvec2(before_.window.x0 + 0.5, before_.window.y0 + 0.5);
      }
    }
    if (source_ == MotionSource::plane)
      place.at += glm::dvec2(now_.motion->channels[0].at(x, y), now_.motion->channels[1].at(x, y));
    const bool is_inside = place.at.x > -1 && place.at.y > -1 && place.at.x < width_ && place.at.y < height_;
    return is_inside ? std::optional(place) : std::nullopt;  // false for NaN
  }

  double inverse_depth(int x, int y) const {
    if (x < 0 || y < 0 || x >= width_ || y >= height_ || is_background(now_.depth->at(x, y)))
      return std::numeric_limits<double>::quiet_NaN();
    return 1 / double(now_.depth->at(x, y));
  }

  /// Change of 1 / depth from pixel to pixel, which is the same all over a plane: to the neighbour that differs less, since the
  /// other may lie on another surface.
  glm::dvec2 slope_at(int x, int y) const {
    if (!now_.depth) return {0, 0};
    const double own = inverse_depth(x, y);
    const auto lesser = [](double a, double b) {
      if (!std::isfinite(a) || !std::isfinite(b)) return std::isfinite(a) ? a : std::isfinite(b) ? b : 0.0;
      return std::abs(a) < std::abs(b) ? a : b;
    };
    return {lesser(inverse_depth(x + 1, y) - own, own - inverse_depth(x - 1, y)),
            lesser(inverse_depth(x, y + 1) - own, own - inverse_depth(x, y - 1))};
  }

  bool shows(int x, int y, const Place& place, const glm::dvec2& slope) const {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return false;
    if (!mask_[size_t(y) * size_t(width_) + size_t(x)]) return false;
    if (!now_.depth || !before_.depth) return true;
    const double z = double(before_.depth->at(x, y));
    if (is_background(float(z)) || !(place.depth > 0)) return false;
    // the depth that is expected a part of a pixel away from the place
    const double expected = 1 / place.depth + glm::dot(slope, glm::dvec2(x, y) - place.at);
    return std::abs(expected * z - 1) <= same_depth;
  }

  Past around(const Place& place, const glm::dvec2& slope) const {
    const glm::dvec2 corner = glm::floor(place.at + on_centre), share = glm::max(place.at - corner, glm::dvec2(0));
    Past past;
    for (int k = 0; k < 4; ++k) {
      const double across = share.x < on_centre ? (k & 1 ? 0 : 1) : (k & 1 ? share.x : 1 - share.x),
                   down = share.y < on_centre ? (k >> 1 ? 0 : 1) : (k >> 1 ? share.y : 1 - share.y);
      const int x = int(corner.x) + (k & 1), y = int(corner.y) + (k >> 1);
      if (across * down <= 0 || !shows(x, y, place, slope)) continue;
      const size_t i = size_t(past.count++);
      past.x[i] = x, past.y[i] = y, past.weight[i] = across * down;
      past.sum += across * down;
    }
    if (!past.is_in_view()) return {};
    for (double& weight : past.weight) weight /= past.sum;
    return past;
  }

  const Surfaces &now_, &before_;
  const Mask& mask_;
  MotionSource source_;
  bool has_cameras_;
  CameraMotion camera_motion_;
  int width_, height_;
};

unsigned char age_after(const Past& past, const std::vector<unsigned char>& ages, int width) {
  if (!past.is_in_view()) return 0;
  const size_t most = size_t(std::max_element(past.weight.begin(), past.weight.end()) - past.weight.begin());
  const unsigned char before = ages[size_t(past.y[most]) * size_t(width) + size_t(past.x[most])];
  return before >= always - 1 ? before : (unsigned char)(before + 1);
}

void add_error(FlickerSums& sums, double squared, bool is_new) {
  (is_new ? sums.new_values : sums.old_values) += 1;
  (is_new ? sums.new_squared_error : sums.old_squared_error) += squared;
}

/// Adds a pixel of the foreground.
void add_pixel(FlickerSums& sums, const SequenceFramePlanes& now, const SequenceFramePlanes& before, const Past& past,
               int x, int y, bool is_new) {
  ++sums.pixels;
  sums.comparable += past.is_comparable();
  for (size_t c = 0; c < now.test.channels.size(); ++c) {
    const double test = now.test.channels[c].at(x, y), truth = now.truth.channels[c].at(x, y);
    add_error(sums, (test - truth) * (test - truth), is_new);
    if (!past.is_comparable()) continue;
    const double truth_change = truth - past.value_of(before.truth.channels[c]),
                 difference = test - past.value_of(before.test.channels[c]) - truth_change;
    ++sums.values;
    sums.squared += difference * difference;
    sums.truth_squared += truth_change * truth_change;
  }
}

void check_layout(const Channel& channel, const Layout& layout, const std::string& name) {
  const Layout& own = channel.layout();
  if (own.width != layout.width || own.height != layout.height)
    throw Error("{} is {}x{}, and the sequence is {}x{}", name, own.width, own.height, layout.width, layout.height);
}

void check_frame(const SequenceFramePlanes& frame, const Layout& layout, size_t components) {
  for (const Plane* plane : {&frame.test, &frame.truth}) {
    if (plane->channels.size() != components)
      throw Error("'{}' has {} components, and the sequence has {}", plane->name, plane->channels.size(), components);
    for (const Channel& channel : plane->channels) check_layout(channel, layout, "'" + plane->name + "'");
  }
  if (frame.foreground.size() != size_t(layout.width) * size_t(layout.height))
    throw Error("the mask has {} pixels, and the sequence is {}x{}", frame.foreground.size(), layout.width,
                layout.height);
  if (frame.surfaces.depth) check_layout(*frame.surfaces.depth, layout, "the depth");
  if (!frame.surfaces.motion) return;
  if (frame.surfaces.motion->channels.size() != 2)
    throw Error("motion has {} components instead of x and y", frame.surfaces.motion->channels.size());
  for (const Channel& channel : frame.surfaces.motion->channels) check_layout(channel, layout, "motion");
}

std::optional<double> root_of_mean(double sum, long long count) {
  return count > 0 ? std::optional(std::sqrt(sum / double(count))) : std::nullopt;
}

std::optional<double> share_of(long long part, long long all) {
  return all > 0 ? std::optional(double(part) / double(all)) : std::nullopt;
}

}  // namespace

std::string in_words(MotionSource source) {
  switch (source) {
    case MotionSource::plane:
      return "plane";
    case MotionSource::cameras:
      return "cameras and depth";
    case MotionSource::still:
      break;
  }
  return "none, the image is taken to stand still";
}

MotionSource motion_source(const Surfaces& now, const Surfaces& before) {
  if (now.motion) return MotionSource::plane;
  return now.depth && has_pose(now) && has_pose(before) ? MotionSource::cameras : MotionSource::still;
}

FlickerSums& FlickerSums::operator+=(const FlickerSums& other) {
  pixels += other.pixels, comparable += other.comparable, values += other.values;
  squared += other.squared, truth_squared += other.truth_squared;
  new_values += other.new_values, old_values += other.old_values;
  new_squared_error += other.new_squared_error, old_squared_error += other.old_squared_error;
  return *this;
}

std::optional<double> FlickerSums::flicker() const { return root_of_mean(squared, values); }
std::optional<double> FlickerSums::truth_change() const { return root_of_mean(truth_squared, values); }
std::optional<double> FlickerSums::share() const { return share_of(comparable, pixels); }
std::optional<double> FlickerSums::new_rmse() const { return root_of_mean(new_squared_error, new_values); }
std::optional<double> FlickerSums::old_rmse() const { return root_of_mean(old_squared_error, old_values); }
std::optional<double> FlickerSums::new_share() const { return share_of(new_values, new_values + old_values); }

std::optional<FlickerSums> FlickerMeter::add(SequenceFramePlanes frame) {
  if (frame.test.channels.empty()) throw Error("'{}' has no components", frame.test.name);
  const SequenceFramePlanes& first = before_ ? *before_ : frame;
  const Layout layout = first.test.channels[0].layout();
  check_frame(frame, layout, first.test.channels.size());
  const int width = layout.width, height = layout.height;
  std::vector<unsigned char> ages(size_t(width) * size_t(height), always);
  std::optional<FlickerSums> sums;
  if (before_) {
    const Pair pair(frame, *before_);
    source_ = pair.source();
    std::vector<FlickerSums> rows =
        std::vector<FlickerSums>(size_t(height));  // added in order: the same bits every time
#pragma omp parallel for schedule(dynamic, 16) if (size_t(width) * size_t(height) > 65536)
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const size_t i = size_t(y) * size_t(width) + size_t(x);
        if (!frame.foreground[i]) continue;
        const Past past = pair.past_of(x, y);
        ages[i] = age_after(past, age_, width);
        add_pixel(rows[size_t(y)], frame, *before_, past, x, y, ages[i] < young);
      }
    }
    sums.emplace();
    for (const FlickerSums& row : rows) *sums += row;
  }
  age_ = std::move(ages);
  before_ = std::move(frame);
  return sums;
}

void FlickerMeter::begin_anew() { before_.reset(); }

}  // namespace gloam
