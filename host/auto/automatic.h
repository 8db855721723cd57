// Automatic choice: which of the effects that techniques declare (`Technique::effect`) a frame calls for, and where.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gloam/auto.h"

namespace gloam {

/// A mask as it was probed on a frame.
struct ProbedMask {
  std::string cells;                  ///< the plane of `seen`
  double share = 0;                   ///< share of its tiles that are above 0, over all views
  std::shared_ptr<const Frame> seen;  ///< one pixel per tile of each view
};

/// By what was asked for: effects with the same mask share its probe.
using ProbedMasks = std::map<std::string, ProbedMask>;

/// The means to probe a frame for effects. The frame is normalised (gloam/normalise.h).
struct EffectProbe {
  const PlanRequest& asked;  ///< settings, preset, filter and resolution
  const Frame& frame;
  const std::vector<std::string>& available;  ///< planes of the frame
  const std::string& holds;                   ///< the planes in words (plan.h)
  Device& device;
  const RunOptions& options;
  /// RMS change of the picture by the effect, as a share of the picture's RMS; none: not known.
  std::optional<double> change = {};
  /// Share of the image where a look has seen the effect; none: it was not looked at.
  std::optional<double> seen_share = {};
  ProbedMasks* masks = nullptr;  ///< of this frame, from other effects; null: none are kept
};

/// The request without settings that none of its passes has: those of resampling have a radius, which at full resolution nothing may
/// have. Throws as `make_plan` does.
PlanRequest with_known_settings(const Technique& technique, PlanRequest request,
                                const std::vector<std::string>& available, const std::string& holds);

/// Techniques that declare an effect of their own, in the order of the planes that a picture takes (`part_planes`).
std::vector<const Technique*> techniques_with_effects();

/// Techniques that can follow an effect's in its plan (`Effect::completes`).
std::vector<const Technique*> techniques_that_complete(const Technique& technique);

/// The request that computes an effect for all pixels.
PlanRequest request_everywhere(const Technique& technique, const PlanRequest& asked);

/// The part of a request that applies to an effect: a setting such as radius, a filter or an extra plane applies to some effects
/// only. Throws as `make_plan` does for a frame that lacks what the effect reads.
PlanRequest asked_of_effect(const Technique& technique, const PlanRequest& asked,
                            const std::vector<std::string>& available, const std::string& holds);

/// The plans that may run for an effect: its own with its mask, and those of techniques that refine it, as far as the frame has
/// their inputs. Together they read all planes that the effect and its probe need. Throws MissingPlanes, UsageError.
std::vector<Plan> plans_of_effect(const Technique& technique, const PlanRequest& asked,
                                  const std::vector<std::string>& available, const std::string& holds);

/// Probes a frame on the device (`Effect::probe`); if the probe finds nothing, by the mask itself. A refinement is probed if the
/// frame calls for its effect; one that reads a single view is probed anyway, since hidden layers may call for an effect that
/// nothing visible does. Throws as `make_plan` and `run` do.
Decision decide(const Technique& technique, const EffectProbe& probe);

/// A mask that saves less than 5 % is not worth the pixels that it leaves out.
inline constexpr double most_of_everywhere = 0.95;

/// The planes computed for an effect, and their time.
struct Computed {
  RunResult result;
  bool is_masked = false;
  /// Milliseconds of the whole plan on the device, the least of some alternating rounds; NaN if it was not run.
  double ms = 0, ms_masked = 0, ms_everywhere = 0;
};

/// Runs a decision, which must want the effect. If the mask's use is to be measured, both ways run alternately, and the mask is
/// kept if it saves 5 % or more: the pixels left out are then open, which is nearly what computing everywhere finds. Otherwise
/// the decision changes to everywhere, and its text says so.
Computed compute(Decision& decision, const EffectProbe& probe, MaskUse use);

/// Computes the cells of an effect's mask, as `EffectChoice::seen`, at the mask's full accuracy.
void probe_closely(EffectChoice& choice, const EffectProbe& probe);

/// Moves all planes, view by view, to a frame of the same views.
void take_planes(Frame& from, Frame& to);

}  // namespace gloam
