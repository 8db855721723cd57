// The naive baselines: techniques as plain ports of GPU kernels, one pixel per work-item.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gloam/plan.h"
#include "measure/estimate.h"
#include "measure/opencl_bench.h"
#include "measure/timing.h"

namespace gloam::bench {

/// The value of a define of a pass; 0 if it has none of the name.
int define_of(const Pass& pass, const std::string& name);

/// Loop counts as arguments, or known to the compiler.
enum class Counts { at_run_time, unrolled };

/// A naive kernel, and the part of a technique that it computes.
struct NaiveKernel {
  std::string technique;
  const char* text;  ///< comes after naive.cl
  const char* kernel;
  bool filters = false;  ///< reads the result of the pass before
  int samples = 0;       ///< samples per pixel for which it is compared; 0: any number
  double tolerance = 0;  ///< for an estimate: mean absolute difference from gloam up to which it computes the same
  Settings knows = {};   ///< settings that must have these values for a comparison
};

const std::vector<NaiveKernel>& naive_kernels();

/// All of them as they are compiled, with their counts as arguments and unrolled.
std::vector<KernelText> naive_texts();

/// Null if there is no kernel that computes the same with the technique's settings.
const NaiveKernel* naive_kernel_for(const PlannedPass& planned);

/// Whether every pass of a plan has a naive kernel.
bool has_naive(const Plan& plan);

/// A plan's passes as naive kernels, one after another; each may read the result of the one before.
class Naive {
 public:
  /// For `has_naive(plan)`, and one view with a perspective camera. Compiles and runs it once. Device and planes must outlive it.
  Naive(const Plan& plan, const Frame& frame, DevicePlanes& planes, Device& device,
        Counts counts = Counts::at_run_time);

  double run();  ///< milliseconds, the sum over passes

  size_t passes() const { return passes_.size(); }
  const Series& ms(size_t pass) const { return passes_[pass].ms; }  ///< one per call of `run`
  /// The result of a pass, valid until another naive baseline runs on the same planes.
  const Channel& result(size_t pass) { return planes_.result(pass).download(); }

 private:
  struct Pass {
    std::vector<cl::Kernel> kernels;
    Series ms;
  };
  Device& device_;
  DevicePlanes& planes_;
  std::vector<Pass> passes_;
  cl::NDRange global_;
};

}  // namespace gloam::bench
