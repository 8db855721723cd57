// Plans for frames in files, before any plane is decoded.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gloam/frame_files.h"
#include "gloam/plan.h"
#include "gloam/radius.h"

namespace gloam {

/// A plan for the planes that all views of a frame have. The message of `MissingPlanes` also lists the frame's channels; if only
/// some views lack a plane, Error names these.
Plan plan_for_files(const FrameFiles& files, const PlanRequest& request);

/// The radius that suits a frame, by its header (`aoRadius`, scene units); none if the header lacks it. A value that is not a valid
/// radius is ignored, and a sentence in `notes` says so.
std::optional<double> stated_radius(const FrameFile& file, std::vector<std::string>& notes);

/// Chooses a radius for a request without one, and makes its plan again; a request with one stays as it is. None if the plan has no radius. `stated`: by the frame's header.
std::optional<Radius> settle_radius(PlanRequest& request, Plan& plan, const Frame& frame, std::optional<double> stated,
                                    const std::vector<std::string>& available, const std::string& holds);

/// Radii that can be stated, scene units: kernels hold them as float.
inline constexpr double least_radius = 1e-30, most_radius = 1e30;

}  // namespace gloam
