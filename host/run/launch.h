// One launch of a kernel on an image.
#pragma once

#include <chrono>

#include "gloam/frame.h"
#include "gloam/technique.h"
#include "run/device_impl.h"

namespace gloam {

/// What a launch took, milliseconds.
struct Launched {
  double ms = 0;      ///< by its events, or by the wall clock if the device has no timestamps
  double cpu_ms = 0;  ///< that this process's threads computed meanwhile
};

/// A launch that may still be under way.
struct Launch {
  cl::Event first, last;
  std::chrono::steady_clock::time_point start;
  double cpu_before = 0;
};

/// Whether what launches took can be told after all of them have ended: where events tell it. On CPUs processor time is measured too,
/// launch by launch. Tests set GLOAM_LAUNCHES=ahead, so that CPUs do as GPUs do, without processor times.
bool launches_ahead(const DeviceInfo& info);

/// Rows of pixels that a work-item computes.
int rows_of_item(const DeviceInfo& info, const Pass& pass);

/// Enqueues a pass's kernel on an image of this layout.
Launch launch(Device::Impl& device, cl::Kernel& kernel, const Pass& pass, const Layout& layout, const Tuning& tuning);

/// Waits for a launch's end. Throws cl::Error where the kernel failed.
Launched finish(const Device::Impl& device, const Launch& launch);

}  // namespace gloam
