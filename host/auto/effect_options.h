// The ways to compute an effect, from which a budget chooses: presets, resolutions, and techniques that complete it.
#pragma once

#include <string>
#include <vector>

#include "auto/automatic.h"
#include "planner/picture_model.h"
#include "planner/plan_option.h"

namespace gloam {

/// Its request is for all pixels.
struct EffectOption : PlanOption {
  std::vector<std::string> makes;  ///< planes that the picture takes

  /// What is expected of each of these planes on the frame that was looked at.
  std::vector<UsedPlane> planes_on(const SeenChanges& seen) const;
};

/// What the look has computed of an effect, on every `step`-th pixel.
struct SeenEffect {
  const Technique* technique = nullptr;
  std::string preset;
  std::vector<std::string> planes;
  int step = 1;
};

/// All options of an effect that the frame calls for. `technique`: what runs for it, which may refine the effect's. A preset or a
/// resolution that was asked for stands. Options whose plan the frame does not allow are left out. What `seen` has computed is to be
/// filled in from there.
std::vector<EffectOption> options_of(const Technique& technique, const EffectProbe& probe, const SeenEffect& seen);

}  // namespace gloam
