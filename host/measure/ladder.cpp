#include "measure/ladder.h"

#include "gloam/error.h"
#include "gloam/run.h"
#include "measure/effects.h"
#include "measure/storage.h"

namespace gloam::bench {
namespace {

/// A text of a plan: plans with the same text compute the same.
std::string text_of(const Plan& plan) {
  std::string text = plan.outputs.front();
  for (const PlannedPass& planned : plan.passes) {
    text += " " + planned.label();
    for (const Parameter& p : planned.values.table()) text += " " + planned.values.text(p.name);
  }
  for (const std::string& input : plan.inputs) text += " " + input;
  return text;
}

/// Whether a technique computes something other than the truth by choice. Its contribution is to ambient occlusion.
bool has_own_truth(const Technique& technique) { return technique.contribution && measured_plane(technique) == "ao"; }

/// Options with as little rounding as the device allows.
RunOptions without_rounding(const Device& device) {
  RunOptions options;
  options.math = Math::precise;
  options.real = device.info().has_double ? Real::float64 : Real::float32;
  return options;
}

/// Options for thousands of samples: float and fast are within RMSE 1.5e-4 of double and precise (docs/benchmarking.md), which
/// take five times as long.
RunOptions for_converged() { return {}; }

/// The image, with depth, normals ... of its views, for a plan that reads no other planes.
Frame with_plane(const Frame& frame, const Plan& plan, const std::string& name, const Image& image) {
  Frame out;
  out.display = frame.display;
  out.window = frame.window;
  for (const View& view : frame.views) {
    const auto own = image.find(view.name);
    if (own == image.end()) continue;
    View& copy = out.views.emplace_back(
        View{.name = view.name, .camera = view.camera, .origin = view.origin, .light = view.light});
    for (const std::string& input : plan.inputs) {
      const Plane* plane = input == name ? &own->second : view.find(input);
      if (plane) copy.planes.emplace(input, plane->clone());
    }
    copy.planes.at(name).name = name;
  }
  return out;
}

}  // namespace

Steps::Steps(const Frame& frame, const std::string& holds, Device& device, const Truth* truth, Truths* truths,
             Foreground foreground)
    : frame_(frame),
      holds_(holds),
      device_(device),
      truth_(truth),
      truths_(truths),
      foreground_(std::move(foreground)),
      available_(planes_of(frame)) {}

Image Steps::computed(const Plan& plan, const RunOptions& options) {
  return image_of(run(plan, frame_, device_, options).frame, plan.outputs.front());
}

const Image& Steps::shared(const Plan& plan, const RunOptions& options) {
  const std::string key = (options.real == Real::float64 ? "double " : "") + text_of(plan);
  const auto known = images_.find(key);
  if (known != images_.end()) return known->second;
  return images_.emplace(key, computed(plan, options)).first->second;
}

const Image* Steps::own_truth(const Technique& technique, const ParameterValues& values) {
  if (!has_own_truth(technique)) return truth_ ? &truth_->image : nullptr;
  return truths_ ? &truths_->truth(frame_, technique, values).image : nullptr;
}

/// Null if the technique has no converged settings, or the frame has no layers.
const Image* Steps::converged(const Technique& technique, const Variation& variation) {
  const Settings settings = converged_settings(technique);
  if (settings.empty()) return nullptr;
  Variation full = variation;
  full.technique = &technique;
  full.settings = settings_over_other_layers(variation.settings, *variation.technique, technique);
  full.resolution = 1;
  try {
    return &shared(unfiltered_plan(full, available_, holds_, settings), for_converged());
  } catch (const MissingPlanes&) {
    return nullptr;
  }
}

/// The filter alone. If it reads a plane of an earlier technique that the frame lacks (normals from depth), that is computed first.
Image Steps::filtered(const Frame& frame, const Plan& filter, const std::string& plane, const Image& raw,
                      const RunOptions& options) {
  Frame read = with_plane(frame, filter, plane, raw);
  for (const std::string& input : filter.inputs) {
    if (read.views.front().find(input)) continue;
    const Image& made = shared(make_plan({.outputs = {input}}, available_, holds_), without_rounding(device_));
    for (View& view : read.views) view.planes.emplace(input, made.at(view.name).clone());
  }
  return image_of(run(filter, read, device_, options).frame, filter.outputs.front());
}

/// Rounds to half at input, between estimate and filter, and at the end.
Image Steps::kept_in_half(const Variation& variation, const Plan& whole) {
  if (!frame_in_half_) frame_in_half_ = stored_in_half(frame_);
  const RunOptions options = variation.run_options();
  const Plan estimate = unfiltered_plan(variation, available_, holds_), filter = filter_of(whole, *variation.technique);
  Image image = image_of(run(estimate, *frame_in_half_, device_, options).frame, estimate.outputs.front());
  for (auto& [view, plane] : image) store_in_half(plane);
  if (filter.passes.empty()) return image;
  image = filtered(*frame_in_half_, filter, own_plane(*variation.technique), image, options);
  for (auto& [view, plane] : image) store_in_half(plane);
  return image;
}

Image Steps::shipped(const Variation& variation) {
  const Plan whole = whole_plan(variation, available_, holds_);
  if (variation.storage == Storage::float16) return kept_in_half(variation, whole);
  return computed(whole, variation.run_options());
}

Errors Steps::errors(const Image& shipped) const {
  if (!truth_) return {};
  return {rmse(shipped, truth_->image, foreground_), bias(shipped, truth_->image, foreground_)};
}

Similarity Steps::similarity(const Image& shipped) const {
  return truth_ ? bench::similarity(shipped, truth_->image, foreground_) : Similarity();
}

Errors Steps::base_errors(const MeasuredEffect& effect) const {
  return truth_ ? errors(even_image(truth_->image, effect.base_value)) : Errors{};
}

Errors Steps::converged_errors(const Variation& variation) {
  const Image* image = truth_ ? converged(*variation.technique, variation) : nullptr;
  return image ? errors(*image) : Errors{};
}

Ladder Steps::climb(const Variation& variation, const Image& shipped) {
  const Technique& technique = *variation.technique;
  const RunOptions options = without_rounding(device_);
  const auto distance = [&](const Image* a, const Image* b) -> std::optional<double> {
    if (!a || !b) return {};
    return rmse(*a, *b, foreground_);
  };
  const Plan whole = whole_plan(variation, available_, holds_), filter = filter_of(whole, technique);
  const Image* own = own_truth(technique, *values_of(whole, technique.name));
  const Technique* over_layers = over_all_layers(technique);
  const Image* all_layers = over_layers ? converged(*over_layers, variation) : nullptr;
  const Image* given_layers = converged(technique, variation);

  Ladder ladder;
  if (has_own_truth(technique)) ladder.t0w = distance(own, truth_ ? &truth_->image : nullptr);
  ladder.t1 = distance(all_layers, own);
  ladder.t2 = distance(given_layers, all_layers);
  if (!over_layers) ladder.t12 = distance(given_layers, own);
  const Image sampled = computed(unfiltered_plan(variation, available_, holds_), options);
  ladder.t3 = distance(&sampled, given_layers);
  if (filter.passes.empty()) {
    ladder.t5 = distance(&shipped, &sampled);
  } else if (variation.resolution > 1) {
    const Image precise = computed(whole, options);
    ladder.t5 = distance(&shipped, &precise);
  } else {
    const std::string plane = own_plane(technique);
    const Image precise = filtered(frame_, filter, plane, sampled, options);
    ladder.t5 = distance(&shipped, &precise);
    if (given_layers) {
      const Image smooth = filtered(frame_, filter, plane, *given_layers, options);
      ladder.t4_bias = distance(&smooth, given_layers);
      ladder.t4_noise = distance(&precise, &smooth);
    }
  }
  return ladder;
}

}  // namespace gloam::bench
