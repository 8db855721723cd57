// The OpenCL side of the baselines: planes on the device, a kernel with its arguments, and its time.
#pragma once

#include <string>

#include "device_impl.h"
#include "gloam/frame.h"

namespace gloam::bench {

/// Texts of bench/*.cl.
extern const char* const naive_cl;
extern const char* const gather_floor_cl;
extern const char* const copy_floor_cl;

/// What HBAO+ reads, on the device as gloam::run puts it there, and room for one plane of results.
class DevicePlanes {
 public:
  DevicePlanes(Device& device, const Frame& frame);
  cl::Buffer depth, normal_x, normal_y, normal_z, result;
  /// Takes the result to the host. It stays valid until the next launch.
  const Channel& download();

 private:
  Device::Impl& device_;
  Channel host_;
};

/// Builds a kernel from text. Throws Error with the compiler's log.
cl::Kernel build(Device& device, const std::string& text, const std::string& options, const char* kernel);

/// Milliseconds that a launch took, by its event. `local` may be cl::NullRange.
double launch(Device& device, cl::Kernel& kernel, const cl::NDRange& global, const cl::NDRange& local = cl::NullRange);

}  // namespace gloam::bench
