#include "measure/growth.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "gloam/planes.h"
#include "measure/measures.h"
#include "measure/plans.h"
#include "measure/timing.h"

namespace gloam::bench {
namespace {

constexpr double factors[] = {0.25, 0.5, 1, 2, 4};

/// One point of a curve, before it is measured.
struct Case {
  double x;
  Plan plan;
  std::shared_ptr<const Frame> frame;
};

Channel resampled(const Channel& channel, int width, int height, float outside) {
  const Layout from = channel.layout();
  Channel out(Layout(width, height), outside);
  for (int y = 0; y < height; ++y) {
    const int source_y = int((2LL * y + 1) * from.height / (2LL * height));
    for (int x = 0; x < width; ++x)
      out.at(x, y) = channel.at(int((2LL * x + 1) * from.width / (2LL * width)), source_y);
  }
  return out;
}

View copy_of(const View& view) {
  View copy{.name = view.name, .camera = view.camera, .origin = view.origin, .light = view.light, .planes = {}};
  for (const auto& [name, plane] : view.planes) copy.planes.emplace(name, plane.clone());
  return copy;
}

Frame without_views(const Frame& frame) {
  Frame copy;
  copy.display = frame.display;
  copy.window = frame.window;
  return copy;
}

std::shared_ptr<const Frame> share(Frame frame) { return std::make_shared<const Frame>(std::move(frame)); }

/// A pointer without ownership: the caller's frame outlives the cases.
std::shared_ptr<const Frame> same(const Frame& frame) { return {std::shared_ptr<const Frame>(), &frame}; }

Growth measured(const std::string& over, std::vector<Case> cases, Device& device, int rounds) {
  Growth growth{.over = over};
  if (cases.size() < 2) return growth;
  std::vector<std::unique_ptr<TimedPlan>> plans;
  std::vector<Contender> contenders;
  for (Case& c : cases) {
    plans.push_back(std::make_unique<TimedPlan>(std::move(c.plan), *c.frame, device));
    contenders.push_back({over, [plan = plans.back().get()] { return plan->run(); }});
  }
  const std::vector<Series> ms = interleaved(contenders, rounds);
  for (size_t i = 0; i < cases.size(); ++i) growth.points.push_back({cases[i].x, median(ms[i])});
  return growth;
}

std::vector<Case> over_pixels(const Plan& plan, const Frame& frame) {
  std::vector<Case> cases;
  for (const double factor : factors) {
    const int width = std::max(1, int(std::lround(frame.width() * std::sqrt(factor))));
    const int height = std::max(1, int(std::lround(frame.height() * std::sqrt(factor))));
    cases.push_back({double(width) * height, plan, share(resized(frame, width, height))});
  }
  return cases;
}

/// Samples per pixel; if a technique does not state them, the product of the whole numbers that its presets set.
double samples_of(const Technique& technique, const ParameterValues& values) {
  if (technique.samples) return technique.samples(values);
  std::vector<std::string> counts;
  for (const Preset& preset : technique.presets) {
    for (const auto& [name, value] : preset.settings) {
      const bool counted = std::find(counts.begin(), counts.end(), name) != counts.end();
      const auto is_count = [&, &wanted = name](const Parameter& p) {
        return p.name == wanted && p.type == Parameter::Type::integer;
      };
      if (!counted && std::any_of(technique.parameters.begin(), technique.parameters.end(), is_count))
        counts.push_back(name);
    }
  }
  double product = counts.empty() ? 0 : 1;
  for (const std::string& name : counts) product *= values.number(name);
  return product;
}

std::vector<Case> over_samples(const Technique& technique, const Frame& frame, double radius) {
  std::vector<Case> cases;
  for (const Preset& preset : technique.presets) {
    Plan plan = unfiltered_plan({&technique, preset.name, radius}, planes_of(frame), "the frame");
    const double samples = samples_of(technique, *values_of(plan, technique.name));
    if (samples > 0) cases.push_back({samples, std::move(plan), same(frame)});
  }
  return cases;
}

std::vector<Case> over_radius(const Technique& technique, const Frame& frame, double radius) {
  std::vector<Case> cases;
  const double pixels = median_reach(frame, radius);
  if (!ParameterValues(technique.parameters).has("radius") || !(pixels > 0) || !std::isfinite(pixels)) return cases;
  for (const double factor : factors) {
    Plan plan = unfiltered_plan({&technique, "", radius * factor}, planes_of(frame), "the frame");
    cases.push_back({pixels * factor, std::move(plan), same(frame)});
  }
  return cases;
}

std::vector<Case> over_layers(const Technique& technique, const Plan& plan, const Frame& frame, double radius) {
  std::vector<Case> cases;
  const auto peeled = plan.stacks.find("peel");
  if (peeled == plan.stacks.end()) return cases;
  for (size_t layers = 1; layers <= peeled->second.size(); layers *= 2) {
    auto part = share(with_layers(frame, int(layers)));
    cases.push_back({double(layers), unfiltered_plan({&technique, "", radius}, planes_of(*part), "the frame"), part});
  }
  return cases;
}

std::vector<Case> over_views(const Technique& technique, const Plan& plan, const Frame& frame) {
  std::vector<Case> cases;
  if (technique.views > 1) return cases;  // it takes exactly that many
  for (const int views : {1, 2, 4}) cases.push_back({double(views), plan, share(with_views(frame, views))});
  return cases;
}

}  // namespace

std::optional<double> exponent(const std::vector<GrowthPoint>& points) {
  double sum_x = 0, sum_y = 0, n = double(points.size());
  for (const GrowthPoint& p : points) {
    if (!(p.x > 0) || !(p.ms > 0)) return {};
    sum_x += std::log(p.x);
    sum_y += std::log(p.ms);
  }
  double spread = 0, slope = 0;
  for (const GrowthPoint& p : points) {
    const double x = std::log(p.x) - sum_x / n;
    spread += x * x;
    slope += x * (std::log(p.ms) - sum_y / n);
  }
  if (points.size() < 2 || spread < 1e-12) return {};
  return slope / spread;
}

Frame resized(const Frame& frame, int width, int height) {
  const double sx = double(width) / frame.width(), sy = double(height) / frame.height();
  Frame out;
  out.display = out.window = {0, 0, width, height};
  for (const View& view : frame.views) {
    View& copy = out.views.emplace_back(
        View{.name = view.name, .camera = view.camera, .origin = view.origin, .light = view.light});
    if (Camera* camera = copy.camera ? &*copy.camera : nullptr) {
      camera->fx *= sx;
      camera->fy *= sy;
      camera->cx = (camera->cx - frame.window.x0) * sx;
      camera->cy = (camera->cy - frame.window.y0) * sy;
    }
    for (const auto& [name, plane] : view.planes) {
      Plane& target = copy.planes.emplace(name, Plane{name, {}}).first->second;
      for (const Channel& channel : plane.channels)
        target.channels.push_back(resampled(channel, width, height, plane_kind(name).outside));
    }
  }
  return out;
}

Frame with_views(const Frame& frame, int views) {
  Frame out = without_views(frame);
  for (int i = 0; i < views; ++i) {
    out.views.push_back(copy_of(frame.views.front()));
    out.views.back().name = std::to_string(i);
  }
  return out;
}

Frame with_layers(const Frame& frame, int layers) {
  Frame out = without_views(frame);
  for (const View& view : frame.views) {
    View& copy = out.views.emplace_back(
        View{.name = view.name, .camera = view.camera, .origin = view.origin, .light = view.light});
    for (const auto& [name, plane] : view.planes) {
      const std::optional<StackLayer> layer = stack_layer(name);
      if (!layer || layer->stack != "peel" || layer->number < layers) copy.planes.emplace(name, plane.clone());
    }
  }
  return out;
}

std::vector<Growth> measure_growth(const Technique& technique, const Frame& frame, Device& device,
                                   const GrowthOptions& options) {
  const Plan plan = unfiltered_plan({&technique, "", options.radius}, planes_of(frame), "the frame");
  std::vector<Growth> all;
  const auto add = [&](const std::string& over, std::vector<Case> cases) {
    Growth growth = measured(over, std::move(cases), device, options.rounds);
    const std::optional<double> power = exponent(growth.points);
    if (!power) return;
    growth.technique = technique.name;
    growth.exponent = *power;
    all.push_back(std::move(growth));
  };
  add("pixels", over_pixels(plan, frame));
  add("samples", over_samples(technique, frame, options.radius));
  add("radius", over_radius(technique, frame, options.radius));
  add("layers", over_layers(technique, plan, frame, options.radius));
  add("views", over_views(technique, plan, frame));
  return all;
}

}  // namespace gloam::bench
