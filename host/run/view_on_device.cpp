#include "run/view_on_device.h"

#include <limits>
#include <map>
#include <utility>

#include "base/lists.h"
#include "frame/check.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "plan/lifetimes.h"

namespace gloam {
namespace {

const Plane& input_plane(const Plan& plan, const Frame& frame, const View& view, const std::string& name) {
  const Plane* plane = view.find(name);
  if (!plane) throw Error("{}: view '{}' has no plane '{}'", plan.technique, view.name, name);
  check(*plane, frame);
  return *plane;
}

void upload_inputs(const Plan& plan, ViewOnDevice& target, Device::Impl& device, Uploads* uploads) {
  std::map<std::string, const Plane*> inputs;
  for (const std::string& name : plan.inputs) inputs[name] = &input_plane(plan, target.frame, target.view, name);
  for (const std::string& name : planes_of(plan)) {
    if (const auto stack = plan.stacks.find(name); stack != plan.stacks.end()) {
      std::vector<const Plane*> layers;
      for (const std::string& layer : stack->second) layers.push_back(inputs.at(layer));
      target.buffers.upload_stack(name, layers);
    } else if (const auto input = inputs.find(name); input != inputs.end()) {
      std::vector<cl::Buffer> sent = uploads ? uploads->take(*input->second, device.queue) : std::vector<cl::Buffer>();
      if (sent.empty())
        target.buffers.upload(*input->second);
      else
        target.buffers.adopt(name, std::move(sent));
    } else {
      continue;
    }
    target.planes.insert(name);
  }
}

}  // namespace

void allocate_computed(const Plan& plan, ViewOnDevice& target) {
  const std::map<std::string, std::string> shared = shared_memory(plan, target.layouts);
  const std::set<std::string> lists = lists_of(plan);
  for (const std::string& name : planes_of(plan)) {
    if (target.buffers.has(name) || shared.contains(name)) continue;
    if (layers_in_buffer(plan, name) > 1 || is_stack(name))
      target.buffers.allocate_stack(name, bytes_of_buffer(plan, target.layouts, name));
    else
      target.buffers.allocate(name, target.layouts.of(name), lists.contains(name));
  }
  for (const auto& [name, memory] : shared) target.buffers.share(name, memory);
}

Buffers::~Buffers() {
  for (FromPool& each : from_pool_) device_.pool.give(std::move(each.buffer), each.bytes, each.content);
}

/// `content`: what is known to be in the buffer, and stays there.
BufferPool::Taken Buffers::take(size_t bytes, float content) {
  if (in_host_pages_) return {cl::Buffer(device_.context, CL_MEM_READ_WRITE, bytes), true};
  BufferPool::Taken taken = device_.pool.take(device_.context, bytes, content);
  from_pool_.push_back({taken.buffer, bytes, content});
  return taken;
}

void Buffers::upload(const Plane& plane) {
  for (const Channel& channel : plane.channels) {
    const size_t bytes = channel.layout().bytes();
    if (in_host_pages_) {
      buffers_[plane.name].emplace_back(device_.context, CL_MEM_READ_ONLY | CL_MEM_USE_HOST_PTR, bytes,
                                        const_cast<float*>(channel.data()));
      continue;
    }
    cl::Buffer buffer = take(bytes, anything).buffer;
    device_.queue.enqueueWriteBuffer(buffer, CL_FALSE, 0, bytes, channel.data());
    buffers_[plane.name].push_back(std::move(buffer));
  }
}

void Buffers::upload_stack(const std::string& name, const std::vector<const Plane*>& layers) {
  const size_t bytes = layers.front()->channels.front().layout().bytes();
  cl::Buffer buffer = take(layers.size() * bytes, anything).buffer;
  for (size_t i = 0; i < layers.size(); ++i)
    device_.queue.enqueueWriteBuffer(buffer, CL_FALSE, i * bytes, bytes, layers[i]->channels.front().data());
  buffers_[name].push_back(std::move(buffer));
}

void Buffers::allocate_stack(const std::string& name, size_t bytes) {
  bytes_ += bytes;
  cl::Buffer buffer = take(bytes, anything).buffer;
  device_.queue.enqueueFillBuffer(buffer, plane_kind(name).outside, 0, bytes);
  buffers_[name].push_back(std::move(buffer));
}

void Buffers::allocate(const std::string& name, const Layout& layout, bool is_list) {
  const PlaneKind kind = plane_kind(name);
  for (size_t i = 0; i < kind.components.size(); ++i) {
    bytes_ += layout.bytes();
    if (in_host_pages_) {
      Channel channel(layout);
      channel.fill_padding(kind.outside);
      buffers_[name].emplace_back(device_.context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, layout.bytes(),
                                  channel.data());
      host_[name].push_back(std::move(channel));
    } else {
      // No kernel writes into the guards, but for the length of a list.
      BufferPool::Taken taken = take(layout.bytes(), is_list ? anything : kind.outside);
      const size_t guard = Layout::guard * sizeof(float);
      for (const size_t at : {size_t(0), layout.bytes() - guard}) {
        if (taken.is_new || is_list) device_.queue.enqueueFillBuffer(taken.buffer, kind.outside, at, guard);
      }
      buffers_[name].push_back(std::move(taken.buffer));
    }
  }
}

std::vector<Plane> Buffers::download_stack(const std::string& name, const Layout& layout, size_t layers) {
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

Channel Buffers::download_bits(const std::string& name, const Layout& layout) {
  Channel bits(layout);
  device_.queue.enqueueReadBuffer(buffers_.at(name).front(), CL_TRUE, 0, layout.bytes(), bits.data());
  return bits;
}

int Buffers::length_of_list(const std::string& name) {
  cl_int length = 0;
  device_.queue.enqueueReadBuffer(buffers_.at(name).front(), CL_TRUE, 0, sizeof length, &length);
  return length;
}

Plane Buffers::download(const std::string& name, const Layout& layout) {
  const PlaneKind kind = plane_kind(name);
  Plane plane{name, {}};
  for (size_t i = 0; i < kind.components.size(); ++i) {
    cl::Buffer& buffer = buffers_.at(name)[i];
    if (in_host_pages_) {
      // Mapping makes the device's result visible to the host.
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
  buffers_.erase(name);  // before the host touches the pages that the buffer used
  for (Channel& channel : plane.channels) channel.fill_padding(kind.outside);
  return plane;
}

ViewOnDevice view_on_device(const Plan& plan, const Frame& frame, const View& view, Device::Impl& device,
                            Uploads* uploads) {
  const Layout layout(frame.width(), frame.height());
  ViewOnDevice target{frame, view, layout, Layouts(plan, layout), Buffers(device, device.info.shares_memory)};
  upload_inputs(plan, target, device, uploads);
  allocate_computed(plan, target);
  return target;
}

void download(const Plan& plan, ViewOnDevice& target, View& out) {
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

}  // namespace gloam
