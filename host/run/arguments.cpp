#include "run/arguments.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <limits>

#include "base/lists.h"
#include "gloam/planes.h"
#include "run/kernel_projection.h"
#include "technique/kernel_sources.h"

namespace gloam {
namespace {

#define FRAME_SCALAR float
#define FRAME_NAME FrameOfFloats
#define NEIGHBOUR_NAME NeighbourOfFloats
#include "shared/both/frame.h"
#undef FRAME_SCALAR
#undef FRAME_NAME
#undef NEIGHBOUR_NAME
#define FRAME_SCALAR double
#define FRAME_NAME FrameOfDoubles
#define NEIGHBOUR_NAME NeighbourOfDoubles
#include "shared/both/frame.h"
#undef FRAME_SCALAR
#undef FRAME_NAME
#undef NEIGHBOUR_NAME
static_assert(Layout::guard == FRAME_GUARD);

/// `layout`: of every `scale`-th pixel. The centre of reduced pixel X is the centre of pixel X * scale.
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

/// `frame`: of the neighbour. Differences of positions are taken in double, so that views far from the origin stay exact.
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

template <typename KernelFrame>
KernelFrame frame_of(const ViewOnDevice& target, int scale, int seed) {
  return kernel_frame<KernelFrame>(target.frame, *target.view.camera, reduced(target.layout, scale), scale, seed);
}

void set_frame(cl::Kernel& kernel, cl_uint index, const ViewOnDevice& target, int scale, const RunOptions& options) {
  if (options.real == Real::float64)
    kernel.setArg(index, frame_of<FrameOfDoubles>(target, scale, options.seed));
  else
    kernel.setArg(index, frame_of<FrameOfFloats>(target, scale, options.seed));
}

/// Sets the neighbour, at the resolution of those of its planes that are bound.
void set_neighbour(cl::Kernel& kernel, cl_uint index, const PlannedPass& planned, const ViewOnDevice& target,
                   const ViewOnDevice& other, const RunOptions& options) {
  const auto binding = std::find_if(planned.pass.reads.begin(), planned.pass.reads.end(),
                                    [](const Binding& b) { return b.from == From::other_view; });
  const int scale = other.layouts.scale_of(binding->plane);
  const Pose &from = *target.view.camera->pose, &to = *other.view.camera->pose;
  if (options.real == Real::float64)
    kernel.setArg(index,
                  kernel_neighbour<NeighbourOfDoubles>(frame_of<FrameOfDoubles>(other, scale, options.seed), from, to));
  else
    kernel.setArg(index,
                  kernel_neighbour<NeighbourOfFloats>(frame_of<FrameOfFloats>(other, scale, options.seed), from, to));
}

/// From a view to its camera in the frame before; without both poses, to a position that shows nothing.
template <typename KernelNeighbour, typename KernelFrame>
KernelNeighbour neighbour_before(const ViewOnDevice& target, int scale, int seed) {
  const Camera& now = *target.view.camera;
  const Camera& before = target.view.camera_before.value_or(now);
  const KernelFrame frame = kernel_frame<KernelFrame>(target.frame, before, reduced(target.layout, scale), scale, seed);
  if (target.view.camera_before && now.pose && before.pose)
    return kernel_neighbour<KernelNeighbour>(frame, *now.pose, *before.pose);
  KernelNeighbour nowhere = kernel_neighbour<KernelNeighbour>(frame, Pose(), Pose());
  std::fill_n(nowhere.translation, 3, std::numeric_limits<decltype(frame.scale_x)>::quiet_NaN());
  return nowhere;
}

void set_neighbour_before(cl::Kernel& kernel, cl_uint index, const PlannedPass& planned, const ViewOnDevice& target,
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

/// The projection of the view, then those of the key views.
cl::Buffer projections_of(Device::Impl& device, const Plan& plan, const PlannedPass& planned,
                          const ViewOnDevice& target, const OtherViews& others, const RunOptions& options) {
  const bool are_computed = !contains(plan.inputs, "position");
  std::vector<ProjectionOfDoubles> projections;
  for (const ViewOnDevice* to :
       {&target, static_cast<const ViewOnDevice*>(others.nearest), static_cast<const ViewOnDevice*>(others.far)}) {
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

}  // namespace

std::vector<Argument> declared_arguments(const PlannedPass& planned, const Layouts& layouts) {
  const Pass& pass = planned.pass;
  std::vector<Argument> all = {{"Frame", "frame"}};
  if (other_scale(planned, layouts) != 0) all.push_back({"Frame", "other"});
  if (takes(pass, From::other_view) || takes(pass, From::frame_before)) all.push_back({"Neighbour", "neighbour"});
  if (pass.projects) all.push_back({"PROJECTIONS", "projections"});
  if (!planned.technique->parameters.empty()) all.push_back({"Params", "params"});
  for (const auto& [argument, unused] : pass.tables) all.push_back({"TABLE", argument});
  for (const auto& [argument, unused] : pass.view_tables) all.push_back({"PLANE", argument});
  for (const auto& [type, list] : {std::pair{"PLANE", &pass.reads}, std::pair{"PLANE_OUT", &pass.writes}}) {
    for (const Binding& binding : *list) {
      for (const std::string& component : plane_kind(binding.plane).components)
        all.push_back({type, component.empty() ? binding.argument : binding.argument + "_" + component});
    }
  }
  return all;
}

std::string declaration_of(const PlannedPass& planned, const Layouts& layouts) {
  std::vector<std::string> arguments;
  for (const Argument& argument : declared_arguments(planned, layouts))
    arguments.push_back(argument.type + " " + argument.name);
  return fmt::format("{}#define ARGUMENTS {}\n", struct_of(planned.technique->parameters), fmt::join(arguments, ", "));
}

void set_arguments(cl::Kernel& kernel, const Plan& plan, const PlannedPass& planned, Device::Impl& device,
                   ViewOnDevice& target, const OtherViews& others, const RunOptions& options) {
  cl_uint index = 0;
  set_frame(kernel, index++, target, planned.pass.scale, options);
  if (const int scale = other_scale(planned, target.layouts)) set_frame(kernel, index++, target, scale, options);
  if (takes(planned.pass, From::other_view))
    set_neighbour(kernel, index++, planned, target, *others.other, options);
  else if (takes(planned.pass, From::frame_before))
    set_neighbour_before(kernel, index++, planned, target, options);
  const auto set_numbers = [&](cl::Buffer buffer) {
    kernel.setArg(index++, buffer);
    target.numbers.push_back(std::move(buffer));
  };
  if (planned.pass.projects) set_numbers(projections_of(device, plan, planned, target, others, options));
  if (planned.values.size() > 0) kernel.setArg(index++, planned.values.size(), planned.values.bytes());
  for (const auto& [unused, table] : planned.pass.tables) set_numbers(constants(device, table));
  for (const auto& [unused, table_of] : planned.pass.view_tables) set_numbers(constants(device, table_of(target.view)));
  for (const std::vector<Binding>* list : {&planned.pass.reads, &planned.pass.writes}) {
    for (const Binding& binding : *list) {
      ViewOnDevice& from = others.of(binding) ? *others.of(binding) : target;
      for (cl::Buffer& buffer : from.buffers.of(binding.plane)) kernel.setArg(index++, buffer);
    }
  }
}

}  // namespace gloam
