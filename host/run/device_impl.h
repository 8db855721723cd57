// OpenCL behind gloam/device.h.
#pragma once

#include <CL/opencl.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "gloam/device.h"
#include "gloam/parameters.h"
#include "run/buffer_pool.h"
#include "run/kernel_cache.h"
#include "run/uploads.h"

namespace gloam {

/// "CL_OUT_OF_RESOURCES" for -5.
std::string cl_error_name(int code);

/// Of the caller's queue. Throws Error for one that runs commands out of order.
std::unique_ptr<Device::Impl> impl_of(const cl::CommandQueue& queue);

struct Device::Impl {
  std::recursive_mutex busy;  ///< held while anything runs or is compiled
  DeviceInfo info;
  cl::Device device;
  cl::Context context;
  cl::CommandQueue queue;
  std::map<std::string, cl::Program> programs;  ///< by source file, kernel, declaration and build options

  BufferPool pool;      ///< device memory that no run uses
  Transfers transfers;  ///< not held by `busy`
  KernelCache cache;    ///< compiled kernels on disk; none where the driver keeps its own

  /// The built program of a kernel of a file, with the `declaration` of its arguments (run/arguments.h). Throws Error with the first
  /// error of the build log, and the name of the file that holds all of it.
  cl::Program& program(const std::string& source, const std::string& kernel, const std::string& declaration,
                       const std::string& options);

 private:
  std::string key_of(const std::string& source, const std::string& options) const;
  std::unique_ptr<cl::Program> kept_program(const std::string& key, const std::string& options);
  void keep(const std::string& key, const cl::Program& program) const;
};

}  // namespace gloam
