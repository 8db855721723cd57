// gloam auto on frames in files.
#pragma once

#include <string>
#include <vector>

#include "gloam/auto.h"
#include "gloam/frame_files.h"

namespace gloam {

/// A frame that is open, with the effects that it may call for.
struct AutoFrame : AutoPlan {
  FrameFiles files;
};

/// As `plan_auto`.
AutoFrame planned_auto(FrameFiles files, const PlanRequest& asked, const AutoPurpose& purpose,
                       const std::vector<Unfit>& unfit = {});

/// Throws Error for files without depth, if effects are to be written: what holds all light already has none to add.
void check_has_depth(const AutoFrame& planned, const std::string& out);

/// Decodes the planes, and plans again without those that turned out to be unfit, which are left out of the frame (but for colour,
/// which pictures show).
Frame read_and_judge(AutoFrame& planned, const PlanRequest& asked, const AutoPurpose& purpose);

/// What the header says that colour holds; as it says nothing, the usual, and `notes` tells.
ColorHolds holds_of(const FrameFiles& files, std::vector<std::string>& notes);

}  // namespace gloam
