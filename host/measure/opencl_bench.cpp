#include "measure/opencl_bench.h"

#include <chrono>

#include "gloam/error.h"

namespace gloam::bench {
namespace {

cl::Buffer upload(Device::Impl& device, const Channel& channel) {
  const cl_mem_flags flags =
      CL_MEM_READ_ONLY | (device.info.shares_memory ? CL_MEM_USE_HOST_PTR : CL_MEM_COPY_HOST_PTR);
  return cl::Buffer(device.context, flags, channel.layout().bytes(), const_cast<float*>(channel.data()));
}

}  // namespace

ResultPlane::ResultPlane(Device& device, const Layout& layout) : device_(&device.impl()), host_(layout, 0.0f) {
  const cl_mem_flags flags =
      CL_MEM_READ_WRITE | (device_->info.shares_memory ? CL_MEM_USE_HOST_PTR : CL_MEM_COPY_HOST_PTR);
  buffer = cl::Buffer(device_->context, flags, host_.layout().bytes(), host_.data());
}

const Channel& ResultPlane::download() {
  device_->queue.enqueueReadBuffer(buffer, CL_TRUE, 0, host_.layout().bytes(), host_.data());
  return host_;
}

DevicePlanes::DevicePlanes(Device& device, const Frame& frame)
    : device_(device), layout_(frame.views[0].planes.at("depth").channels[0].layout()) {
  const View& view = frame.views[0];
  const Plane& normal = view.planes.at("normal");
  depth = upload(device.impl(), view.planes.at("depth").channels[0]);
  normal_x = upload(device.impl(), normal.channels[0]);
  normal_y = upload(device.impl(), normal.channels[1]);
  normal_z = upload(device.impl(), normal.channels[2]);
}

ResultPlane& DevicePlanes::result(size_t number) {
  while (results_.size() <= number) results_.emplace_back(device_, layout_);
  return results_[number];
}

cl::Kernel build(Device& device, const std::string& text, const std::string& options, const char* kernel) {
  Device::Impl& impl = device.impl();
  cl::Program program(impl.context, text);
  try {
    program.build({impl.device}, options.c_str());
  } catch (const cl::Error& error) {
    throw Error("{} does not build ({}):\n{}", kernel, cl_error_name(error.err()),
                program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(impl.device));
  }
  return cl::Kernel(program, kernel);
}

double launch(Device& device, cl::Kernel& kernel, const cl::NDRange& global, const cl::NDRange& local) {
  const auto start = std::chrono::steady_clock::now();
  cl::Event event;
  device.impl().queue.enqueueNDRangeKernel(kernel, cl::NullRange, global, local, nullptr, &event);
  event.wait();
  const double wall = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  if (!device.impl().info.has_timestamps) return wall;
  const cl_ulong from = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
  const cl_ulong to = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
  return to > from ? double(to - from) * 1e-6 : wall;
}

}  // namespace gloam::bench
