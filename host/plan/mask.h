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
/// With `elsewhere` the techniques are two estimates of the same planes, and that one, which comes first in the plan, sees
/// to the rest: nothing is left out. Sets `Plan::rest` then.
/// Throws UsageError where no pass can be restricted.
void restrict_to_mask(Plan& plan, const std::vector<const Technique*>& techniques,
                      const Technique* elsewhere = nullptr);

/// The pass from a plane that is above 0 or not to bits of pixels (shared/lanes/wanted.h): `wanted` and, unless empty, `rest`, those
/// of the others; of the bits `asked` alone, unless that is empty. The plane is of cells of `cell` x `cell` pixels.
PlannedPass bits_pass(const std::string& source, int cell, const std::string& asked, const std::string& wanted,
                      const std::string& rest);

/// Lets a pass skip rows of pixels by these bits instead of any others.
void skip_by(Pass& pass, const std::string& bits);

/// What a pass skips keeps what an earlier one has left there.
void keep_skipped(Pass& pass);

}  // namespace gloam
