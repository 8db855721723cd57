// One launch of a kernel on an image.
#pragma once

#include "gloam/frame.h"
#include "gloam/technique.h"
#include "run/device_impl.h"

namespace gloam {

/// Runs a pass's kernel on an image of this layout and waits for its end. Returns the launch's time in milliseconds, by its
/// events, or by the wall clock if the device has no timestamps.
double launch(Device::Impl& device, cl::Kernel& kernel, const Pass& pass, const Layout& layout, const Tuning& tuning);

}  // namespace gloam
