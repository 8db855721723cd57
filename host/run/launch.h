// One launch of a kernel on an image.
#pragma once

#include "gloam/frame.h"
#include "gloam/technique.h"
#include "run/device_impl.h"

namespace gloam {

/// What a launch took, milliseconds.
struct Launched {
  double ms = 0;      ///< by its events, or by the wall clock if the device has no timestamps
  double cpu_ms = 0;  ///< that this process's threads computed meanwhile
};

/// Runs a pass's kernel on an image of this layout and waits for its end.
Launched launch(Device::Impl& device, cl::Kernel& kernel, const Pass& pass, const Layout& layout, const Tuning& tuning);

}  // namespace gloam
