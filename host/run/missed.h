// What a mask leaves out by mistake.
#pragma once

#include <optional>

#include "gloam/device.h"
#include "gloam/frame.h"
#include "gloam/plan.h"
#include "gloam/run.h"

namespace gloam {

/// A change of the result by more than this is missed where the mask leaves it out.
constexpr float least_missed = 1.0f / 255;

/// Share of all views' pixels that the mask of a plan leaves out although the plan's first output would change there by more than
/// `least_missed`: measured in one of 16 tiles, in all tiles of a small frame, where the planes are computed without the mask. Empty
/// unless a technique makes the mask and does not read the depth: any other mask either follows from what the frame shows, or is the
/// user's own choice.
/// `request`: that of the plan, with a radius if it has one. `result`: of the plan on this frame. The frame gets a plane for the time of
/// the call.
std::optional<double> missed_share(PlanRequest request, const Plan& plan, Frame& frame, const Frame& result,
                                   Device& device, RunOptions options);

}  // namespace gloam
