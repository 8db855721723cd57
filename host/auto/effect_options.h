// The ways to compute an effect, from which a budget chooses: presets, resolutions, and techniques that complete it.
#pragma once

#include <string>
#include <vector>

#include "auto/automatic.h"
#include "planner/plan_option.h"

namespace gloam {

/// Its request is for all pixels.
struct EffectOption : PlanOption {
  std::vector<std::string> makes;  ///< planes that the picture takes
  /// RMS error of the picture by this option as a share of the error of a picture without the effect (data/effect_errors.json).
  double relative_error = 1;
};

/// How much more an effect changes the true picture than a glance sees: light also comes from what the image does not show
/// (data/effect_errors.json).
double true_per_seen_change(const Technique& technique);

/// All options of an effect that the frame calls for. `technique`: what runs for it, which may refine the effect's. A preset or a
/// resolution that was asked for stands. Options whose plan the frame does not allow are left out.
std::vector<EffectOption> options_of(const Technique& technique, const EffectProbe& probe);

}  // namespace gloam
