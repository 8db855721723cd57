#include "measure/effects.h"

#include <algorithm>
#include <stdexcept>

#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/plan.h"
#include "gloam/planes.h"
#include "scene/reference_kinds.h"
#include "technique/default_technique.h"

namespace gloam::bench {
namespace {

/// A confidence beside red, green and blue is no error.
constexpr size_t most_components = 3;

bool is_of_scene(const std::string& plane) try {
  ReferenceRequest request;
  request.what = plane;
  job_of(request, as_flag);
  return true;
} catch (const UsageError&) {
  return false;
}

std::vector<MeasuredEffect> found_effects() {
  std::vector<MeasuredEffect> effects;
  for (const ReferenceKind& kind : reference_kinds()) {
    const PlaneKind plane = plane_kind(kind.name);
    const bool is_made = std::any_of(registry().begin(), registry().end(),
                                     [&](const Technique& t) { return contains(outputs_of(t), kind.name); });
    if (!is_made || plane.components.size() > most_components) continue;
    // Where nothing is, nothing shades and nothing shines.
    effects.push_back({kind.name, plane.outside > 0 ? "white" : "black", plane.outside, is_of_scene(kind.name)});
  }
  return effects;
}

}  // namespace

const std::vector<MeasuredEffect>& measured_effects() {
  static const std::vector<MeasuredEffect> effects = found_effects();
  return effects;
}

std::vector<std::string> effect_names() {
  std::vector<std::string> names;
  for (const MeasuredEffect& effect : measured_effects()) names.push_back(effect.plane);
  return names;
}

const MeasuredEffect& effect_of(const std::string& plane) {
  for (const MeasuredEffect& effect : measured_effects()) {
    if (effect.plane == plane) return effect;
  }
  throw std::out_of_range(plane);
}

std::string measured_plane(const Technique& technique) {
  for (const MeasuredEffect& effect : measured_effects()) {
    if (contains(outputs_of(technique), effect.plane)) return effect.plane;
  }
  return "";
}

const Technique& source_of(const Technique& technique) {
  if (!technique.presets.empty()) return technique;
  for (const std::string& plane : technique.reads) {
    const std::string maker = technique_for(plane);
    if (maker != plane && !find_technique(maker).presets.empty()) return find_technique(maker);
  }
  return technique;
}

Settings converged_settings(const Technique& technique) {
  const Technique& source = source_of(technique);
  Settings settings = source.converged;
  if (&source == &technique) return settings;
  for (auto& [name, value] : settings) {
    if (name.find('.') == std::string::npos) name = source.name + "." + name;
  }
  return settings;
}

}  // namespace gloam::bench
