// From a frame to results in one call. plan.h and run.h offer the same in steps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gloam/arrays.h"
#include "gloam/radius.h"
#include "gloam/run.h"

namespace gloam {

/// A plan for a frame, with the radius that it takes.
struct Computation {
  Plan plan;
  std::optional<Radius> radius;    ///< of ambient occlusion; none where the plan has no radius
  std::vector<std::string> notes;  ///< what does not suit the frame, a sentence each
};

/// The first half of `compute`: plans, makes the default radius, and looks whether both suit the frame. The second half is `run`
/// (run.h), with the same frame. `also`: planes that the caller adds to the frame in between, such as those of a history (history.h). Throws
/// as `make_plan` and `check` (frame.h) do.
Computation plan_on(const PlanRequest& request, const Frame& frame, const std::vector<std::string>& also = {});

/// The names of a frame's planes, as `make_plan` takes them: "the frame has only depth and normal".
std::string planes_in_words(const std::vector<std::string>& planes);

/// Notes, a sentence each: two eyes have no surface in common (most likely they show two scenes, or have each other's cameras); what
/// techniques take for something that the views do not state.
std::vector<std::string> notes_about_views(const Plan& plan, const Frame& frame);

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
