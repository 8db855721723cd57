// OpenCL devices: how to find one, and what a run needs to know about it.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace gloam {

/// What suits one kind of kernel on a device.
struct KernelTuning {
  int group = 0;  ///< most work-items per work-group; 0: the driver chooses
  int registers =
      0;  ///< most registers per work-item, where the driver takes a limit (NVIDIA's); 0: the compiler chooses
};

/// How an image is laid out over the work-items of a device. It changes times, and in fast mathematics the last bits.
struct Tuning {
  int lanes = 1;        ///< pixels per work-item: the float vector width on PoCL's CPUs
  KernelTuning search;  ///< of kernels that read far around each pixel (`Footprint::is_wide`)
  KernelTuning others;
  bool gathers_by_loads = false;  ///< 16 lanes load one by one: AMD's processors take longer to gather with AVX-512
};

struct DeviceInfo {
  std::string platform, name, type;  ///< type: "cpu", "gpu" or "other"
  std::string driver;
  Tuning tuning;               ///< as `gloam doctor` measured on this device and driver, else `usual`
  Tuning usual;                ///< of devices of this kind (data/devices.json)
  bool keeps_kernels = false;  ///< the driver keeps compiled kernels on disk by itself
  bool has_double = false;
  bool shares_memory = false;                         ///< host memory can be used in place
  bool has_timestamps = false;                        ///< events give the duration of a launch
  bool rounds_correctly = false;                      ///< offers -cl-fp32-correctly-rounded-divide-sqrt
  unsigned long long memory = 0, largest_buffer = 0;  ///< bytes
};

/// Gives PoCL a folder among the temporary files for its compiled kernels, if it has none (a service, a container without a home):
/// without one it finds no device. Sets the environment: call it before any thread is started.
void give_pocl_a_folder();

/// The devices of all platforms; `text`: those whose platform or name contains it, in any case. Throws Error if there is no platform
/// (and says how to install one), and, with a list of the devices, if none matches.
std::vector<DeviceInfo> list_devices(const std::string& text = "");

/// Text that names a device among all: its platform and its name.
std::string label_of(const DeviceInfo& info);

/// Numbers of pixels per work-item for which there are kernels, and the most work-items per work-group.
inline constexpr std::array lane_widths = {1, 4, 8, 16};
inline constexpr int most_per_group = 1024;

/// An open device with its queue and its compiled programs. A kernel is compiled when it is first needed, and kept. Move-only.
/// Threads may share a device; their work on it runs one after another. Different devices run side by side.
class Device {
 public:
  /// `text`: part of the platform's or the device's name, in any case; empty: the first GPU, else the device with the most lanes.
  /// A text that is the whole `label_of` a device means that device. `uses_measured_tuning`: false leaves what `gloam doctor` measured
  /// aside, so that `DeviceInfo::tuning` is `usual`. Throws Error, with a list of the devices, if none matches.
  explicit Device(const std::string& text = "", bool uses_measured_tuning = true);
  ~Device();
  Device(Device&&) noexcept;

  /// Throws Error if the device has been moved to another variable.
  const DeviceInfo& info() const;

  struct Impl;
  Impl& impl();                                 ///< for the library
  explicit Device(std::unique_ptr<Impl> impl);  ///< for the library

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace gloam
