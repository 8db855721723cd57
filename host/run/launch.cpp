#include "run/launch.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "base/cpu_time.h"
#include "run/tuning.h"

namespace gloam {
namespace {

size_t largest_power_of_two(size_t most) {
  size_t power = 1;
  while (2 * power <= most) power *= 2;
  return power;
}

/// The largest power of two, at most `most`, that divides a number.
size_t power_of_two_in(size_t number, size_t most) {
  size_t power = largest_power_of_two(most);
  while (number % power != 0) power /= 2;
  return power;
}

/// Work-group size. A CPU driver recompiles a kernel for every size, and by itself chooses a size per image size, for small
/// images the whole image: that costs seconds, and what each work-item keeps overflows the stack. So one size serves all small
/// images, and few serve large ones. `most`: 0 lets the driver choose.
cl::NDRange group_size(const DeviceInfo& info, size_t columns, size_t rows, size_t most) {
  if (most == 0) return cl::NullRange;
  constexpr size_t few_items = 1 << 14, widest = 32;
  if (info.type == "cpu" && columns * rows < few_items) return cl::NDRange(1, 1);
  if (info.type == "cpu") return cl::NDRange(power_of_two_in(columns, std::min(most, widest)), 1);
  // Whole warps, and as many rows whatever the height is: the rows that are left over are a launch of their own.
  const size_t width = power_of_two_in(columns, std::min(most, widest));
  return cl::NDRange(width, std::min(largest_power_of_two(most / width), largest_power_of_two(rows)));
}

/// Work-items per row of a strip, a multiple of the group's. For passes with a wide footprint a CPU computes the image strip by
/// strip, each from top to bottom, so that the pixels around those at work stay in the core's cache: whole rows are 5 to 30 %
/// slower. Passes that stream lose as much by it, and other devices do not need it.
size_t columns_of_strip(const DeviceInfo& info, const Pass& pass, size_t columns, const cl::NDRange& group, int lanes) {
  constexpr size_t pixels = 480;  // half to twice as many are as fast
  if (info.type != "cpu" || !pass.footprint.is_wide || group.dimensions() == 0) return columns;
  return group[0] * std::max(size_t(1), pixels / (group[0] * size_t(lanes)));
}

/// The tuning's group, or less where a device, or a kernel with many registers, takes no more: what was the fastest for one kernel may
/// be too much for another.
size_t most_per_group_of(const cl::Kernel& kernel, const Device::Impl& device, const KernelTuning& tuning) {
  return std::min(size_t(tuning.group), kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(device.device));
}

/// Work-items from the image's top to its bottom.
size_t items_down(const DeviceInfo& info, const Pass& pass, const Layout& layout) {
  const size_t each = size_t(rows_of_item(info, pass));
  return (size_t(layout.height) + each - 1) / each;
}

/// Items of an image, `items` from `from` on.
void enqueue(Device::Impl& device, cl::Kernel& kernel, const cl::NDRange& from, const cl::NDRange& items,
             const cl::NDRange& group, cl::Event* event) {
  // PoCL compiles a kernel once for launches that begin at 0 and once for all others, for a quarter of a second or more each. No launch
  // begins at 0 in a third dimension, which kernels know nothing of.
  if (device.info.type == "cpu" && group.dimensions() == 2)
    device.queue.enqueueNDRangeKernel(kernel, cl::NDRange(from[0], from[1], 1), cl::NDRange(items[0], items[1], 1),
                                      cl::NDRange(group[0], group[1], 1), nullptr, event);
  else
    device.queue.enqueueNDRangeKernel(kernel, from, items, group, nullptr, event);
}

}  // namespace

int rows_of_item(const DeviceInfo& info, const Pass& pass) {
  if (!pass.goes_down) return 1;
  return info.type == "cpu" ? 32 : 16;
}

bool launches_ahead(const DeviceInfo& info) {
  const char* asked = std::getenv("GLOAM_LAUNCHES");
  return info.has_timestamps && (info.type != "cpu" || (asked && std::string_view(asked) == "ahead"));
}

Launch launch(Device::Impl& device, cl::Kernel& kernel, const Pass& pass, const Layout& layout, const Tuning& tuning) {
  Launch launch{.start = std::chrono::steady_clock::now(), .cpu_before = process_cpu_ms()};
  const size_t columns = size_t(layout.pitch / tuning.lanes), rows = items_down(device.info, pass, layout);
  const cl::NDRange group =
      group_size(device.info, columns, rows, most_per_group_of(kernel, device, of_kind(tuning, pass)));
  const size_t strip = columns_of_strip(device.info, pass, columns, group, tuning.lanes);
  const size_t rows_left = group.dimensions() == 2 ? rows % group[1] : 0;
  for (size_t from = 0; from < columns; from += strip)
    enqueue(device, kernel, cl::NDRange(from, 0), cl::NDRange(std::min(strip, columns - from), rows - rows_left), group,
            from == 0 ? &launch.first : &launch.last);
  if (strip >= columns) launch.last = launch.first;
  if (rows_left > 0)
    enqueue(device, kernel, cl::NDRange(0, rows - rows_left), cl::NDRange(columns, rows_left), cl::NDRange(group[0], 1),
            &launch.last);
  return launch;
}

Launched finish(const Device::Impl& device, const Launch& launch) {
  launch.last.wait();
  const double cpu = process_cpu_ms() - launch.cpu_before;
  const double wall =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - launch.start).count();
  for (const cl::Event& event : {launch.first, launch.last}) {
    const cl_int status = event.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>();
    if (status < 0) throw cl::Error(status, "kernel execution");
  }
  if (!device.info.has_timestamps) return {wall, cpu};
  const cl_ulong from = launch.first.getProfilingInfo<CL_PROFILING_COMMAND_START>();
  const cl_ulong to = launch.last.getProfilingInfo<CL_PROFILING_COMMAND_END>();
  return {to > from ? double(to - from) * 1e-6 : wall, cpu};
}

}  // namespace gloam
