// Floors: times that no implementation of the same sampling can beat on this device.
#pragma once

#include <optional>

#include "measure/estimate.h"
#include "measure/opencl_bench.h"

namespace gloam::bench {

/// Their kernels as they are compiled.
std::vector<KernelText> floor_texts(const Tuning& tuning);

/// A kernel of bench/ on gloam's lanes.
class Floor {
 public:
  double run();  ///< milliseconds
  /// What the process's threads computed in the last run; empty where the device is no CPU.
  std::optional<double> cpu_ms() const { return cpu_ms_; }

 protected:
  Floor(Device& device, const Frame& frame, const KernelText& text);
  cl::Kernel kernel_;

 private:
  Device& device_;
  cl::NDRange global_;
  std::optional<double> cpu_ms_;
};

/// Addresses, gathers and additions of HBAO+ 8 x 4.
class GatherFloor : public Floor {
 public:
  GatherFloor(Device& device, const Frame& frame, DevicePlanes& planes, const HbaoPlusParams& params);
};

/// Reads one plane and writes one.
class CopyFloor : public Floor {
 public:
  CopyFloor(Device& device, const Frame& frame, DevicePlanes& planes);
};

/// Fused multiply-adds alone.
class FmaPeak : public Floor {
 public:
  FmaPeak(Device& device, const Frame& frame, DevicePlanes& planes);
  /// Of one run; a fused multiply-add is two.
  double operations() const { return operations_; }

 private:
  double operations_ = 0;
};

}  // namespace gloam::bench
