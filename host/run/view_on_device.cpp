#include "run/view_on_device.h"

#include <map>

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

void fill(ViewOnDevice& target, const Plan& plan) {
  std::map<std::string, const Plane*> inputs;
  for (const std::string& name : plan.inputs) inputs[name] = &input_plane(plan, target.frame, target.view, name);
  const std::map<std::string, std::string> shared = shared_memory(plan, target.layouts);
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
    } else if (!shared.contains(name)) {
      target.buffers.allocate(name, target.layouts.of(name));
    }
  }
  for (const auto& [name, memory] : shared) target.buffers.share(name, memory);
}

}  // namespace

ViewOnDevice view_on_device(const Plan& plan, const Frame& frame, const View& view, Device::Impl& device) {
  const Layout layout(frame.width(), frame.height());
  ViewOnDevice target{frame, view, layout, Layouts(plan, layout), Buffers(device)};
  fill(target, plan);
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
