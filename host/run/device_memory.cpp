#include "gloam/device_memory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "normalise/background.h"
#include "plan/layouts.h"
#include "plan/lifetimes.h"
#include "run/checks.h"
#include "run/device_impl.h"
#include "run/driver.h"
#include "run/view_on_device.h"
#include "run/views.h"

namespace gloam {
namespace {

constexpr size_t guard_bytes = Layout::guard * sizeof(float), lane_bytes = 16 * sizeof(float);
constexpr const char* arguments_of_copy =
    "#define ARGUMENTS global const float* from, ulong from_index, ulong from_step, ulong from_pitch, global float* "
    "to, "
    "ulong to_index, ulong to_step, ulong to_pitch, ulong width, float low, float high, float below, float above, "
    "float otherwise, float outside\n";

/// What a copy makes of values that kernels do not expect, and of the padding.
struct Bounds {
  float low, high, below, above, otherwise, outside;
};

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr Bounds any_value = {-infinite, infinite, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0};

Bounds bounds_of(const PlaneKind& kind) {
  constexpr float most = std::numeric_limits<float>::max();
  switch (kind.meaning) {
    case PlaneKind::view_depth:
      return {nearest_depth, std::nextafter(farthest_depth, 0.0f), infinite, infinite, infinite, infinite};
    case PlaneKind::unit_interval:
      return {0, 1, 0, 1, kind.outside, kind.outside};
    case PlaneKind::unit_vector:
      return {-1, 1, 0, 0, 0, kind.outside};
    case PlaneKind::length:
      return {0, most, 0, 0, 0, kind.outside};
    default:
      return {-most, most, 0, 0, 0, kind.outside};
  }
}

size_t pitch_of(const DevicePlane& plane, const DeviceFrame& frame) {
  return plane.pitch != 0 ? plane.pitch : size_t(frame.width) * plane.channels.front().step;
}

size_t bytes_of_memory(const DeviceChannel& channel) { return cl::Buffer(channel.memory, true).getInfo<CL_MEM_SIZE>(); }

/// Throws Error for a plane that is not what its name says, or does not lie in its buffers.
void check_plane(const DevicePlane& plane, const DeviceFrame& frame, const std::string& what, bool is_result,
                 const Device::Impl& device) {
  const auto refuse = [&](const std::string& why) { throw Error("{}: {}", what, why); };
  const size_t components = plane_kind(plane.name).components.size();
  if (plane.channels.size() != components)
    refuse(fmt::format("{} channels are given; it is made of {}", plane.channels.size(), components));
  const size_t pitch = pitch_of(plane, frame);
  for (const DeviceChannel& channel : plane.channels) {
    if (!channel.memory) refuse("a channel has no memory; give a cl_mem");
    const cl::Buffer buffer(channel.memory, true);
    if (buffer.getInfo<CL_MEM_TYPE>() != CL_MEM_OBJECT_BUFFER) refuse("its memory is an image; buffers are allowed");
    if (buffer.getInfo<CL_MEM_CONTEXT>()() != device.context())
      refuse("its memory is of another context than the queue's");
    if (channel.offset % 4 != 0 || channel.step % 4 != 0 || pitch % 4 != 0 || channel.step == 0)
      refuse(fmt::format("an offset of {}, a step of {} and a pitch of {} bytes are given; multiples of 4 are allowed",
                         channel.offset, channel.step, pitch));
    const cl_mem_flags flags = buffer.getInfo<CL_MEM_FLAGS>();
    if (flags & (is_result ? CL_MEM_READ_ONLY : CL_MEM_WRITE_ONLY))
      refuse(is_result ? "kernels may not write its memory (CL_MEM_READ_ONLY)"
                       : "kernels may not read its memory (CL_MEM_WRITE_ONLY)");
    // Compared by division: sums may be more than a number holds.
    const size_t bytes = bytes_of_memory(channel), columns = size_t(frame.width) - 1, rows = size_t(frame.height) - 1;
    if (channel.offset > bytes || (columns > 0 && channel.step > bytes / columns) || (rows > 0 && pitch > bytes / rows))
      refuse(fmt::format("with an offset of {}, a step of {} and a pitch of {} bytes it ends behind its buffer of {}",
                         channel.offset, channel.step, pitch, bytes));
    const size_t row = columns * channel.step + 4, end = channel.offset + rows * pitch + row;
    if (pitch < row) refuse(fmt::format("a pitch of {} bytes is given; a row takes {}", pitch, row));
    if (end > bytes) refuse(fmt::format("it ends at byte {} of a buffer of {}", end, bytes));
  }
}

void check_planes(const Plan& plan, const DeviceFrame& frame, const Device::Impl& device) {
  for (const DeviceView& view : frame.views) {
    const auto check_list = [&](const std::vector<DevicePlane>& list, const std::vector<std::string>& known,
                                const char* kind) {
      std::set<std::string> seen;
      for (const DevicePlane& plane : list) {
        const std::string what = fmt::format("{} '{}' of view '{}'", kind, plane.name, view.name);
        if (!contains(known, plane.name))
          throw Error("{}: the plan has no such {}{}; it has {}", what, kind, suggestion(plane.name, known),
                      enumerate(known));
        if (!seen.insert(plane.name).second) throw Error("{}: is given twice", what);
        check_plane(plane, frame, what, &list == &view.results, device);
      }
      return seen;
    };
    const std::set<std::string> given = check_list(view.planes, plan.inputs, "plane");
    for (const std::string& name : plan.inputs) {
      if (!given.contains(name)) throw Error("{}: view '{}' has no plane '{}'", plan.technique, view.name, name);
    }
    check_list(view.results, plan.outputs, "result");
  }
}

/// The frame without its planes, as the host's code takes it.
Frame without_planes(const DeviceFrame& device_frame) {
  Frame frame;
  frame.display = frame.window = {0, 0, device_frame.width, device_frame.height};
  for (const DeviceView& given : device_frame.views) {
    View view;
    view.name = given.name;
    view.camera = given.camera;
    view.camera_before = given.camera_before;
    frame.views.push_back(std::move(view));
  }
  return frame;
}

/// Lays the caller's planes into a plan's layouts: in place where they suit, else by copies.
class Placement {
 public:
  Placement(const DeviceFrame& frame, Device::Impl& device)
      : frame_(frame), device_(device), layout_(frame.width, frame.height) {
    alignment_ = device.device.getInfo<CL_DEVICE_MEM_BASE_ADDR_ALIGN>() / 8;
    // The first pitch that suits is that of all planes in place. Much padding would make all other planes as large.
    const int own = layout_.pitch;
    for (const DeviceView& view : frame.views) {
      for (const std::vector<DevicePlane>* list : {&view.planes, &view.results}) {
        for (const DevicePlane& plane : *list) {
          const size_t pitch = pitch_of(plane, frame);
          const bool may_be_in_place = plane.is_clean || list == &view.results;
          if (!may_be_in_place || pitch % lane_bytes != 0 || pitch > 2 * size_t(own) * sizeof(float) ||
              !fits(plane, pitch))
            continue;
          layout_.pitch = int(pitch / sizeof(float));
          return;
        }
      }
    }
  }

  const Layout& layout() const { return layout_; }

  bool suits(const DevicePlane& plane) const {
    return pitch_of(plane, frame_) == size_t(layout_.pitch) * sizeof(float) && fits(plane, pitch_of(plane, frame_));
  }

  /// The plane's own memory, as a plane of the layout.
  std::vector<cl::Buffer> in_place(const DevicePlane& plane) const {
    std::vector<cl::Buffer> buffers;
    for (const DeviceChannel& channel : plane.channels) {
      cl::Buffer whole(channel.memory, true);
      if (channel.offset == guard_bytes && whole.getInfo<CL_MEM_SIZE>() == layout_.bytes()) {
        buffers.push_back(whole);
        continue;
      }
      const cl_buffer_region region = {channel.offset - guard_bytes, layout_.bytes()};
      buffers.push_back(whole.createSubBuffer(0, CL_BUFFER_CREATE_TYPE_REGION, &region));
    }
    return buffers;
  }

  /// A copy of a plane's channel to pixel (0, 0) of a layer of a buffer of the layout, or back.
  void copy(const DevicePlane& plane, size_t channel, const cl::Buffer& own, const Layout& layout, size_t layer,
            bool back) {
    const DeviceChannel& given = plane.channels[channel];
    const Side theirs{given.memory, given.offset / 4, given.step / 4, pitch_of(plane, frame_) / 4};
    const Side ours{own(), layer * layout.count() + layout.index(0, 0), 1, size_t(layout.pitch)};
    if (back)
      copy_pixels(ours, theirs, any_value, frame_.width);
    else
      copy_pixels(theirs, ours, bounds_of(plane_kind(plane.name)), layout.pitch);
  }

  /// A copy between two of the caller's planes.
  void copy(const DevicePlane& from, const DevicePlane& to) {
    for (size_t i = 0; i < from.channels.size(); ++i) {
      const auto side = [&](const DevicePlane& plane) {
        const DeviceChannel& channel = plane.channels[i];
        return Side{channel.memory, channel.offset / 4, channel.step / 4, pitch_of(plane, frame_) / 4};
      };
      copy_pixels(side(from), side(to), bounds_of(plane_kind(from.name)), frame_.width);
    }
  }

 private:
  struct Side {
    cl_mem memory;
    size_t index, step, pitch;  // in pixels of 4 bytes
  };

  /// Whether a plane can be used in place, if its pitch is the layout's.
  bool fits(const DevicePlane& plane, size_t pitch) const {
    return std::all_of(plane.channels.begin(), plane.channels.end(), [&](const DeviceChannel& channel) {
      if (channel.step != sizeof(float) || channel.offset < guard_bytes) return false;
      const size_t begin = channel.offset - guard_bytes, bytes = size_t(frame_.height) * pitch + 2 * guard_bytes;
      const cl::Buffer whole(channel.memory, true);
      const size_t all = whole.getInfo<CL_MEM_SIZE>();
      // A part of a buffer has no parts, and what is only written cannot be filtered.
      const bool is_part = whole.getInfo<CL_MEM_ASSOCIATED_MEMOBJECT>()() != nullptr && bytes != all;
      const bool is_write_only = whole.getInfo<CL_MEM_FLAGS>() & CL_MEM_WRITE_ONLY;
      return begin % alignment_ == 0 && !is_part && !is_write_only && begin + bytes <= all;
    });
  }

  /// `columns`: the width, or with padding the pitch.
  void copy_pixels(const Side& from, const Side& to, const Bounds& bounds, int columns) {
    cl::Kernel kernel(device_.program("resample/copy_pixels.cl", "copy_pixels", arguments_of_copy, "-cl-std=CL1.2"),
                      "copy_pixels");
    cl_uint index = 0;
    for (const Side* side : {&from, &to}) {
      kernel.setArg(index++, sizeof side->memory, &side->memory);
      for (const size_t number : {side->index, side->step, side->pitch}) kernel.setArg(index++, cl_ulong(number));
    }
    kernel.setArg(index++, cl_ulong(frame_.width));
    for (const float bound : {bounds.low, bounds.high, bounds.below, bounds.above, bounds.otherwise, bounds.outside})
      kernel.setArg(index++, bound);
    device_.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(size_t(columns), size_t(frame_.height)));
  }

  const DeviceFrame& frame_;
  Device::Impl& device_;
  Layout layout_;
  size_t alignment_ = 1;
};

const DevicePlane* find(const std::vector<DevicePlane>& planes, const std::string& name) {
  const auto found = std::find_if(planes.begin(), planes.end(), [&](const DevicePlane& p) { return p.name == name; });
  return found == planes.end() ? nullptr : &*found;
}

/// Gives a view its inputs and the memory of its results.
void lay_out(const Plan& plan, const DeviceView& given, Placement& placement, ViewOnDevice& target,
             std::vector<std::string>& copied) {
  std::set<std::string> in_stacks;
  for (const auto& [stack, layers] : plan.stacks) {
    target.buffers.allocate_stack(stack, bytes_of_buffer(plan, target.layouts, stack));
    for (size_t i = 0; i < layers.size(); ++i) {
      placement.copy(*find(given.planes, layers[i]), 0, target.buffers.of(stack).front(), target.layout, i, false);
      in_stacks.insert(layers[i]);
      add_new(copied, layers[i]);
    }
    target.planes.insert(stack);
  }
  for (const DevicePlane& plane : given.planes) {
    if (in_stacks.contains(plane.name)) continue;
    target.planes.insert(plane.name);
    if (plane.is_clean && placement.suits(plane)) {
      target.buffers.adopt(plane.name, placement.in_place(plane));
      continue;
    }
    target.buffers.allocate(plane.name, target.layout);
    for (size_t i = 0; i < plane.channels.size(); ++i)
      placement.copy(plane, i, target.buffers.of(plane.name)[i], target.layout, 0, false);
    add_new(copied, plane.name);
  }
  for (const DevicePlane& result : given.results) {
    if (!contains(plan.inputs, result.name) && placement.suits(result))
      target.buffers.adopt(result.name, placement.in_place(result));
  }
  allocate_computed(plan, target);
}

/// Copies results that could not be computed in place.
void copy_results(const Plan& plan, const DeviceView& given, Placement& placement, ViewOnDevice& target,
                  std::vector<std::string>& copied) {
  for (const DevicePlane& result : given.results) {
    if (const DevicePlane* input = contains(plan.inputs, result.name) ? find(given.planes, result.name) : nullptr) {
      placement.copy(*input, result);
    } else if (!placement.suits(result)) {
      for (size_t i = 0; i < result.channels.size(); ++i)
        placement.copy(result, i, target.buffers.of(result.name)[i], target.layout, 0, true);
    } else {
      continue;
    }
    add_new(copied, result.name);
  }
}

/// Throws Error for results that have no one image of the frame's size.
void check_results(const Plan& plan, const DeviceFrame& frame) {
  const std::map<std::string, int> scales = plane_scales(plan);
  for (const DeviceView& view : frame.views) {
    for (const DevicePlane& result : view.results) {
      const auto scale = scales.find(result.name);
      if (is_stack(result.name) || (scale != scales.end() && scale->second != 1))
        throw Error("result '{}' of view '{}': has {}; gloam::run returns it", result.name, view.name,
                    is_stack(result.name) ? "several layers" : "a lower resolution");
    }
  }
}

/// Throws Error for a result that no pass makes in its view: "multiview" has none for the second.
void check_made(const DeviceView& given, const ViewOnDevice& target) {
  for (const DevicePlane& result : given.results) {
    if (!target.planes.contains(result.name))
      throw Error("result '{}' of view '{}': no pass makes it in this view; leave it out", result.name, given.name);
  }
}

cl::Event enqueue_all(const Plan& plan, const DeviceFrame& frame, const Frame& host, Placement& placement,
                      Device::Impl& device, const RunOptions& options, Enqueued& enqueued) {
  const Layout& layout = placement.layout();
  const size_t together = needs_two_views(plan) ? frame.views.size() : 1;
  for (size_t first = 0; first < frame.views.size(); first += together) {
    std::vector<ViewOnDevice> targets;  // the next ones take the same memory
    unsigned long long bytes = 0;
    for (size_t i = first; i < first + together; ++i) {
      targets.push_back({host, host.views[i], layout, Layouts(plan, layout), Buffers(device, false)});
      lay_out(plan, frame.views[i], placement, targets.back(), enqueued.copied);
      bytes += targets.back().buffers.bytes();
    }
    enqueued.device_bytes = std::max(enqueued.device_bytes, bytes);
    build_passes(plan, targets, device, options);
    for (size_t i = 0; i < together; ++i) check_made(frame.views[first + i], targets[i]);
    enqueue_passes(plan, targets, device, options);
    for (size_t i = 0; i < together; ++i)
      copy_results(plan, frame.views[first + i], placement, targets[i], enqueued.copied);
  }
  cl::Event done;
  device.queue.enqueueMarkerWithWaitList(nullptr, &done);
  device.queue.flush();
  return done;
}

}  // namespace

Device device_of(cl_command_queue queue) {
  const DriverAtWork driver;
  try {
    return Device(impl_of(cl::CommandQueue(queue, true)));
  } catch (const cl::Error& error) {
    throw Error("the queue: {} ({})", error.what(), cl_error_name(error.err()));
  }
}

DeviceLayout device_layout(int width, int height) {
  const Layout layout(width, height);
  return {size_t(layout.pitch) * sizeof(float), guard_bytes, layout.bytes()};
}

Enqueued enqueue(const Plan& plan, const DeviceFrame& frame, Device& device, const RunOptions& options,
                 const std::vector<cl_event>& wait_for) {
  Device::Impl& impl = device.impl();
  const std::lock_guard alone(impl.busy);
  const Frame host = without_planes(frame);
  check_views(plan, host);
  if (looks_into_key_views(plan))
    throw Error("{}: its views look into key views, one after another; gloam::run computes them", plan.technique);
  check_options(plan, impl.info, options);
  if (options.repeat != 1)
    throw UsageError("{}: {} runs are not allowed for planes in a device's memory; 1 is", plan.technique,
                     options.repeat);
  const DriverAtWork driver;
  try {
    check_planes(plan, frame, impl);
    check_results(plan, frame);
    Placement placement(frame, impl);
    check_memory(plan, placement.layout(), frame.views.size(), impl.info);
    if (!wait_for.empty()) {
      std::vector<cl::Event> events;
      for (const cl_event event : wait_for) events.emplace_back(event, true);
      impl.queue.enqueueBarrierWithWaitList(&events);
    }
    impl.pool.begin_run(device_bytes(plan, placement.layout(), frame.views.size()), impl.info.memory);
    Enqueued enqueued;
    cl::Event done = enqueue_all(plan, frame, host, placement, impl, options, enqueued);
    clRetainEvent(done());
    enqueued.done = {done(), [](cl_event event) { clReleaseEvent(event); }};
    return enqueued;
  } catch (const cl::Error& error) {
    throw Error("{} on {}: {} ({})", plan.technique, impl.info.name, error.what(), cl_error_name(error.err()));
  }
}

}  // namespace gloam
