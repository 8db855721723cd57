// Frames in EXR files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gloam/frame_files.h"
#include "gloam/plan.h"
#include "python/bindings.h"

namespace gloam::python {

/// Reads planes of a frame. What its header says of its radius and its scene goes with it (`Frame::numbers`, `Frame::attributes`), and so do
/// notes. `camera`: see `take_camera` (requests.h). Needs no interpreter lock.
SharedFrame read_frame(FrameFiles& files, const std::vector<std::string>& planes, const std::optional<Camera>& camera);

/// Reads what a request reads, and the depth, which results are written with.
SharedFrame read_planned(FrameFiles& files, const PlanRequest& request, const std::optional<Camera>& camera);

}  // namespace gloam::python
