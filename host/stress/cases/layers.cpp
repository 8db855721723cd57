// Hard case 20: stochastic depth with any number of samples and layers.
#include <algorithm>
#include <cmath>

#include "gloam/normalise.h"
#include "gloam/planes.h"
#include "stress/case.h"
#include "stress/frames.h"

namespace gloam::stress {
namespace {

/// The planned technique that draws surfaces at random: the one with a parameter `alpha`; null if none does.
const Technique* chooser(const Plan& plan) {
  for (const PlannedPass& planned : plan.passes) {
    for (const Parameter& p : planned.technique->parameters) {
      if (p.name == "alpha") return planned.technique;
    }
  }
  return nullptr;
}

/// A frame with `count` surfaces under each pixel, the first of them the visible one; 0: no layer at all, although there is a
/// depth.
Frame with_layers(const Technique& technique, int count) {
  Frame frame = shoot(perspective(80, 60), room());
  const Channel& depth = frame.views[0].find("depth")->channels[0];
  for (int k = 0; k < std::max(count, 1); ++k) {
    Channel& layer = plane_of(frame, layer_name("peel", k)).channels[0];
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x)
        layer.at(x, y) = count == 0 ? INFINITY : depth.at(x, y) * (1 + 0.02f * float(k));
    }
  }
  normalise(frame);
  plan_for(technique, frame);
  return frame;
}

/// A way to choose surfaces.
struct LayerChoice {
  std::string surfaces, subset, alpha;
};

std::string choice_in_words(const LayerChoice& choice) {
  return fmt::format("surfaces {}, {}, alpha {}", choice.surfaces, choice.subset, choice.alpha);
}

const LayerChoice takes_the_nearest = {"all", "stratified", "1"};

/// Settings by which `samples` depths are drawn, and as many are read.
Settings settings_of(const Technique& technique, Frame& frame, const std::string& samples, const LayerChoice& choice) {
  Settings settings = few_samples(technique);
  for (const PlannedPass& planned : plan_for(technique, frame).passes) {
    const Technique& t = *planned.technique;
    const bool draws = planned.values.has("alpha");
    const bool reads = std::find(t.reads.begin(), t.reads.end(), "stochastic") != t.reads.end();
    if (draws || reads) settings.emplace_back(t.name + ".samples", samples);
    if (!draws) continue;
    settings.emplace_back(t.name + ".surfaces", choice.surfaces);
    settings.emplace_back(t.name + ".subset", choice.subset);
    settings.emplace_back(t.name + ".alpha", choice.alpha);
  }
  return settings;
}

/// Whether the technique draws surfaces at random; notes why not.
bool chooses(Probe& probe) {
  Frame frame = shoot(perspective(8, 8), room());
  plane_of(frame, "peel.00");
  if (chooser(plan_for(probe.technique(), frame))) return true;
  probe.passes_over("chooses no surfaces at random");
  return false;
}

std::vector<std::string> sample_counts(const Probe& probe) {
  // Not the default, which all other cases have.
  return probe.is_quick() ? std::vector<std::string>{"1"} : std::vector<std::string>{"1", "2", "4", "8", "16"};
}

/// The stochastic depths to expect with alpha 1: all of them are the depth itself.
Frame with_depth_for_stochastic_ones(const Technique& technique, const std::string& samples) {
  Frame frame = with_layers(technique, 1);
  const Channel& depth = frame.views[0].find("depth")->channels[0];
  for (View& view : frame.views) {
    for (int k = 0; k < std::stoi(samples); ++k) {
      Channel& layer = plane_of(view, depth.layout(), layer_name("stochastic", k)).channels[0];
      for (int y = 0; y < frame.height(); ++y)
        std::copy_n(view.find("depth")->channels[0].row(y), frame.width(), layer.row(y));
    }
  }
  normalise(frame);
  return frame;
}

Frame only_stochastic(const Frame& frame) {
  Frame copy = clone(frame);
  for (View& view : copy.views)
    std::erase_if(view.planes, [](const auto& plane) {
      const auto layer = stack_layer(plane.first);
      return !layer || layer->stack != "stochastic";
    });
  return copy;
}

/// With alpha 1 every sample is offered every surface and keeps the nearest: hidden layers change nothing.
void all_samples_take_the_nearest(Probe& probe) {
  if (!chooses(probe)) return;
  for (const std::string& samples : sample_counts(probe)) {
    for (const RunOptions& way : probe.ways_of_rare_settings()) {
      if (!probe.tries(
              fmt::format("alpha 1, {} samples, 64 layers against the depth alone, {}", samples, text_of(way))))
        continue;
      Frame deep = with_layers(probe.technique(), 64);
      Frame flat = with_depth_for_stochastic_ones(probe.technique(), samples);
      const Settings settings = settings_of(probe.technique(), deep, samples, takes_the_nearest);
      const Frame out = probe.outputs(deep, settings, way);
      if (chooser(plan_for(probe.technique(), deep)) == &probe.technique())
        probe.measure_bits("alpha 1: difference to the ordinary depth", out, only_stochastic(flat));
      else
        probe.measure_bits("alpha 1: difference to the ordinary depth", out,
                           probe.outputs(flat, settings_of(probe.technique(), flat, samples, takes_the_nearest), way));
    }
  }
}

void any_layers_and_samples(Probe& probe) {
  if (!chooses(probe)) return;
  for (const std::string& samples : sample_counts(probe)) {
    for (const LayerChoice& choice : std::initializer_list<LayerChoice>{{"all", "stratified", "0"},
                                                                        {"all", "stratified", "0.2"},
                                                                        {"all", "stratified", "1"},
                                                                        {"hidden", "hashed", "0.25"},
                                                                        {"hidden", "nearest", "0"},
                                                                        {"relevant", "nearest", "0"}}) {
      if (choice.surfaces == "relevant" && makes_first_view_only(probe.technique())) {
        // Planning refuses it (plan/relevant_map.h).
        probe.passes_over("looks for another view, which a map of relevant surfaces does not serve");
        continue;
      }
      for (const int layers : {0, 1, 3, 64}) {
        for (const RunOptions& way : probe.ways_of_rare_settings()) {
          if (!probe.tries(
                  fmt::format("{}, {} samples, {} layers, {}", choice_in_words(choice), samples, layers, text_of(way))))
            continue;
          Frame frame = with_layers(probe.technique(), layers);
          probe.measure_violation("value out of its range",
                                  probe.outputs(frame, settings_of(probe.technique(), frame, samples, choice), way));
        }
      }
    }
  }
}

/// Sample j holds surface i of those offered, counted from 0, with probability alpha (1 - alpha)^i (Vermeer 2021, section 3.1). Where
/// only hidden surfaces are offered, it never holds the depth itself.
void shares_of_layers(Probe& probe) {
  if (!chooses(probe)) return;
  Frame probing = with_layers(probe.technique(), 3);
  const Plan plan = plan_for(probe.technique(), probing);
  if (chooser(plan) != &probe.technique()) return;
  constexpr int layers = 8, seeds = 16;
  for (const std::string& samples : sample_counts(probe)) {
    for (const auto& [surfaces, alpha] : std::initializer_list<std::pair<const char*, double>>{
             {"all", 0.0}, {"all", 0.1}, {"all", 0.2}, {"all", 0.5}, {"all", 1.0}, {"hidden", 0.25}, {"hidden", 1.0}}) {
      const LayerChoice choice = {surfaces, "stratified", exact(alpha)};
      if (!probe.tries(fmt::format("{}, {} samples, shares of {} layers", choice_in_words(choice), samples, layers)))
        continue;
      Frame frame = with_layers(probe.technique(), layers);
      std::vector<double> shares(layers);
      double count = 0;
      for (int seed = 0; seed < seeds; ++seed) {
        const Frame out = probe.outputs(frame, settings_of(probe.technique(), frame, samples, choice), {.seed = seed});
        for (const auto& [name, plane] : out.views[0].planes) {
          if (!stack_layer(name)) continue;
          for (int y = 0; y < frame.height(); ++y) {
            for (int x = 0; x < frame.width(); ++x) {
              const float depth = frame.views[0].find("depth")->channels[0].at(x, y), held = plane.channels[0].at(x, y);
              if (is_background(depth)) continue;
              ++count;
              if (!is_background(held)) shares.at(size_t(std::lround((held / depth - 1) / 0.02f))) += 1;
            }
          }
        }
      }
      const int first = choice.surfaces == "hidden" ? 1 : 0;
      double worst = first == 0 ? 0 : shares[0];
      for (int i = first; i < layers; ++i)
        worst = std::max(worst, std::abs(shares[size_t(i)] / count - alpha * std::pow(1 - alpha, i - first)));
      // Independent draws would scatter by sqrt(0.25 / 70 000) = 0.002 for one sample, and less for more.
      probe.measure("share of samples that hold a layer: distance from alpha (1 - alpha)^i", worst, 8e-3);
    }
  }
}

}  // namespace

namespace case_files {

std::vector<Case> layers() {
  return {{20,
           "stochastic depth of every kind",
           "1 to 16 samples, all surfaces or hidden ones, alpha 0 to 1, one layer or 64 give values in their range; "
           "with alpha 1 and all surfaces hidden layers change no bit; layers are chosen as often as the formula says, "
           "hidden ones alone where only these are offered.",
           {all_samples_take_the_nearest, any_layers_and_samples, shares_of_layers}}};
}

}  // namespace case_files
}  // namespace gloam::stress
