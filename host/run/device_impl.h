// OpenCL behind gloam/device.h.
#pragma once

#include <CL/opencl.hpp>
#include <map>
#include <mutex>
#include <string>

#include "gloam/device.h"

namespace gloam {

/// "CL_OUT_OF_RESOURCES" for -5.
std::string cl_error_name(int code);

struct Device::Impl {
  std::recursive_mutex busy;  ///< held while anything runs or is compiled
  DeviceInfo info;
  cl::Device device;
  cl::Context context;
  cl::CommandQueue queue;
  std::map<std::string, cl::Program> programs;  ///< by source file, kernel and build options

  /// The built program of a kernel of a file. Throws Error with the build log.
  cl::Program& program(const std::string& source, const std::string& kernel, const std::string& options);
};

}  // namespace gloam
