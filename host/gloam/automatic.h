// What a frame calls for: of all effects that techniques declare (`Technique::effect`), which ones, and where.
#pragma once

#include <string>
#include <vector>

#include "gloam/device.h"
#include "gloam/frame.h"
#include "gloam/plan.h"
#include "gloam/run.h"

namespace gloam {

/// Of one effect.
struct EffectChoice {
  const Technique* technique = nullptr;
  bool is_wanted = false;
  bool is_everywhere = false;  ///< wanted on so much of the image that no mask is made
  std::string why;             ///< in words, with the share
  double share = 0;            ///< of the tiles that were looked at, of all views
  double classify_ms = 0;      ///< what finding out took, on the device
  std::string cells;           ///< the plane of `seen`
  Frame seen;                  ///< of each view one pixel per tile: above 0 where it is called for
};

/// Techniques that declare an effect.
std::vector<const Technique*> techniques_with_effects();

/// A request for an effect's technique, restricted by its mask or not. `asked`: settings, preset, filter and resolution.
PlanRequest request_for(const Technique& technique, const PlanRequest& asked, bool with_mask);

/// Planes that an effect and the glance at it take from a frame. Throws MissingPlanes, UsageError.
std::vector<std::string> inputs_of_effect(const Technique& technique, const PlanRequest& asked,
                                          const std::vector<std::string>& available, const std::string& holds);

/// Looks at a frame that has passed the door, on the device, at a glance; where that finds nothing, by the mask itself.
/// Throws what `make_plan` and `run` do.
EffectChoice choose(const Technique& technique, const PlanRequest& asked, const Frame& frame,
                    const std::vector<std::string>& available, const std::string& holds, Device& device,
                    const RunOptions& options);

/// The cells of an effect's mask, as `EffectChoice::seen`.
Frame cells_of(const Technique& technique, const PlanRequest& asked, const Frame& frame,
               const std::vector<std::string>& available, const std::string& holds, Device& device);

}  // namespace gloam
