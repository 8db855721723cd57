// One launch of a kernel on an image.
#pragma once

#include "gloam/frame.h"
#include "gloam/technique.h"
#include "run/device_impl.h"

namespace gloam {

/// Runs a pass's kernel on an image of such a layout and waits for the end. Milliseconds that the launch took, by its events;
/// by the wall clock where the device has no timestamps.
double launch(Device::Impl& device, cl::Kernel& kernel, const Pass& pass, const Layout& layout, int lanes);

}  // namespace gloam
