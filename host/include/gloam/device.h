// OpenCL devices: finding one, and what a run needs to know of it.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace gloam {

struct DeviceInfo {
  std::string platform, name, type;  ///< type: "cpu", "gpu" or "other"
  std::string driver;
  int lanes = 1;  ///< pixels per work-item that suit the device: its float vector width on PoCL's CPUs
  bool has_double = false;
  bool shares_memory = false;                         ///< host memory can be used in place
  bool has_timestamps = false;                        ///< events tell how long a launch took
  bool rounds_correctly = false;                      ///< offers -cl-fp32-correctly-rounded-divide-sqrt
  unsigned long long memory = 0, largest_buffer = 0;  ///< bytes
};

/// PoCL needs a folder for its compiled kernels, and finds no device where it has none (a service, a container without a
/// home): it then gets one among the temporary files. Sets the environment: call it before any thread is started.
void give_pocl_a_folder();

/// All devices of all platforms. Throws Error when there is no platform (and says how to install one).
std::vector<DeviceInfo> list_devices();

/// An open device with its queue and its compiled programs, which it keeps: a kernel is compiled when it is first needed. Move-only.
/// Threads may share one; what they run on it goes one after another. Devices of their own run side by side.
class Device {
 public:
  /// `text` is part of the platform's or the device's name, any case; empty: the first GPU, else the device with
  /// the most lanes.
  /// Throws Error listing the devices there are when none fits.
  explicit Device(const std::string& text = "");
  ~Device();
  Device(Device&&) noexcept;

  /// Throws Error for a device that has been moved to another variable.
  const DeviceInfo& info() const;

  struct Impl;
  Impl& impl();  ///< for the library

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace gloam
