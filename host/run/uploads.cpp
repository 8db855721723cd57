#include "run/uploads.h"

#include <limits>

#include "base/lists.h"
#include "gloam/run.h"
#include "run/device_impl.h"
#include "run/driver.h"

namespace gloam {
namespace {

/// One that is computed next, and one behind it: further ones would fill the device's memory.
constexpr int most_frames = 2;

bool is_sent(const Plan& plan, const std::string& input) {
  // Layers of a stack share a buffer.
  for (const auto& [stack, layers] : plan.stacks) {
    if (contains(layers, input)) return false;
  }
  return true;
}

unsigned long long bytes_of_inputs(const Plan& plan, const Frame& frame) {
  unsigned long long bytes = 0;
  for (const View& view : frame.views) {
    for (const std::string& input : plan.inputs) {
      if (const Plane* plane = view.find(input))
        bytes += plane->channels.size() * plane->channels.front().layout().bytes();
    }
  }
  return bytes;
}

}  // namespace

bool Transfers::begin() {
  const std::lock_guard alone(busy_);
  if (frames_ == most_frames) return false;
  ++frames_;
  return true;
}

Transfers::UnderWay Transfers::send(const cl::Context& context, const cl::Device& device, const Plane& plane) {
  const std::lock_guard alone(busy_);
  if (!queue_()) queue_ = cl::CommandQueue(context, device);
  UnderWay sent;
  for (const Channel& channel : plane.channels) {
    sent.bytes = channel.layout().bytes();
    sent.buffers.push_back(pool_.take(context, sent.bytes, anything).buffer);
    sent.arrived.emplace_back();
    queue_.enqueueWriteBuffer(sent.buffers.back(), CL_FALSE, 0, sent.bytes, channel.data(), nullptr,
                              &sent.arrived.back());
  }
  queue_.flush();
  return sent;
}

void Transfers::finish() {
  const std::lock_guard alone(busy_);
  if (queue_()) queue_.finish();
}

void Transfers::end(std::vector<UnderWay> planes) {
  const std::lock_guard alone(busy_);
  --frames_;
  pool_.begin_run(0, std::numeric_limits<unsigned long long>::max());
  for (UnderWay& plane : planes) {
    for (cl::Buffer& buffer : plane.buffers) pool_.give(std::move(buffer), plane.bytes, anything);
  }
}

Uploads::~Uploads() {
  std::vector<Transfers::UnderWay> all;
  for (auto& [plane, under_way] : planes) {
    try {
      cl::Event::waitForEvents(under_way.arrived);
    } catch (const cl::Error&) {  // the run that takes the plane says it
    }
    all.push_back(std::move(under_way));
  }
  transfers.end(std::move(all));
}

std::vector<cl::Buffer> Uploads::take(const Plane& plane, cl::CommandQueue& queue) {
  const auto found = planes.find(&plane);
  if (found == planes.end()) return {};
  queue.enqueueBarrierWithWaitList(&found->second.arrived);
  return found->second.buffers;
}

std::shared_ptr<Uploads> upload(const Plan& plan, const Frame& frame, Device& device) {
  Device::Impl& impl = device.impl();
  if (impl.info.shares_memory || frame.views.empty()) return {};
  const unsigned long long inputs = bytes_of_inputs(plan, frame);
  if (device_bytes(plan, Layout(frame.width(), frame.height()), frame.views.size()) + most_frames * inputs >
      impl.info.memory)
    return {};
  if (!impl.transfers.begin()) return {};
  auto uploads = std::make_shared<Uploads>(impl.transfers);
  const DriverAtWork driver;
  try {
    for (const View& view : frame.views) {
      for (const std::string& input : plan.inputs) {
        const Plane* plane = view.find(input);
        if (plane && is_sent(plan, input))
          uploads->planes.emplace(plane, impl.transfers.send(impl.context, impl.device, *plane));
      }
    }
    return uploads;
  } catch (const cl::Error&) {  // the run sends the planes itself, and says what is wrong
  }
  try {
    impl.transfers.finish();  // a plane may be sent in part
  } catch (const cl::Error&) {
  }
  return {};
}

}  // namespace gloam
