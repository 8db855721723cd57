// The OpenCL side of the baselines: planes on the device, a kernel with its arguments, and its time.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "gloam/frame.h"
#include "run/device_impl.h"

namespace gloam::bench {

/// Texts of bench/*.cl.
extern const char* const naive_cl;
extern const char* const naive_bilateral_cl;
extern const char* const naive_gtao_cl;
extern const char* const naive_hbao_plus_cl;
extern const char* const gather_floor_cl;
extern const char* const copy_floor_cl;
extern const char* const fma_peak_cl;

/// Device memory for one computed plane.
class ResultPlane {
 public:
  ResultPlane(Device& device, const Layout& layout);
  /// Copies the plane to the host; valid until the next launch.
  const Channel& download();

 private:
  Device::Impl* device_;
  Channel host_;  // outlives the buffer, whose memory it may be

 public:
  cl::Buffer buffer;
};

/// The inputs of ambient occlusion, on the device as gloam::run puts them there, and memory for results.
class DevicePlanes {
 public:
  DevicePlanes(Device& device, const Frame& frame);
  cl::Buffer depth, normal_x, normal_y, normal_z;
  /// Result plane with this number, made at first use and shared.
  ResultPlane& result(size_t number = 0);

 private:
  Device& device_;
  Layout layout_;
  std::deque<ResultPlane> results_;
};

/// A kernel of a baseline as it is compiled.
struct KernelText {
  std::string text, options;
  const char* kernel;
};

/// Builds a kernel from text. Throws Error with the compiler's log.
cl::Kernel build(Device& device, const std::string& text, const std::string& options, const char* kernel);

/// Milliseconds that a launch took, by its event. `local` may be cl::NullRange.
double launch(Device& device, cl::Kernel& kernel, const cl::NDRange& global, const cl::NDRange& local = cl::NullRange);

}  // namespace gloam::bench
