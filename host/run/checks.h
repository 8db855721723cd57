// Checks of a plan against a device and a frame, before anything is computed.
#pragma once

#include "gloam/run.h"

namespace gloam {

/// Throws Error if the device's memory or its largest buffer is too small.
void check_memory(const Plan& plan, const Layout& layout, size_t views, const DeviceInfo& info);

/// Throws UsageError for lanes and repeats that are not allowed, Error if double precision is asked for and the device has none.
void check_options(const Plan& plan, const DeviceInfo& info, const RunOptions& options);

/// Throws Error for a plan that reads two views of a frame that has more or fewer.
void check_number_of_views(const Plan& plan, size_t views);

/// Throws Error for a frame without views or pixels, for too few views, and for a view that lacks the camera, the pose or the
/// projection that the plan's passes need.
void check_views(const Plan& plan, const Frame& frame);

}  // namespace gloam
