// The naive baseline: HBAO+ as a plain port of a GPU kernel, one pixel per work-item.
#pragma once

#include "estimate.h"
#include "opencl_bench.h"

namespace gloam::bench {

/// Loop counts as arguments, or known to the compiler.
enum class Counts { at_run_time, unrolled };

class Naive {
 public:
  Naive(Device& device, const Frame& frame, DevicePlanes& planes, const HbaoPlusParams& params, Counts counts);
  double run();  ///< milliseconds; the result is in the planes

 private:
  Device& device_;
  cl::Kernel kernel_;
  cl::NDRange global_;
};

}  // namespace gloam::bench
