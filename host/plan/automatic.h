// What a frame calls for: of all effects that techniques declare (`Technique::effect`), which ones, and where.
#pragma once

#include <string>
#include <vector>

#include "gloam/device.h"
#include "gloam/frame.h"
#include "gloam/plan.h"
#include "gloam/run.h"

namespace gloam {

/// What a frame is probed for effects with. The frame is normalised (gloam/normalise.h).
struct EffectProbe {
  const PlanRequest& asked;  ///< settings, preset, filter and resolution
  const Frame& frame;
  const std::vector<std::string>& available;  ///< planes of the frame
  const std::string& holds;                   ///< the same in words (plan.h)
  Device& device;
  const RunOptions& options;
};

/// Of one effect, or of what refines one.
struct EffectChoice {
  const Technique* technique = nullptr;
  bool is_wanted = false;
  bool is_everywhere = false;  ///< wanted on so much of the image that no mask is made
  std::string why;             ///< in words, with the share
  double share = 0;            ///< of the tiles that were probed, of all views
  double classify_ms = 0;      ///< what finding out took, on the device
  std::string cells;           ///< the plane of `seen`; empty where nothing was probed
  Frame seen;                  ///< of each view one pixel per tile: above 0 where it is called for
};

/// What is made of an effect.
struct Decision {
  EffectChoice effect;
  std::vector<EffectChoice>
      refinements;         ///< at most one of them is wanted, and runs in place of the effect's technique
  PlanRequest request;     ///< for what is called for
  PlanRequest everywhere;  ///< for the same without probing what the frame calls for
};

/// Techniques that declare an effect by itself.
std::vector<const Technique*> techniques_with_effects();

/// Of what is asked for, that which means something to an effect: a setting such as radius, a filter or an extra plane does so to
/// some. Throws as `make_plan`
/// does for a frame that lacks what the effect reads.
PlanRequest asked_of_effect(const Technique& technique, const PlanRequest& asked,
                            const std::vector<std::string>& available, const std::string& holds);

/// The plans that may run for an effect: its own with its mask, and those of what refines it, as far as the frame has what they
/// read. Together they read all that the effect and its probe take from a frame. Throws MissingPlanes, UsageError.
std::vector<Plan> plans_of_effect(const Technique& technique, const PlanRequest& asked,
                                  const std::vector<std::string>& available, const std::string& holds);

/// Probes a frame on the device (`Effect::probe`); where the probe finds nothing, by the mask itself. What refines an effect is
/// probed where the frame calls for that effect, and where it reads one view, since layers may call for what nothing seen
/// does. Throws what `make_plan` and `run` do.
Decision decide(const Technique& technique, const EffectProbe& probe);

/// Whether an effect is computed through its mask, where the decision has one, or everywhere: as said, or what takes less.
enum class MaskUse { measured, always, never };

/// What an effect's planes took.
struct Computed {
  RunResult result;
  bool is_masked = false;
  /// Milliseconds on the device of the whole plan, the least of some rounds in turn; NaN where it was not run.
  double ms = 0, ms_masked = 0, ms_everywhere = 0;
};

/// Runs what was decided, which has to be wanted. Where the mask's use is to be measured, both ways are run in turn, and the mask is
/// kept where it saves 5 % or more: what it leaves out is then open, where everywhere finds next to nothing. Otherwise the decision
/// becomes one for everywhere, and says so.
Computed compute(Decision& decision, const EffectProbe& probe, MaskUse use);

/// The cells of an effect's mask, as `EffectChoice::seen`, with all that the mask has to tell.
void probe_closely(EffectChoice& choice, const EffectProbe& probe);

}  // namespace gloam
