// Restricts techniques to a mask: turns a plan for the whole image into one for the wanted pixels.
#pragma once

#include <vector>

#include "gloam/plan.h"

namespace gloam {

/// The technique of the passes that the plan itself adds: "mask/bits", "mask/grown". It is not in the registry.
const Technique& masking();

/// Lets the passes of the techniques, and the upsampling after them, skip rows of lanes without a wanted pixel
/// (`Pass::can_skip`). Filters run where the mask is above 0, estimates also where filters read. Skipped pixels of outputs get
/// the plane's value outside the image: open, for AO. Sets `Plan::wanted`. Call it after `reduce`.
/// With `elsewhere` the techniques are two estimates of the same planes; that one, which comes first in the plan, computes the
/// rest, so that nothing is skipped. Then sets `Plan::rest`. Throws UsageError if no pass can be restricted.
void restrict_to_mask(Plan& plan, const std::vector<const Technique*>& techniques,
                      const Technique* elsewhere = nullptr);

/// The pass from a plane, wanted where it is above 0, to bits of pixels (shared/lanes/wanted.h): `wanted`, and, unless empty,
/// `rest`, the bits of the others; both limited to the bits `asked`, unless that is empty. The plane has one pixel per cell of
/// `cell` x `cell` pixels.
PlannedPass bits_pass(const std::string& source, int cell, const std::string& asked, const std::string& wanted,
                      const std::string& rest);

/// Lets a pass skip pixels by these bits instead of any others.
void skip_by(Pass& pass, const std::string& bits);

/// Pixels that a pass skips keep the value of an earlier pass.
void keep_skipped(Pass& pass);

}  // namespace gloam
