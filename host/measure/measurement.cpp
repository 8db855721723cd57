#include "measure/measurement.h"

#include <algorithm>

#include "base/lists.h"
#include "measure/timed_session.h"

namespace gloam::bench {

std::vector<std::string> presets_of(const Technique& technique, const MeasureOptions& options) {
  std::vector<std::string> names;
  for (const Preset& preset : source_of(technique).presets) {
    if (options.presets.empty() || contains(options.presets, preset.name)) names.push_back(preset.name);
  }
  if (source_of(technique).presets.empty() && options.presets.empty()) names.push_back("");
  return names;
}

bool in_short(const Technique& technique, const MeasureOptions& options) {
  return !options.layers_in_full && reads_layers(technique);
}

std::vector<Variation> variations_of(const Technique& technique, double radius, const MeasureOptions& options) {
  const std::vector<std::string> presets = presets_of(technique, options);
  std::vector<Variation> all;
  if (in_short(technique, options) && !presets.empty()) return {{&technique, base_preset(presets), radius}};
  for (const std::string& preset : presets) all.push_back({&technique, preset, radius});
  if (presets.empty()) return all;
  const Variation base{&technique, base_preset(presets), radius};
  for (const std::string& name : options.variants) all.push_back(with_variant(base, name));
  for (Variation& each : swept(base, options.sweeps)) all.push_back(std::move(each));
  return all;
}

MeasureOptions for_effect(const MeasureOptions& options, const std::string& plane) {
  MeasureOptions of_effect = options;
  const auto is_of_another = [&](const Technique* t) { return measured_plane(*t) != plane; };
  std::erase_if(of_effect.techniques, is_of_another);
  std::erase_if(of_effect.growth, is_of_another);
  if (plane != "ao") of_effect.checks = false;
  return of_effect;
}

void measure(Subject& subject, const MeasureOptions& options, bool is_first, Device& device, Measurement& result) {
  TimedSession session(subject, options, device, result);
  if (options.limit.is_set()) {
    session.measure_within(options.limit, is_first);
  } else {
    session.measure_all();
    if (is_first) session.measure_growth(options.growth);
    if (options.checks) session.measure_scales();
    if (options.checks && is_first) session.measure_planes();
  }
  session.add_scene();
}

}  // namespace gloam::bench
