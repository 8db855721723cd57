// The examination of one device, in a process of its own: a driver that crashes or hangs ends that process and not all.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "doctor/measure.h"
#include "gloam/device.h"
#include "run/device_record.h"

namespace gloam::doctor {

/// A self-test's result.
struct TestResult {
  std::string kind, technique, why;
  bool held = false, same_bits = false;
};

/// What an examination found.
struct Diagnosis {
  DeviceInfo info;
  std::vector<TestResult> tests;
  DeviceRecord record;
  std::vector<std::string> lacks;  ///< what the device cannot do, and what follows from that
  std::vector<std::string> notes;
  std::vector<Timed> timed;  ///< the fastest first; empty: not measured this time
};

/// In the parent: examines a device. Lane width, group size and starts are measured where no earlier record of the same kernels has
/// them, or `again` is set. `goes_on` is called after each step.
Diagnosis diagnose(const DeviceInfo& info, bool again, const std::function<void()>& goes_on);

/// In the child: runs the self-tests, measures if wanted, and writes a JSON line for each step on standard output.
void examine_device_here(const std::string& device, bool measures);

}  // namespace gloam::doctor
