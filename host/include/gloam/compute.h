// From a frame to results in one call. plan.h and run.h offer the same in steps.
#pragma once

#include <vector>

#include "gloam/arrays.h"
#include "gloam/run.h"

namespace gloam {

/// Plans for the planes that every view of a frame has, and runs the plan. Without a radius in the request, `default_radius`
/// (radius.h) makes one from the frame: each frame of a sequence gets its own, unless `PlanRequest::radius` is set.
/// `PlanRequest::outputs` names techniques, or planes that a default technique makes: "ao". Throws as `make_plan` and `run` do.
RunResult compute(const PlanRequest& request, const Frame& frame, Device& device, const RunOptions& options = {});

/// Ambient occlusion of arrays: width * height values from 0 (closed) to 1 (open), rows from the top; 1 where there is no surface.
/// `request`: radius (scene units), preset, settings; `outputs` may name a technique that makes `ao`; empty: the default one.
/// Throws as `frame_from` and `compute` do.
std::vector<float> ambient_occlusion(const Arrays& arrays, Device& device, const PlanRequest& request = {},
                                     const RunOptions& options = {});

}  // namespace gloam
