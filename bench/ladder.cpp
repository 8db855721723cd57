#include "ladder.h"

#include "gloam/error.h"
#include "gloam/run.h"

namespace gloam::bench {
namespace {

/// Plans of the same text compute the same.
std::string text_of(const Plan& plan) {
  std::string text = plan.outputs.front();
  for (const PlannedPass& planned : plan.passes) {
    text += " " + planned.label();
    for (const Parameter& p : planned.values.table()) text += " " + planned.values.text(p.name);
  }
  for (const std::string& input : plan.inputs) text += " " + input;
  return text;
}

/// As a step is meant to be: without rounding, as far as the device can; or as it is shipped.
RunOptions options_for(const Device& device, bool shipped) {
  RunOptions options;
  if (shipped) return options;
  options.math = Math::precise;
  options.real = device.info().has_double ? Real::float64 : Real::float32;
  return options;
}

Image take(Frame frame, const std::string& plane) {
  Image image;
  for (View& view : frame.views) image.push_back(std::move(view.planes.at(plane)));
  return image;
}

/// Depth, normals ... of a frame and one more plane, for a plan that reads no others.
Frame with_plane(const Frame& frame, const Plan& plan, const std::string& name, const Image& image) {
  Frame out;
  out.display = frame.display;
  out.window = frame.window;
  for (size_t i = 0; i < frame.views.size(); ++i) {
    const View& view = frame.views[i];
    View& copy = out.views.emplace_back(View{.name = view.name, .camera = view.camera, .origin = view.origin});
    for (const std::string& input : plan.inputs) {
      const Plane* plane = input == name ? &image[i] : view.find(input);
      if (plane) copy.planes.emplace(input, plane->clone());
    }
    copy.planes.at(name).name = name;
  }
  return out;
}

}  // namespace

Steps::Steps(const Frame& frame, const std::string& holds, Device& device, const Truth* truth, Truths* truths)
    : frame_(frame),
      holds_(holds),
      device_(device),
      truth_(truth),
      truths_(truths),
      foreground_(foreground(frame)),
      available_(planes_of(frame)) {}

const Image& Steps::image(const Plan& plan, bool shipped) {
  const std::string key = (shipped ? "shipped " : "") + text_of(plan);
  const auto known = images_.find(key);
  if (known != images_.end()) return known->second;
  RunResult result = run(plan, frame_, device_, options_for(device_, shipped));
  return images_.emplace(key, take(std::move(result.frame), plan.outputs.front())).first->second;
}

const Image* Steps::own_truth(const Technique& technique, const ParameterValues& values) {
  if (!technique.contribution) return truth_ ? &truth_->ao : nullptr;
  return truths_ ? &truths_->truth(frame_, technique, values).ao : nullptr;
}

/// The filter by itself. Where it reads what an earlier technique makes (normals from depth) the frame does not have
/// that, and it is computed first.
Image Steps::filtered(const Plan& filter, const std::string& plane, const Image& raw) {
  Frame frame = with_plane(frame_, filter, plane, raw);
  for (const std::string& input : filter.inputs) {
    if (frame.views.front().find(input)) continue;
    const Image& made = image(make_plan({.outputs = {input}}, available_, holds_), false);
    for (size_t i = 0; i < frame.views.size(); ++i) frame.views[i].planes.emplace(input, made[i].clone());
  }
  return take(run(filter, frame, device_, options_for(device_, false)).frame, filter.outputs.front());
}

Ladder Steps::climb(const Variation& variation) {
  const Technique& technique = *variation.technique;
  const Plan whole = whole_plan(variation, available_, holds_);
  const ParameterValues& values = *values_of(whole, technique.name);
  const Image* truth = truth_ ? &truth_->ao : nullptr;
  const Image* own = own_truth(technique, values);
  const auto distance = [&](const Image* a, const Image* b) -> std::optional<double> {
    if (!a || !b) return {};
    return rmse(*a, *b, foreground_);
  };

  Ladder ladder;
  if (technique.contribution) ladder.t0w = distance(own, truth);
  const Image *all_layers = nullptr, *converged = nullptr;
  if (!technique.converged.empty()) {
    converged = &image(unfiltered_plan(variation, available_, holds_, technique.converged), false);
    const Technique* over_layers = over_all_layers(technique);
    try {
      if (over_layers)
        all_layers = &image(unfiltered_plan({over_layers, variation.preset, variation.radius}, available_, holds_,
                                            over_layers->converged),
                            false);
    } catch (const MissingPlanes&) {  // a frame without peeled layers
    }
  }
  ladder.t1 = distance(all_layers, own);
  ladder.t2 = distance(converged, all_layers);
  const Image& sampled = image(unfiltered_plan(variation, available_, holds_), false);
  ladder.t3 = distance(&sampled, converged);

  const Image& precise = image(whole, false);
  const Plan filter = filter_of(whole, technique);
  if (converged && !filter.passes.empty()) {
    const Image smooth = filtered(filter, own_plane(technique), *converged);
    ladder.t4_bias = distance(&smooth, converged);
    ladder.t4_noise = distance(&precise, &smooth);
  }
  const Image& shipped = image(whole, true);
  ladder.t5 = distance(&shipped, &precise);
  ladder.truth = distance(&shipped, truth);
  return ladder;
}

}  // namespace gloam::bench
