#include "normalise/depth_by_normals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "base/golden_section.h"
#include "normalise/normal_form.h"
#include "normalise/straightness.h"

namespace gloam {
namespace {

using glm::dvec3;

/// Distances in pixels of the neighbours that a gradient is made of; steps of values hide a surface from the small one.
constexpr int reaches_of_gradient[] = {1, 4, 12};
constexpr size_t fewest_samples = 100;
/// Beside an edge a gradient tells nothing: the second difference over the first.
constexpr double most_bent = 0.1;
constexpr double most_degrees = 20, largest_agreeing = 8;
constexpr Poles poles_to_try{.on_a_side = 40, .nearest = 0.002, .farthest = 4};
constexpr double least_most_of_refining = 1;
constexpr double least_quantile = 0.005;
/// Noise that any meaning has.
constexpr double degrees_of_noise = 0.3;
/// Where one plane is all there is, some odd convention of the normals serves any meaning.
constexpr double weight_of_departure = 0.1;
/// Planar distance is given up for what misses by so much less: a pole of any value makes up for a wrong field of view, steps and soft normals.
constexpr double least_gain_on_planar = 1, least_ratio_on_planar = 1.5, least_gain_of_pole = 2.5,
                 least_ratio_of_pole = 2.2;
/// Where most samples say so, and by far, less of a mean will do: edges and bent normals miss by any meaning. So it will where planar distance needs
/// normals in a much odder convention.
constexpr double least_gain_of_clear_pole = 1, least_ratio_of_medians = 3, least_median_of_planar = 1,
                 least_ratio_beside_odd_axes = 1.5, least_departure_of_odd_axes = 3;
/// The same where the camera is a guess.
constexpr double least_ratio_of_guess = 4;
/// The sum of the variances of the normals' components, as stored. Normals of one direction tell nothing.
constexpr double least_variance = 0.002;
/// A kind that misses by less than this times the one that is taken, after both weights, may be meant as well.
constexpr double clear_lead = 1.5;

/// A stored value with its gradient per pixel, the slope of its ray, and the normal beside it.
struct GradientSample {
  double value, along_x, along_y, ray_x, ray_y;
  dvec3 normal;
};

/// What is the same for all meanings.
struct Beside {
  std::vector<GradientSample> samples;
  const Camera& camera;
  const NormalConvention& stated;
  double low = 0, high = 0;
};

std::optional<GradientSample> gradient_at(const DepthValues& depth, float sign, const Background& background, int x,
                                          int y, int reach) {
  if (x < reach || y < reach || x + reach >= depth.width || y + reach >= depth.height) return {};
  const auto at = [&](int u, int v) { return sign * depth.at(u, v); };
  const float here = at(x, y), left = at(x - reach, y), right = at(x + reach, y), above = at(x, y - reach),
              below = at(x, y + reach);
  for (const float value : {here, left, right, above, below})
    if (!is_surface(value, background)) return {};
  const double across = double(right) - double(left), down = double(below) - double(above);
  if (across == 0 && down == 0) return {};  // a sky, or a surface that tells nothing
  const double bend_x = double(right) + double(left) - 2 * double(here),
               bend_y = double(below) + double(above) - 2 * double(here);
  const double most = 2 * most_bent * std::max(std::abs(across), std::abs(down));
  if (std::max(std::abs(bend_x), std::abs(bend_y)) > most) return {};
  return GradientSample{double(here), across / (2 * reach), down / (2 * reach), 0, 0, dvec3(0.0)};
}

std::optional<GradientSample> gradient_beside_normal(const DepthValues& depth, float sign, const Background& background,
                                                     const Window& window, const Camera& camera,
                                                     const NormalSamples::Sample& sample, int reach) {
  const double length = glm::length(sample.normal);
  if (!(length > 0) || !std::isfinite(length)) return {};
  std::optional<GradientSample> gradient = gradient_at(depth, sign, background, sample.x, sample.y, reach);
  if (!gradient) return {};
  gradient->ray_x = (window.x0 + sample.x + 0.5 - camera.cx) / camera.fx;
  gradient->ray_y = -(window.y0 + sample.y + 0.5 - camera.cy) / camera.fy;
  gradient->normal = sample.normal;
  return gradient;
}

std::vector<GradientSample> gradients_of(const DepthValues& depth, float sign, const Background& background,
                                         const Window& window, const Camera& camera, const NormalSamples& normals,
                                         int reach, std::vector<double>& values) {
  std::vector<GradientSample> found;
  for (const NormalSamples::Sample& sample : normals.all()) {
    if (const float value = sign * depth.at(sample.x, sample.y); is_surface(value, background))
      values.push_back(double(value));
    const auto gradient = gradient_beside_normal(depth, sign, background, window, camera, sample, reach);
    if (gradient) found.push_back(*gradient);
  }
  return found;
}

/// Without the least and the largest of all values, so that a pole may lie beside the rest.
void keep_the_middle(std::vector<double> values, Beside& beside) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) { return values[size_t(share * double(values.size() - 1))]; };
  beside.low = at(least_quantile), beside.high = at(1 - least_quantile);
  std::erase_if(beside.samples,
                [&](const GradientSample& sample) { return sample.value < beside.low || sample.value > beside.high; });
}

/// The normal of the surface, in view space, that a sample's gradient shows by a meaning.
dvec3 normal_by(const GradientSample& sample, const DepthMeaning& meaning, const Camera& camera) {
  const double sign = meaning.kind == DepthMeaning::inverse ? -1 : 1, scale = sign / (sample.value - meaning.pole);
  double in_x = scale * sample.along_x, in_y = scale * sample.along_y;  // of the logarithm of the planar distance
  if (meaning.kind == DepthMeaning::along_ray) {
    const double square = 1 + sample.ray_x * sample.ray_x + sample.ray_y * sample.ray_y;
    in_x -= sample.ray_x / camera.fx / square;
    in_y += sample.ray_y / camera.fy / square;
  }
  const dvec3 ray(sample.ray_x, sample.ray_y, -1);
  const dvec3 right = in_x * ray + dvec3(1 / camera.fx, 0, 0), below = in_y * ray - dvec3(0, 1 / camera.fy, 0);
  const dvec3 normal = glm::cross(below, right);
  const double length = glm::length(normal);
  return length > 0 ? normal / length : dvec3(0.0);
}

/// A meaning with how much its normals miss those beside it, which are taken in the convention that serves it best.
ReadDepth read_by(const Beside& beside, const DepthMeaning& meaning, double most = most_degrees) {
  std::vector<NormalPair> pairs;
  pairs.reserve(beside.samples.size());
  for (const GradientSample& sample : beside.samples)
    pairs.push_back({sample.normal, normal_by(sample, meaning, beside.camera)});
  const std::optional<NormalForm> form = best_agreeing_form(pairs, beside.camera.pose, beside.stated);
  if (!form) return {meaning, most_degrees, most_degrees, 0, true};
  double sum = 0;
  std::vector<double> all;
  all.reserve(pairs.size());
  for (const NormalPair& pair : pairs) {
    const dvec3 apart = view_normal(pair.stored, *form, beside.camera.pose) - pair.from_depth;
    all.push_back(std::min(most, glm::degrees(glm::length(apart))));
    sum += all.back();
  }
  const auto middle = all.begin() + std::ptrdiff_t(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return {meaning, sum / double(pairs.size()), *middle, departure_of(*form), form->axes == plain_axes};
}

std::vector<DepthMeaning> meanings_beside(double low, double high) {
  std::vector<DepthMeaning> meanings = {{DepthMeaning::planar}, {DepthMeaning::along_ray}, {DepthMeaning::inverse, 0}};
  for (const DepthMeaning::Kind kind : {DepthMeaning::inverse, DepthMeaning::grey})
    for (const double pole : poles_beside(low, high, poles_to_try)) meanings.push_back({kind, pole});
  return meanings;
}

/// The pole that misses least between two beside it, by golden sections.
ReadDepth with_refined_pole(const Beside& beside, const ReadDepth& found) {
  const double side = found.meaning.pole > beside.high ? beside.high : beside.low, away = found.meaning.pole - side;
  constexpr double step = 1.35;
  // Edges and bent surfaces, which miss by more, say nothing of the pole.
  const double most = std::min(most_degrees, least_most_of_refining + 2 * found.degrees);
  const auto read = [&](double distance, double at_most) {
    return read_by(beside, {found.meaning.kind, side + distance}, at_most);
  };
  const double least =
      least_between(away / step, away * step, 16, [&](double distance) { return read(distance, most).degrees; });
  const ReadDepth refined = read(least, most_degrees);
  return refined.degrees < found.degrees + degrees_of_noise ? refined : found;
}

/// How much less a meaning has to miss than planar distance: the plainer ones come first, and poles where files have them.
double weight_of(const DepthMeaning& meaning, const Beside& beside) {
  const bool is_above = meaning.pole > beside.high, is_in_unit_interval = beside.low > 0 && beside.high <= 1;
  switch (meaning.kind) {
    case DepthMeaning::planar:
      return 1;
    case DepthMeaning::along_ray:
      return 1.05;
    case DepthMeaning::inverse: {
      if (meaning.pole == 0) return 1.1;
      const bool is_device_depth =
          is_in_unit_interval && (is_above ? meaning.pole > 1 && meaning.pole < 1.2 : meaning.pole > -0.2);
      return is_device_depth ? 1.15 : 1.6;
    }
    default:
      return 1.3;
  }
}

double cost_of(const ReadDepth& read, const Beside& beside) {
  return (read.degrees + degrees_of_noise) * weight_of(read.meaning, beside) *
         (1 + weight_of_departure * read.departure);
}

/// Enough samples to see which poles are near the best one.
Beside some_of(const Beside& beside) {
  constexpr size_t enough = 1000;
  const size_t apart = std::max<size_t>(1, beside.samples.size() / enough);
  Beside some{{}, beside.camera, beside.stated, beside.low, beside.high};
  for (size_t i = 0; i < beside.samples.size(); i += apart) some.samples.push_back(beside.samples[i]);
  return some;
}

/// Whether a meaning agrees so much better than planar distance that it is taken instead.
bool refutes_planar(const ReadDepth& read, const ReadDepth& planar, const Camera& camera) {
  if (read.meaning.kind == DepthMeaning::planar) return true;
  const bool has_pole = read.meaning.pole != 0, is_guess = camera.source.starts_with("assumed");
  const double gain = planar.degrees - read.degrees;
  const bool is_clear = planar.median >= std::max(least_median_of_planar, least_ratio_of_medians * read.median);
  const bool is_plainer = planar.departure - read.departure >= least_departure_of_odd_axes &&
                          planar.degrees >= least_ratio_beside_odd_axes * read.degrees;
  if (has_pole && !is_guess && gain >= least_gain_of_clear_pole && (is_clear || is_plainer)) return true;
  const double ratio = has_pole ? (is_guess ? least_ratio_of_guess : least_ratio_of_pole) : least_ratio_on_planar;
  return gain >= (has_pole ? least_gain_of_pole : least_gain_on_planar) && planar.degrees >= ratio * read.degrees;
}

bool are_alike(const std::vector<GradientSample>& samples) {
  dvec3 sum(0.0), squares(0.0);
  for (const GradientSample& sample : samples) sum += sample.normal, squares += sample.normal * sample.normal;
  const double n = double(samples.size());
  const dvec3 variance = squares / n - sum * sum / (n * n);
  return variance.x + variance.y + variance.z < least_variance;
}

/// Whether they are the same but for where the pole lies: of no use to tell apart.
bool are_of_a_kind(const DepthMeaning& a, const DepthMeaning& b) {
  const auto is_length = [](const DepthMeaning& m) {
    return m.kind == DepthMeaning::planar || m.kind == DepthMeaning::grey;
  };
  return a.kind == b.kind || (is_length(a) && is_length(b));
}

/// Planar distance by the focal length that serves it best, as a factor to the camera's.
std::pair<ReadDepth, double> planar_by_other_view(const Beside& beside) {
  constexpr int steps = 17;
  constexpr double least_factor = 0.35, most_factor = 3;
  std::pair<ReadDepth, double> best{{{}, most_degrees, most_degrees, 0, true}, 1};
  for (int i = 0; i < steps; ++i) {
    const double factor = least_factor * std::pow(most_factor / least_factor, i / (steps - 1.0));
    Camera camera = beside.camera;
    camera.fx *= factor, camera.fy *= factor;
    Beside other{beside.samples, camera, beside.stated, beside.low, beside.high};
    for (GradientSample& sample : other.samples) sample.ray_x /= factor, sample.ray_y /= factor;
    if (const ReadDepth read = read_by(other, {}); read.degrees < best.first.degrees) best = {read, factor};
  }
  return best;
}

/// Takes planar distance for a meaning with a pole that makes up for a wrong field of view.
void prefer_other_view(const Beside& beside, int width, MeaningByNormals& found) {
  constexpr double most_ratio = 1.05;
  if (found.taken.meaning.pole == 0) return;
  const auto [read, factor] = planar_by_other_view(beside);
  if (read.degrees > most_ratio * found.taken.degrees + degrees_of_noise) return;
  found.other_view = 2 * glm::degrees(std::atan(0.5 * width / (beside.camera.fx * factor)));
  found.degrees_of_other_view = read.degrees;
  found.as_good_as = found.taken;
  found.taken = found.planar;
}

MeaningByNormals meaning_of(const Beside& beside, int width) {
  const std::vector<DepthMeaning> meanings = meanings_beside(beside.low, beside.high);
  constexpr size_t without_pole = 3;
  const Beside some = some_of(beside);
  std::vector<ReadDepth> all(meanings.size());
#pragma omp parallel for schedule(dynamic, 4)
  for (size_t i = 0; i < meanings.size(); ++i) all[i] = read_by(i < without_pole ? beside : some, meanings[i]);
  const auto costs_less = [&](const ReadDepth& a, const ReadDepth& b) {
    return cost_of(a, beside) < cost_of(b, beside);
  };
  // Of each kind with a pole the best two coarse ones, one on either side, are refined.
  std::vector<ReadDepth> candidates(all.begin(), all.begin() + without_pole);
  for (const DepthMeaning::Kind kind : {DepthMeaning::inverse, DepthMeaning::grey})
    for (const bool is_above : {false, true}) {
      const ReadDepth* best = nullptr;
      for (size_t i = without_pole; i < all.size(); ++i) {
        const bool is_asked = all[i].meaning.kind == kind && (all[i].meaning.pole > beside.high) == is_above;
        if (is_asked && (!best || costs_less(all[i], *best))) best = &all[i];
      }
      if (best && best->degrees < largest_agreeing + 4) candidates.push_back(*best);
    }
#pragma omp parallel for schedule(dynamic, 1)
  for (size_t i = without_pole; i < candidates.size(); ++i)
    candidates[i] = with_refined_pole(beside, read_by(beside, candidates[i].meaning));
  MeaningByNormals found;
  found.planar = all.front();
  std::vector<ReadDepth> refuting = candidates;
  std::erase_if(refuting, [&](const ReadDepth& read) { return !refutes_planar(read, found.planar, beside.camera); });
  found.taken = *std::min_element(refuting.begin(), refuting.end(), costs_less);
  prefer_other_view(beside, width, found);
  const double pole = found.taken.meaning.pole;
  found.is_above = pole > beside.high;
  found.beside_pole = found.is_above ? pole - beside.high : beside.low - pole;
  if (found.other_view) return found;
  for (const ReadDepth& other : candidates) {
    const bool is_other_length = found.taken.meaning.kind == DepthMeaning::planar &&
                                 other.meaning.kind == DepthMeaning::grey &&
                                 other.degrees < found.taken.degrees - least_gain_on_planar;
    const bool is_another = is_other_length || !are_of_a_kind(other.meaning, found.taken.meaning);
    if (!is_another || cost_of(other, beside) > clear_lead * cost_of(found.taken, beside)) continue;
    if (!found.as_good_as || costs_less(other, *found.as_good_as)) found.as_good_as = other;
  }
  return found;
}

}  // namespace

DepthValues values_of(const DepthRows& depth) {
  return {[&depth](int x, int y) { return depth.row(y)[x]; }, depth.width, depth.height};
}

std::optional<MeaningByNormals> meaning_by_normals(const DepthValues& depth, float sign, const Background& background,
                                                   const Window& window, const Camera& camera,
                                                   const NormalsBeside& normals) {
  if (camera.orthographic || camera.slits) return {};
  std::optional<MeaningByNormals> best;
  for (const int reach : reaches_of_gradient) {
    std::vector<double> values;
    Beside beside{gradients_of(depth, sign, background, window, camera, normals.samples, reach, values), camera,
                  normals.stated};
    if (beside.samples.size() < fewest_samples || are_alike(beside.samples)) continue;
    keep_the_middle(std::move(values), beside);
    if (!(beside.high > beside.low) || beside.samples.size() < fewest_samples) continue;
    const MeaningByNormals found = meaning_of(beside, window.width());
    if (!best || found.taken.degrees < best->taken.degrees) best = found;
    constexpr double good_enough = 1;  // larger distances see less of bent surfaces
    if (best->taken.degrees < good_enough) break;
  }
  if (!best || best->taken.degrees > largest_agreeing) return {};
  return best;
}

std::vector<TurnVote> votes_on_turns(const DepthValues& depth, DepthMeaning::Kind kind, const Window& window,
                                     const Camera& camera, const NormalsBeside& normals) {
  if (camera.orthographic || camera.slits) return {};
  std::vector<TurnVote> votes;
  std::vector<GradientSample> samples;
  for (const NormalSamples::Sample& sample : normals.samples.all())
    for (const int reach : {4, 1, 12}) {  // steps hide slopes from the smallest, and small surfaces have no other
      const auto gradient = gradient_beside_normal(depth, 1, background_of({}, {}), window, camera, sample, reach);
      if (!gradient) continue;
      votes.push_back({sample.x, sample.y, {}}), samples.push_back(*gradient);
      break;
    }
  if (samples.size() < fewest_samples || are_alike(samples)) return {};
  const auto from_depth = [&](const GradientSample& sample, int turns) {
    return normal_by(sample, {kind, -range_of_16_bits * turns}, camera);
  };
  // The convention of the normals: by values that have not wrapped, then by what that says of each.
  double sum = 0;
  for (int round = 0; round < 2; ++round) {
    std::vector<NormalPair> pairs;
    for (size_t i = 0; i < samples.size(); ++i) {
      const auto& degrees = votes[i].degrees;
      const int turns = int(std::min_element(degrees.begin(), degrees.end()) - degrees.begin());
      pairs.push_back({samples[i].normal, from_depth(samples[i], turns)});
    }
    const std::optional<NormalForm> form = best_agreeing_form(pairs, camera.pose, normals.stated);
    if (!form) return {};
    sum = 0;
    for (size_t i = 0; i < samples.size(); ++i) {
      const dvec3 normal = view_normal(samples[i].normal, *form, camera.pose);
      for (int turns = 0; turns <= most_turns; ++turns) {
        const double apart = glm::degrees(glm::length(normal - from_depth(samples[i], turns)));
        votes[i].degrees[size_t(turns)] = std::min(most_degrees, apart);
      }
      sum += *std::min_element(votes[i].degrees.begin(), votes[i].degrees.end());
    }
  }
  return sum <= largest_agreeing * double(samples.size()) ? votes : std::vector<TurnVote>();
}

}  // namespace gloam
