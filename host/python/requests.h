// What a call asks for, as the keywords of gloam/__init__.py say it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gloam/exr.h"
#include "gloam/goal.h"
#include "gloam/plan.h"
#include "gloam/run.h"
#include "python/bindings.h"

namespace gloam::python {

/// Throw UsageError, as the command does, for words that are not allowed. A request without a technique has no outputs.
PlanRequest plan_request(const py::dict& words);
RunOptions run_options(const py::dict& words);
ReadOptions read_options(const py::dict& words);
/// Of the words "budget", milliseconds or a text such as "60fps", and "error". Throws UsageError for numbers that are not above 0.
Goal goal_of(const py::dict& words);
NormalConvention normal_convention(const py::dict& words);
StatedDepth stated_depth(const py::dict& words);

/// The camera that stands in for those of the files, if one is given as an object: `read_options` has the files read with it.
std::optional<Camera> given_camera(const py::dict& words);
/// Gives a frame that was read with it the camera as it was given: without a pose where it has none.
void take_camera(const std::optional<Camera>& camera, Frame& frame);

}  // namespace gloam::python
