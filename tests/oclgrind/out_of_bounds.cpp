// A kernel that writes one element past its buffer: shows that the check with oclgrind can fail.
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_TARGET_OPENCL_VERSION 120
#define CL_HPP_ENABLE_EXCEPTIONS
#include <CL/opencl.hpp>
#include <cstdio>
#include <vector>

int main() {
  std::vector<cl::Platform> platforms;
  cl::Platform::get(&platforms);
  std::vector<cl::Device> devices;
  platforms.at(0).getDevices(CL_DEVICE_TYPE_ALL, &devices);
  cl::Context context(devices.at(0));
  cl::CommandQueue queue(context, devices.at(0));
  cl::Program program(context, "kernel void fill(global float* plane) { plane[get_global_id(0) + 1] = 1; }");
  program.build({devices.at(0)});
  cl::Kernel kernel(program, "fill");
  cl::Buffer plane(context, CL_MEM_READ_WRITE, 16 * sizeof(float));
  kernel.setArg(0, plane);
  queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(16));
  queue.finish();
  std::printf("ran 1 passes on %s\n", platforms.at(0).getInfo<CL_PLATFORM_NAME>().c_str());
}
