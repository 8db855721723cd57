#include "gloam/run.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <glm/matrix.hpp>
#include <limits>
#include <map>
#include <set>

#include "device_impl.h"
#include "gloam/driver.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "kernel_projection.h"
#include "key_views.h"
#include "lists.h"
#include "mask.h"
#include "plan_buffers.h"
#include "resample.h"

namespace gloam {
namespace {

#define FRAME_SCALAR float
#define FRAME_NAME FrameOfFloats
#define NEIGHBOUR_NAME NeighbourOfFloats
#include "shared/frame.h"
#undef FRAME_SCALAR
#undef FRAME_NAME
#undef NEIGHBOUR_NAME
#define FRAME_SCALAR double
#define FRAME_NAME FrameOfDoubles
#define NEIGHBOUR_NAME NeighbourOfDoubles
#include "shared/frame.h"
#undef FRAME_SCALAR
#undef FRAME_NAME
#undef NEIGHBOUR_NAME
static_assert(Layout::guard == FRAME_GUARD);

/// `layout`: of every `scale`-th pixel. The centre of reduced pixel X is that of pixel X * scale.
template <typename KernelFrame>
KernelFrame kernel_frame(const Frame& frame, const Camera& camera, const Layout& layout, int scale, int seed) {
  using Scalar = decltype(KernelFrame::scale_x);
  const auto centre = [scale](double pixels) { return Scalar((pixels - 0.5) / scale + 0.5); };
  return {layout.width,
          layout.height,
          layout.pitch,
          seed,
          Scalar(scale / camera.fx),
          Scalar(scale / camera.fy),
          centre(camera.cx - frame.window.x0),
          centre(camera.cy - frame.window.y0),
          Scalar(camera.orthographic ? 0 : 1),
          Scalar(camera.orthographic ? 1 : 0)};
}

/// `frame`: of the neighbour. Differences of places are taken in double, so that views far from the origin stay exact.
template <typename KernelNeighbour, typename KernelFrame>
KernelNeighbour kernel_neighbour(const KernelFrame& frame, const Pose& own, const Pose& other) {
  KernelNeighbour n;
  n.frame = frame;
  const glm::dmat3 rotation = other.world_to_view * glm::transpose(own.world_to_view);
  const glm::dvec3 translation = other.world_to_view * (own.position - other.position);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) n.rotation[3 * row + column] = rotation[column][row];
    n.translation[row] = translation[row];
  }
  return n;
}

/// The one scale beside the pass's own among the planes that it binds of its view; 0 where there is none.
int other_scale(const PlannedPass& planned, const Layouts& layouts) {
  int other = 0;
  for (const std::vector<Binding>* list : {&planned.pass.reads, &planned.pass.writes}) {
    for (const Binding& binding : *list) {
      const int scale = layouts.scale_of(binding.plane);
      if (binding.of_other || scale == planned.pass.scale || scale == other) continue;
      if (other != 0)
        throw Error("{}: binds planes of three resolutions (1/{}, 1/{}, 1/{}); two are allowed", planned.label(),
                    planned.pass.scale, other, scale);
      other = scale;
    }
  }
  return other;
}

/// One view's planes on the device. On a device that shares memory the host's own pages are used.
class Buffers {
 public:
  Buffers(Device::Impl& device) : device_(device) {}

  void upload(const Plane& plane) {
    for (const Channel& channel : plane.channels) {
      const cl_mem_flags flags =
          CL_MEM_READ_ONLY | (device_.info.shares_memory ? CL_MEM_USE_HOST_PTR : CL_MEM_COPY_HOST_PTR);
      buffers_[plane.name].emplace_back(device_.context, flags, channel.layout().bytes(),
                                        const_cast<float*>(channel.data()));
    }
  }

  /// One buffer with the layers one after another, each in the layout of any plane.
  void upload_stack(const std::string& name, const std::vector<const Plane*>& layers) {
    const size_t bytes = layers.front()->channels.front().layout().bytes();
    cl::Buffer buffer(device_.context, CL_MEM_READ_ONLY, layers.size() * bytes);
    for (size_t i = 0; i < layers.size(); ++i) {
      device_.queue.enqueueWriteBuffer(buffer, CL_TRUE, i * bytes, bytes, layers[i]->channels.front().data());
    }
    buffers_[name].push_back(std::move(buffer));
  }

  /// Room for a stack that is computed. All of it holds what lies outside, as far as nothing is computed there.
  void allocate_stack(const std::string& name, const Layout& layout, size_t layers) {
    cl::Buffer buffer(device_.context, CL_MEM_READ_WRITE, layers * layout.bytes());
    device_.queue.enqueueFillBuffer(buffer, plane_kind(name).outside, 0, layers * layout.bytes());
    buffers_[name].push_back(std::move(buffer));
  }

  void allocate(const std::string& name, const Layout& layout) {
    const PlaneKind kind = plane_kind(name);
    for (size_t i = 0; i < kind.components.size(); ++i) {
      if (device_.info.shares_memory) {
        Channel channel(layout);
        channel.fill_padding(kind.outside);
        buffers_[name].emplace_back(device_.context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, layout.bytes(),
                                    channel.data());
        host_[name].push_back(std::move(channel));
      } else {
        cl::Buffer buffer(device_.context, CL_MEM_READ_WRITE, layout.bytes());
        const size_t guard = Layout::guard * sizeof(float);
        device_.queue.enqueueFillBuffer(buffer, kind.outside, 0, guard);
        device_.queue.enqueueFillBuffer(buffer, kind.outside, layout.bytes() - guard, guard);
        buffers_[name].push_back(std::move(buffer));
      }
    }
  }

  std::vector<cl::Buffer>& of(const std::string& name) { return buffers_.at(name); }

  /// Layers of a computed stack, as planes of their own.
  std::vector<Plane> download_stack(const std::string& name, const Layout& layout, size_t layers) {
    std::vector<Plane> planes;
    const PlaneKind kind = plane_kind(name);
    for (size_t i = 0; i < layers; ++i) {
      Plane plane{layer_name(name, int(i)), {}};
      Channel& channel = plane.channels.emplace_back(layout);
      device_.queue.enqueueReadBuffer(buffers_.at(name).front(), CL_TRUE, i * layout.bytes(), layout.bytes(),
                                      channel.data());
      channel.fill_padding(kind.outside);
      planes.push_back(std::move(plane));
    }
    return planes;
  }

  /// Bits of what is wanted (shared/wanted.h), in a plane's memory.
  Channel download_bits(const std::string& name, const Layout& layout) {
    Channel bits(layout);
    device_.queue.enqueueReadBuffer(buffers_.at(name).front(), CL_TRUE, 0, layout.bytes(), bits.data());
    return bits;
  }

  /// How many pixels a list has (shared/pixel_list.h): the first number of the plane's memory.
  int length_of_list(const std::string& name) {
    cl_int length = 0;
    device_.queue.enqueueReadBuffer(buffers_.at(name).front(), CL_TRUE, 0, sizeof length, &length);
    return length;
  }

  /// Takes a computed plane back to the host; it is no longer on the device then.
  Plane download(const std::string& name, const Layout& layout) {
    const PlaneKind kind = plane_kind(name);
    Plane plane{name, {}};
    for (size_t i = 0; i < kind.components.size(); ++i) {
      cl::Buffer& buffer = buffers_.at(name)[i];
      if (device_.info.shares_memory) {
        // Mapped, the device's result is what the host sees.
        void* mapped = device_.queue.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_READ, 0, layout.bytes());
        device_.queue.enqueueUnmapMemObject(buffer, mapped);
        plane.channels.push_back(std::move(host_.at(name)[i]));
      } else {
        Channel channel(layout);
        device_.queue.enqueueReadBuffer(buffer, CL_TRUE, 0, layout.bytes(), channel.data());
        plane.channels.push_back(std::move(channel));
      }
    }
    device_.queue.finish();
    buffers_.erase(name);  // before the host touches the pages that it used
    for (Channel& channel : plane.channels) channel.fill_padding(kind.outside);
    return plane;
  }

 private:
  Device::Impl& device_;
  std::map<std::string, std::vector<Channel>> host_;  // outlives the buffers that use its pages
  std::map<std::string, std::vector<cl::Buffer>> buffers_;
};

std::string build_options(const PlannedPass& planned, const Device::Impl& device, const RunOptions& options,
                          int lanes) {
  std::string text = fmt::format("-cl-std=CL1.2 -cl-kernel-arg-info -D LANES={}", lanes);
  if (options.math == Math::fast) text += " -D MATH_FAST=1";
  if (options.math == Math::precise && device.info.rounds_correctly) text += " -cl-fp32-correctly-rounded-divide-sqrt";
  if (options.real == Real::float64) text += " -D REAL_DOUBLE=1";
  if (options.gathers_only) text += " -D GATHERS_ONLY=1";
  for (const auto& [name, value] : planned.pass.defines) text += fmt::format(" -D {}={}", name, value);
  return text;
}

bool reads_other_view(const Pass& pass) {
  return std::any_of(pass.reads.begin(), pass.reads.end(), [](const Binding& b) { return b.of_other; });
}

/// Argument names that the declaration promises.
std::vector<std::string> declared_arguments(const PlannedPass& planned, const Layouts& layouts) {
  std::vector<std::string> names = {"frame"};
  if (other_scale(planned, layouts) != 0) names.push_back("other");
  if (reads_other_view(planned.pass) || planned.pass.from_frame_before) names.push_back("neighbour");
  if (planned.pass.projects) names.push_back("projections");
  if (!planned.technique->parameters.empty()) names.push_back("params");
  for (const auto& [argument, unused] : planned.pass.tables) names.push_back(argument);
  for (const std::vector<Binding>* list : {&planned.pass.reads, &planned.pass.writes}) {
    for (const Binding& binding : *list) {
      for (const std::string& component : plane_kind(binding.plane).components) {
        names.push_back(component.empty() ? binding.argument : binding.argument + "_" + component);
      }
    }
  }
  return names;
}

/// The kernel's own argument names; empty where the driver does not tell.
std::vector<std::string> kernel_arguments(const cl::Kernel& kernel) {
  std::vector<std::string> names;
  try {
    for (cl_uint i = 0; i < kernel.getInfo<CL_KERNEL_NUM_ARGS>(); ++i) {
      std::string name = kernel.getArgInfo<CL_KERNEL_ARG_NAME>(i);
      while (!name.empty() && name.back() == '\0') name.pop_back();
      names.push_back(name);
    }
  } catch (const cl::Error&) {
    return {};
  }
  return names;
}

cl::Kernel build_kernel(const PlannedPass& planned, const Layouts& layouts, Device::Impl& device,
                        const RunOptions& options, int lanes) {
  cl::Program& program = device.program(planned.technique->source, build_options(planned, device, options, lanes));
  cl::Kernel kernel;
  try {
    kernel = cl::Kernel(program, planned.pass.kernel.c_str());
  } catch (const cl::Error& error) {
    restart_without_kept_kernels();  // a kept program that is damaged may have lost them
    throw Error("{}: kernels/{} has no kernel '{}' ({})", planned.label(), planned.technique->source,
                planned.pass.kernel, cl_error_name(error.err()));
  }
  const std::vector<std::string> declared = declared_arguments(planned, layouts), actual = kernel_arguments(kernel);
  if (!actual.empty() && declared != actual) {
    throw Error("{}: the pass declares ({}), kernel '{}' takes ({})", planned.label(), fmt::join(declared, ", "),
                planned.pass.kernel, fmt::join(actual, ", "));
  }
  return kernel;
}

/// One view: its image, and its planes on the device.
struct Target {
  const Frame& frame;
  const View& view;
  Layout layout;
  Layouts layouts;
  Buffers buffers;
  Pass::Views on = Pass::Views::key;     // whether others look into it, or it into others
  std::set<std::string> planes = {};     // at hand: inputs, and what passes make here
  std::vector<cl::Kernel> kernels = {};  // of the passes that run here
  std::vector<cl::Buffer> numbers = {};  // projections and tables that they read
  std::vector<size_t> passes = {};       // which these are
  std::vector<PassTime> times = {};      // of each
};

/// The views that a target's passes may look into; null where there is none.
struct Others {
  Target* other = nullptr;                    // of two
  Target *nearest = nullptr, *far = nullptr;  // key views
  double share_of_far = 0;                    // where both show a point
  Target* of(const Binding& binding) const {
    if (binding.of_key > 0) return binding.of_key == 1 ? nearest : far;
    return binding.of_other ? other : nullptr;
  }
};

template <typename KernelFrame>
KernelFrame frame_of(const Target& target, int scale, int seed) {
  return kernel_frame<KernelFrame>(target.frame, *target.view.camera, reduced(target.layout, scale), scale, seed);
}

void set_frame(cl::Kernel& kernel, cl_uint index, const Target& target, int scale, const RunOptions& options) {
  if (options.real == Real::float64)
    kernel.setArg(index, frame_of<FrameOfDoubles>(target, scale, options.seed));
  else
    kernel.setArg(index, frame_of<FrameOfFloats>(target, scale, options.seed));
}

/// Of the resolution of the planes that are bound of it.
void set_neighbour(cl::Kernel& kernel, cl_uint index, const PlannedPass& planned, const Target& target,
                   const Target& other, const RunOptions& options) {
  const auto binding =
      std::find_if(planned.pass.reads.begin(), planned.pass.reads.end(), [](const Binding& b) { return b.of_other; });
  const int scale = other.layouts.scale_of(binding->plane);
  const Pose &from = *target.view.camera->pose, &to = *other.view.camera->pose;
  if (options.real == Real::float64)
    kernel.setArg(index,
                  kernel_neighbour<NeighbourOfDoubles>(frame_of<FrameOfDoubles>(other, scale, options.seed), from, to));
  else
    kernel.setArg(index,
                  kernel_neighbour<NeighbourOfFloats>(frame_of<FrameOfFloats>(other, scale, options.seed), from, to));
}

/// From a view to where its camera was in the frame before; without both poses to nowhere.
template <typename KernelNeighbour, typename KernelFrame>
KernelNeighbour neighbour_before(const Target& target, int scale, int seed) {
  const Camera& now = *target.view.camera;
  const Camera& before = target.view.camera_before.value_or(now);
  const KernelFrame frame = kernel_frame<KernelFrame>(target.frame, before, reduced(target.layout, scale), scale, seed);
  if (target.view.camera_before && now.pose && before.pose)
    return kernel_neighbour<KernelNeighbour>(frame, *now.pose, *before.pose);
  KernelNeighbour nowhere = kernel_neighbour<KernelNeighbour>(frame, Pose(), Pose());
  std::fill_n(nowhere.translation, 3, std::numeric_limits<decltype(frame.scale_x)>::quiet_NaN());
  return nowhere;
}

void set_neighbour_before(cl::Kernel& kernel, cl_uint index, const PlannedPass& planned, const Target& target,
                          const RunOptions& options) {
  const int scale = planned.pass.scale;
  if (options.real == Real::float64)
    kernel.setArg(index, neighbour_before<NeighbourOfDoubles, FrameOfDoubles>(target, scale, options.seed));
  else
    kernel.setArg(index, neighbour_before<NeighbourOfFloats, FrameOfFloats>(target, scale, options.seed));
}

template <typename Number>
cl::Buffer constants(Device::Impl& device, const std::vector<Number>& numbers) {
  return {device.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, numbers.size() * sizeof(Number),
          const_cast<Number*>(numbers.data())};
}

/// The view's own, then those of the key views.
cl::Buffer projections_of(Device::Impl& device, const Plan& plan, const PlannedPass& planned, const Target& target,
                          const Others& others, const RunOptions& options) {
  const bool are_computed = !contains(plan.inputs, "position");
  std::vector<ProjectionOfDoubles> projections;
  for (const Target* to :
       {&target, static_cast<const Target*>(others.nearest), static_cast<const Target*>(others.far)}) {
    if (to)
      projections.push_back(kernel_projection(target.frame, target.view, to->view, planned.pass.scale, are_computed));
  }
  if (projections.size() == 3) {
    projections[1].share = 1 - others.share_of_far;
    projections[2].share = others.share_of_far;
  }
  if (options.real == Real::float64) return constants(device, projections);
  std::vector<ProjectionOfFloats> floats;
  for (const ProjectionOfDoubles& projection : projections) floats.push_back(in_floats(projection));
  return constants(device, floats);
}

void set_arguments(cl::Kernel& kernel, const Plan& plan, const PlannedPass& planned, Device::Impl& device,
                   Target& target, const Others& others, const RunOptions& options) {
  cl_uint index = 0;
  set_frame(kernel, index++, target, planned.pass.scale, options);
  if (const int scale = other_scale(planned, target.layouts)) set_frame(kernel, index++, target, scale, options);
  if (reads_other_view(planned.pass))
    set_neighbour(kernel, index++, planned, target, *others.other, options);
  else if (planned.pass.from_frame_before)
    set_neighbour_before(kernel, index++, planned, target, options);
  const auto set_numbers = [&](cl::Buffer buffer) {
    kernel.setArg(index++, buffer);
    target.numbers.push_back(std::move(buffer));
  };
  if (planned.pass.projects) set_numbers(projections_of(device, plan, planned, target, others, options));
  if (planned.values.size() > 0) kernel.setArg(index++, planned.values.size(), planned.values.bytes());
  for (const auto& [unused, table] : planned.pass.tables) set_numbers(constants(device, table));
  for (const std::vector<Binding>* list : {&planned.pass.reads, &planned.pass.writes}) {
    for (const Binding& binding : *list) {
      Target& from = others.of(binding) ? *others.of(binding) : target;
      for (cl::Buffer& buffer : from.buffers.of(binding.plane)) kernel.setArg(index++, buffer);
    }
  }
}

size_t largest_divisor(size_t number, size_t most) {
  while (number % most != 0) --most;
  return most;
}

/// A CPU's driver compiles a kernel anew for every size of work-group, and left alone takes a size for each size of image,
/// for small ones the whole of it: that costs seconds, and what each item keeps overflows the stack. So there is one size
/// for all small images, and few for large ones. Other devices choose for themselves.
cl::NDRange group_size(const DeviceInfo& info, size_t columns, size_t rows) {
  if (info.type != "cpu") return cl::NullRange;
  constexpr size_t few_items = 1 << 14, most_per_group = 16;
  if (columns * rows < few_items) return cl::NDRange(1, 1);
  const size_t width = largest_divisor(columns, most_per_group);
  return cl::NDRange(width, largest_divisor(rows, most_per_group / width));
}

/// Where a pass looks around, a CPU computes the image strip by strip, each from top to bottom, so that what is read
/// around the pixels at work stays in the cache of their core: rows as wide as the image are slower by 5 to 30 %. Passes
/// that stream lose as much by it, and other devices need no help. Work-items of a strip: a multiple of the group's.
size_t columns_of_strip(const DeviceInfo& info, const Pass& pass, size_t columns, const cl::NDRange& group, int lanes) {
  constexpr size_t pixels = 480;  // half to twice as many do as well
  if (info.type != "cpu" || !pass.looks_around) return columns;
  return group[0] * std::max(size_t(1), pixels / (group[0] * size_t(lanes)));
}

/// Milliseconds that a launch took, by its events; by the wall clock where the device has no timestamps.
double launch(Device::Impl& device, cl::Kernel& kernel, const Pass& pass, const Layout& layout, int lanes) {
  const auto start = std::chrono::steady_clock::now();
  const size_t columns = size_t(layout.pitch / lanes), rows = size_t(layout.height);
  const cl::NDRange group = group_size(device.info, columns, rows);
  const size_t strip = columns_of_strip(device.info, pass, columns, group, lanes);
  cl::Event first, last;
  for (size_t from = 0; from < columns; from += strip)
    device.queue.enqueueNDRangeKernel(kernel, cl::NDRange(from, 0), cl::NDRange(std::min(strip, columns - from), rows),
                                      group, nullptr, from == 0 ? &first : &last);
  if (strip >= columns) last = first;
  last.wait();
  const double wall = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  for (const cl::Event& event : {first, last}) {
    const cl_int status = event.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>();
    if (status < 0) throw cl::Error(status, "kernel execution");
  }
  if (!device.info.has_timestamps) return wall;
  const cl_ulong from = first.getProfilingInfo<CL_PROFILING_COMMAND_START>();
  const cl_ulong to = last.getProfilingInfo<CL_PROFILING_COMMAND_END>();
  return to > from ? double(to - from) * 1e-6 : wall;
}

int lanes_for(const DeviceInfo& info, const RunOptions& options) {
  if (options.lanes != 0) return options.lanes;
  return options.real == Real::float64 && info.lanes > 4 ? info.lanes / 2 : info.lanes;
}

std::string mebibytes(unsigned long long bytes) { return fmt::format("{} MiB", (bytes + (1 << 20) - 1) >> 20); }

void check_memory(const Plan& plan, const Layout& layout, size_t views, const DeviceInfo& info) {
  const unsigned long long needed = device_bytes(plan, layout, views);
  if (needed > info.memory) {
    throw Error("{}: {}x{} pixels need {} of device memory, and {} has {}; use a smaller frame or another --device",
                plan.technique, layout.width, layout.height, mebibytes(needed), info.name, mebibytes(info.memory));
  }
  if (layout.count() > size_t(std::numeric_limits<int>::max())) {
    throw Error("{}: {}x{} pixels with rows padded to {} are more than 2^31; use a smaller frame", plan.technique,
                layout.width, layout.height, layout.pitch);
  }
  const Layouts layouts(plan, layout);
  for (const std::string& name : planes_of(plan)) {
    const size_t layers = layers_in_buffer(plan, name);
    const unsigned long long bytes = layers * layouts.of(name).bytes();
    if (bytes <= info.largest_buffer) continue;
    const std::string what = layers == 1 ? "one plane" : fmt::format("'{}', {} layers", name, layers);
    throw Error(
        "{}: {} of {}x{} pixels takes {}, and {} allows {} for one buffer; use a smaller frame or another --device",
        plan.technique, what, layout.width, layout.height, mebibytes(bytes), info.name, mebibytes(info.largest_buffer));
  }
}

void check_real(const Plan& plan, const DeviceInfo& info, const RunOptions& options) {
  if (options.real == Real::float64 && !info.has_double) {
    throw Error("{}: {} has no double precision; use --real float or another --device", plan.technique, info.name);
  }
}

const Plane& input_plane(const Plan& plan, const View& view, const std::string& name, const Layout& layout) {
  const Plane* plane = view.find(name);
  if (!plane) throw Error("{}: view '{}' has no plane '{}'", plan.technique, view.name, name);
  if (plane->channels.front().layout() != layout)
    throw Error("{}: plane '{}' is not the size of the frame", plan.technique, name);
  return *plane;
}

/// Brings the inputs to the device, and makes room for what is computed.
void fill(Target& target, const Plan& plan) {
  std::map<std::string, const Plane*> inputs;
  for (const std::string& name : plan.inputs) inputs[name] = &input_plane(plan, target.view, name, target.layout);
  for (const std::string& name : planes_of(plan)) {
    if (const auto stack = plan.stacks.find(name); stack != plan.stacks.end()) {
      std::vector<const Plane*> layers;
      for (const std::string& layer : stack->second) layers.push_back(inputs.at(layer));
      target.buffers.upload_stack(name, layers);
      target.planes.insert(name);
    } else if (const auto input = inputs.find(name); input != inputs.end()) {
      target.buffers.upload(*input->second);
      target.planes.insert(name);
    } else if (const size_t layers = layers_in_buffer(plan, name); layers > 1 || is_stack(name)) {
      target.buffers.allocate_stack(name, target.layouts.of(name), layers);
    } else {
      target.buffers.allocate(name, target.layouts.of(name));
    }
  }
}

/// Whether a pass runs on a view: it is meant for it, and what it reads of it is there.
bool runs_on(const PlannedPass& planned, const Target& target, size_t number) {
  if (planned.pass.view >= 0 && size_t(planned.pass.view) != number) return false;
  if (planned.pass.on != Pass::Views::every && planned.pass.on != target.on) return false;
  return std::all_of(planned.pass.reads.begin(), planned.pass.reads.end(),
                     [&](const Binding& b) { return b.of_other || b.of_key > 0 || target.planes.count(b.plane) > 0; });
}

void add_kernel(const Plan& plan, size_t k, Target& target, const Others& others, Device::Impl& device,
                const RunOptions& options, int lanes) {
  const PlannedPass& planned = plan.passes[k];
  target.kernels.push_back(build_kernel(planned, target.layouts, device, options, lanes));
  set_arguments(target.kernels.back(), plan, planned, device, target, others, options);
  target.passes.push_back(k);
  target.times.push_back({target.view.name, planned.label(), {}});
  for (const Binding& written : planned.pass.writes) target.planes.insert(written.plane);
}

/// Finds out which passes run on which views, and builds their kernels.
void add_kernels(const Plan& plan, std::vector<Target>& targets, Device::Impl& device, const RunOptions& options,
                 int lanes) {
  for (size_t k = 0; k < plan.passes.size(); ++k) {
    for (size_t i = 0; i < targets.size(); ++i) {
      const Others others{.other = targets.size() == 2 ? &targets[1 - i] : nullptr};
      if (runs_on(plan.passes[k], targets[i], i)) add_kernel(plan, k, targets[i], others, device, options, lanes);
    }
  }
}

/// Every pass on all views before the next one: it may read what the other view made.
template <typename Function>
void for_each_launch(const Plan& plan, std::vector<Target>& targets, const Function& function) {
  std::vector<size_t> next(targets.size(), 0);
  for (size_t k = 0; k < plan.passes.size(); ++k) {
    for (size_t i = 0; i < targets.size(); ++i) {
      Target& target = targets[i];
      if (next[i] < target.passes.size() && target.passes[next[i]] == k) function(target, next[i]++);
    }
  }
}

/// The outputs that this view has: computed here, or inputs. A plane that the view came with and no pass makes here is no
/// result of it.
void download(const Plan& plan, Target& target, View& out) {
  for (const std::string& name : plan.outputs) {
    const bool is_input = contains(plan.inputs, name);
    if (!is_input && target.planes.count(name) == 0) continue;
    if (is_stack(name)) {
      for (Plane& plane : target.buffers.download_stack(name, target.layouts.of(name), layers_in_buffer(plan, name)))
        out.planes.emplace(plane.name, std::move(plane));
      continue;
    }
    out.planes.emplace(
        name, is_input ? target.view.find(name)->clone() : target.buffers.download(name, target.layouts.of(name)));
  }
}

/// Pixels that a mask lets an estimate skip, and that a second one sees to, of all that there are.
struct Counted {
  double skipped = 0, rest = 0, of = 0;
};

/// Pixels in rows of lanes of which a plane of bits names at least one.
double pixels_in_rows(Target& target, const std::string& bits_name, int lanes) {
  const uint32_t row_of_lanes = uint32_t((1ull << lanes) - 1);
  const Layout layout = target.layouts.of(bits_name);
  const Channel bits = target.buffers.download_bits(bits_name, layout);
  double pixels = 0;
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; x += lanes) {
      const uint32_t word = std::bit_cast<uint32_t>(bits.at(x / 32, y));
      if ((word >> (x % 32) & row_of_lanes) != 0) pixels += std::min(lanes, layout.width - x);
    }
  }
  return pixels;
}

/// `in_full`: the estimate skips nothing, since others look into it.
void count(const Plan& plan, Target& target, int lanes, bool in_full, Counted& counted) {
  const Layout layout = target.layouts.of(plan.wanted);
  const double all = double(layout.width) * layout.height;
  counted.of += all;
  if (!plan.wanted.empty() && !in_full) counted.skipped += all - pixels_in_rows(target, plan.wanted, lanes);
  if (!plan.rest.empty()) counted.rest += pixels_in_rows(target, plan.rest, lanes);
}

void count_listed(const Plan& plan, Target& target, std::map<std::string, long long>& listed) {
  std::set<std::string> lists;
  for (const size_t k : target.passes) {
    for (const Binding& written : plan.passes[k].pass.writes) {
      if (written.starts_empty) lists.insert(written.plane);
    }
  }
  for (const std::string& list : lists) listed[list] += target.buffers.length_of_list(list);
}

/// Runs pass `k` of a target's once. `counts`: its time is kept.
void launch_once(const Plan& plan, Target& target, size_t k, Device::Impl& device, int lanes, bool counts) {
  const PlannedPass& planned = plan.passes[target.passes[k]];
  try {
    constexpr cl_int nothing = 0;
    for (const Binding& written : planned.pass.writes) {
      if (written.starts_empty)
        device.queue.enqueueFillBuffer(target.buffers.of(written.plane).front(), nothing, 0, sizeof nothing);
    }
    const double ms =
        launch(device, target.kernels[k], planned.pass, reduced(target.layout, planned.pass.scale), lanes);
    if (counts) target.times[k].ms.push_back(ms);
  } catch (const cl::Error& error) {
    throw Error("{} on {}: {} ({})", planned.label(), device.info.name, error.what(), cl_error_name(error.err()));
  }
}

/// What a view comes to, and what it took.
void collect(const Plan& plan, Target& target, RunResult& result) {
  View out{.name = target.view.name,
           .camera = target.view.camera,
           .origin = position_origin(target.view, !contains(plan.inputs, "position")),
           .planes = {}};
  count_listed(plan, target, result.listed);
  download(plan, target, out);
  // A view that is only looked into has no result of its own.
  if (!out.planes.empty()) result.frame.views.push_back(std::move(out));
  for (PassTime& time : target.times) result.passes.push_back(std::move(time));
}

Target target_of(const Plan& plan, const Frame& frame, const View& view, Device::Impl& device) {
  const Layout layout(frame.width(), frame.height());
  Target target{frame, view, layout, Layouts(plan, layout), Buffers(device)};
  fill(target, plan);
  return target;
}

/// Views that are on the device together.
void run_views(const Plan& plan, const Frame& frame, const std::vector<const View*>& views, Device::Impl& device,
               const RunOptions& options, int lanes, RunResult& result, Counted& counted) {
  std::vector<Target> targets;
  for (const View* view : views) targets.push_back(target_of(plan, frame, *view, device));
  add_kernels(plan, targets, device, options, lanes);
  size_t launches = 0, done = 0;
  for (const Target& target : targets) launches += target.kernels.size();
  const int warm_ups = options.repeat > 1 ? 1 : 0;
  for (int i = -warm_ups; i < options.repeat; ++i) {
    for_each_launch(plan, targets, [&](Target& target, size_t k) {
      launch_once(plan, target, k, device, lanes, i >= 0);
      if (options.progress) options.progress(int(++done), int(launches) * (options.repeat + warm_ups));
    });
  }
  for (Target& target : targets) {
    count(plan, target, lanes, false, counted);
    collect(plan, target, result);
  }
}

/// Runs a frame's views one after another, of which some are key views that others look into. Of these no more are on the device
/// than are looked into from where the run has come to.
class KeyViewsRun {
 public:
  KeyViewsRun(const Plan& plan, const Frame& frame, int spacing, Device::Impl& device, const RunOptions& options,
              int lanes, Counted& counted)
      : plan_(plan),
        frame_(frame),
        device_(device),
        options_(options),
        lanes_(lanes),
        counted_(counted),
        roles_(key_view_roles(int(frame.views.size()), spacing)),
        results_(frame.views.size()) {
    for (const KeyViewRole& role : roles_) {
      for (const PlannedPass& planned : plan.passes)
        launches_ += planned.pass.on == Pass::Views::every || planned.pass.on == kind_of(role);
    }
  }

  void run(RunResult& result) {
    for (size_t i = 0; i < roles_.size(); ++i) {
      const KeyViewRole& role = roles_[i];
      if (role.is_key)
        key(i);
      else
        between(i, key(size_t(role.nearest)), key(size_t(role.far)));
      // Views come in order: no later one looks into key views before these.
      release_before(role.is_key ? i : size_t(std::min(role.nearest, role.far)));
    }
    release_before(roles_.size());
    for (RunResult& own : results_) {
      std::move(own.frame.views.begin(), own.frame.views.end(), std::back_inserter(result.frame.views));
      std::move(own.passes.begin(), own.passes.end(), std::back_inserter(result.passes));
      for (const auto& [list, length] : own.listed) result.listed[list] += length;
    }
  }

 private:
  static Pass::Views kind_of(const KeyViewRole& role) { return role.is_key ? Pass::Views::key : Pass::Views::between; }

  Target& key(size_t i) {
    const auto known = keys_.find(i);
    if (known != keys_.end()) return known->second;
    Target& target = keys_.emplace(i, target_of(plan_, frame_, frame_.views[i], device_)).first->second;
    compute(target, {});
    return target;
  }

  void between(size_t i, Target& nearest, Target& far) {
    const auto steps_to = [i](int key) { return std::abs(double(i) - double(key)); };
    const double to_nearest = steps_to(roles_[i].nearest), to_far = steps_to(roles_[i].far);
    Target target = target_of(plan_, frame_, frame_.views[i], device_);
    target.on = kind_of(roles_[i]);
    const double share_of_far = &nearest == &far ? 0 : to_nearest / (to_nearest + to_far);
    compute(target, {.nearest = &nearest, .far = &far, .share_of_far = share_of_far});
    collect(plan_, target, results_[i]);
  }

  void compute(Target& target, const Others& others) {
    for (size_t k = 0; k < plan_.passes.size(); ++k) {
      if (runs_on(plan_.passes[k], target, 0)) add_kernel(plan_, k, target, others, device_, options_, lanes_);
    }
    const int warm_ups = options_.repeat > 1 ? 1 : 0;
    for (int i = -warm_ups; i < options_.repeat; ++i) {
      for (size_t k = 0; k < target.kernels.size(); ++k) {
        launch_once(plan_, target, k, device_, lanes_, i >= 0);
        if (options_.progress) options_.progress(++done_, launches_ * (options_.repeat + warm_ups));
      }
    }
    count(plan_, target, lanes_, target.on == Pass::Views::key, counted_);
  }

  void release_before(size_t end) {
    while (!keys_.empty() && keys_.begin()->first < end) {
      collect(plan_, keys_.begin()->second, results_[keys_.begin()->first]);
      keys_.erase(keys_.begin());
    }
  }

  const Plan& plan_;
  const Frame& frame_;
  Device::Impl& device_;
  const RunOptions& options_;
  int lanes_, launches_ = 0, done_ = 0;  // launches: of each repeat
  Counted& counted_;
  std::vector<KeyViewRole> roles_;
  std::vector<RunResult> results_;  // view by view
  std::map<size_t, Target> keys_;   // on the device
};

void check_two_views(const Plan& plan, const Frame& frame) {
  if (frame.views.size() != 2)
    throw Error(
        "{}: needs a frame of two views, and this one has {}; gloam capture --view2 ANGLE or --stereo IPD makes one, "
        "--views A,B takes two of more",
        plan.technique, frame.views.size());
}

/// Of views that look into one another.
void check_poses(const Plan& plan, const Frame& frame) {
  for (const View& view : frame.views) {
    if (!view.camera->pose)
      throw Error(
          "{}: view '{}' has a camera without a pose, so nothing tells where it stands beside the {}; give "
          "camera_to_world in a --camera file",
          plan.technique, view.name, frame.views.size() > 2 ? "others" : "other");
  }
}

/// The technique that the plan is named after, if it runs.
const Technique* leading_technique(const Plan& plan) {
  for (const PlannedPass& planned : plan.passes) {
    if (planned.technique->name == plan.technique) return planned.technique;
  }
  return nullptr;
}

/// Of a view that is no camera's with an eye. Who asked for a technique that can see it has asked for more, or lacks a plane.
[[noreturn]] void refuse_module(const Plan& plan, const Technique& refusing, const View& view) {
  const std::string what =
      fmt::format("view '{}' is of a light-field display's module, whose rays meet in no eye", view.name);
  const Technique* leading = leading_technique(plan);
  if (!leading || !leading->any_projection) {
    std::vector<std::string> able;
    for (const Technique& technique : registry()) {
      if (technique.any_projection && technique.key_views) able.push_back(technique.name);
    }
    throw Error("{}: {}; {} compute such views", refusing.name, what, enumerate(able));
  }
  for (const std::string& plane : refusing.writes) {
    if (contains(leading->reads, plane))
      throw Error("{}: {}, and {} needs one; give a frame with {}", leading->name, what, refusing.name, plane);
  }
  // What is no technique for anyone to ask for is the plan's own.
  const bool is_asked_for = contains(technique_names(), refusing.name);
  throw Error("{}: {}, and {} needs one; leave it out", leading->name, what,
              is_asked_for ? refusing.name : "what --resolution or --adaptive adds");
}

/// What a view has to have for the plan's passes to make sense of it.
void check_projections(const Plan& plan, const Frame& frame) {
  const bool reads_positions = contains(plan.inputs, "position");
  for (const View& view : frame.views) {
    if (reads_positions && !view.camera->pose)
      throw Error(
          "{}: positions of view '{}' are the world's, and nothing tells where its camera stands; --plane "
          "position=none has them made from depth",
          plan.technique, view.name);
    if (!view.camera->slits) continue;
    for (const PlannedPass& planned : plan.passes) {
      if (!planned.technique->any_projection) refuse_module(plan, *planned.technique, view);
    }
  }
}

/// Together where they look at one another, else one after another.
void run_all_views(const Plan& plan, const Frame& frame, Device::Impl& device, const RunOptions& options,
                   RunResult& result, Counted& counted) {
  if (const int spacing = key_view_spacing(plan, frame.views.size()); spacing > 1) {
    KeyViewsRun(plan, frame, spacing, device, options, result.lanes, counted).run(result);
    return;
  }
  std::vector<std::vector<const View*>> groups(needs_two_views(plan) ? 1 : frame.views.size());
  for (size_t i = 0; i < frame.views.size(); ++i) groups[std::min(i, groups.size() - 1)].push_back(&frame.views[i]);
  for (const std::vector<const View*>& views : groups)
    run_views(plan, frame, views, device, options, result.lanes, result, counted);
}

}  // namespace

void check(const Plan& plan, const Layout& layout, size_t views, const Device& device, const RunOptions& options) {
  check_real(plan, device.info(), options);
  check_memory(plan, layout, views, device.info());
}

void prepare(const Plan& plan, Device& device, const RunOptions& options) {
  const DriverAtWork driver;
  Device::Impl& impl = device.impl();
  const Layouts layouts(plan, Layout(1, 1));
  for (const PlannedPass& planned : plan.passes)
    build_kernel(planned, layouts, impl, options, lanes_for(impl.info, options));
}

RunResult run(const Plan& plan, const Frame& frame, Device& device, const RunOptions& options) {
  Device::Impl& impl = device.impl();
  const Layout layout(frame.width(), frame.height());
  check(plan, layout, frame.views.size(), device, options);
  RunResult result;
  result.lanes = lanes_for(impl.info, options);
  result.device_bytes = device_bytes(plan, layout, frame.views.size());
  result.frame.display = frame.display;
  result.frame.window = frame.window;
  result.frame.pixel_aspect = frame.pixel_aspect;
  result.frame.assumed = frame.assumed;
  for (const View& view : frame.views) {
    if (!view.camera) throw Error("{}: view '{}' has no camera", plan.technique, view.name);
  }
  check_projections(plan, frame);
  if (needs_two_views(plan)) check_two_views(plan, frame);
  if (needs_two_views(plan) || key_view_spacing(plan, frame.views.size()) > 1) check_poses(plan, frame);
  Counted counted;
  const DriverAtWork driver;
  try {
    run_all_views(plan, frame, impl, options, result, counted);
  } catch (const cl::Error& error) {
    throw Error("{} on {}: {} ({})", plan.technique, impl.info.name, error.what(), cl_error_name(error.err()));
  }
  if (counted.of > 0) {
    result.skipped_share = counted.skipped / counted.of;
    result.rest_share = counted.rest / counted.of;
  }
  result.total_ms.assign(size_t(std::max(options.repeat, 0)), 0.0);
  for (const PassTime& pass : result.passes) {
    for (size_t i = 0; i < pass.ms.size(); ++i) result.total_ms[i] += pass.ms[i];
  }
  return result;
}

}  // namespace gloam
