// A budget: effects, presets and resolutions for a time or an error of the whole picture.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "auto/automatic.h"
#include "auto/choice.h"
#include "auto/effect_options.h"
#include "auto/glance.h"
#include "planner/speeds.h"

namespace gloam {

/// An effect that the frame calls for: its options, and after `spend` what was chosen and computed.
struct BudgetedEffect {
  const Technique* technique = nullptr;  ///< of the effect
  std::string mask, elsewhere;           ///< as the decision for the effect has them; empty: none
  std::vector<EffectOption> options;
  std::vector<double> expected_ms;  ///< of each option, as the table of the device has it for this frame's size

  int chosen = left_out;
  bool is_masked = false;  ///< the mask was faster
  double ms = 0;           ///< as measured on this frame, the median of three runs
  RunResult result;
  Plan plan;
  /// RMS difference between the picture by the choice for this effect and by its best option, as expected: `change` if it is left out.
  double lost = 0;
  double change = 0;  ///< RMS change of the picture by the effect, as expected of its best option
};

/// What spending a budget needs besides the effects.
struct BudgetMeans {
  const Frame& frame;
  const std::vector<std::string>& available;
  const std::string& holds;
  Device& device;
  const RunOptions& options;
  const Glance& glance;
  double looking_ms = 0;                                 ///< device time of looking that counts
  bool always_masked = false;                            ///< a mask is used where there is one, even if it is slower
  std::function<void(int done, int of)> measuring = {};  ///< progress of the first measurement on a device
};

/// Chooses by the device's table of speeds, computes, measures, and chooses again by what was measured, until the choice stays. Options
/// that the table lacks are measured on the glance's pixels first, once on a device.
Spent spend(std::vector<BudgetedEffect>& effects, const Goal& goal, const BudgetMeans& means, OptionSpeeds& speeds);

}  // namespace gloam
