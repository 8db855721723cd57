// Restricting techniques to where a mask says: a plan for the whole image, turned into one for the wanted pixels.
#pragma once

#include <vector>

#include "gloam/plan.h"

namespace gloam {

/// Stands for the passes that a plan adds by itself: "mask/bits", "mask/grown". Not in the registry.
const Technique& masking();

/// Lets the passes of the techniques, and those that upsample after them, skip rows of pixels of which the mask wants none
/// (`Pass::can_skip`): filters where it is above 0, estimates also as far around as filters read. Pixels of outputs that
/// are left out hold what lies outside of such a plane: open, for AO. Sets `Plan::wanted`. To be called after `reduce`.
/// Throws UsageError where no pass can be restricted.
void restrict_to_mask(Plan& plan, const std::vector<const Technique*>& techniques);

}  // namespace gloam
