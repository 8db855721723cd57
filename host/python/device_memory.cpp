// gloam.enqueue
#include "gloam/device_memory.h"

#include <CL/cl.h>

#include <algorithm>
#include <cstdint>

#include "gloam/compute.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "gloam/radius.h"
#include "python/bindings.h"
#include "python/doc_strings.h"
#include "python/interrupts.h"
#include "python/requests.h"

namespace gloam::python {
namespace {

/// The address of an OpenCL object.
using Handle = std::uintptr_t;

/// `step`: 0 for pixels without a gap. One buffer holds the components of a pixel side by side.
DevicePlane plane_of(const std::string& name, const std::vector<Handle>& buffers, size_t offset, size_t step,
                     size_t pitch, bool is_clean) {
  DevicePlane plane{.name = name, .pitch = pitch, .is_clean = is_clean};
  const size_t components = plane_kind(name).components.size(), side_by_side = buffers.size() == 1 ? components : 1;
  const size_t tight = side_by_side * sizeof(float);
  if (step != 0 && step < tight)
    throw Error("plane '{}': a step of {} bytes is given; its {} components side by side take {}", name, step,
                side_by_side, tight);
  for (const Handle buffer : buffers) {
    for (size_t i = 0; i < side_by_side; ++i)
      plane.channels.push_back(
          {reinterpret_cast<cl_mem>(buffer), offset + i * sizeof(float), step == 0 ? tight : step});
  }
  return plane;
}

std::vector<DevicePlane> planes_of(const py::dict& given) {
  using Facts = std::tuple<std::vector<Handle>, size_t, size_t, size_t, bool>;
  std::vector<DevicePlane> planes;
  for (const auto& [name, facts] : given) {
    const auto [buffers, offset, step, pitch, is_clean] = py::cast<Facts>(facts);
    planes.push_back(plane_of(py::cast<std::string>(name), buffers, offset, step, pitch, is_clean));
  }
  return planes;
}

DeviceFrame frame_of(const py::tuple& size, const py::list& views) {
  DeviceFrame frame{.width = py::cast<int>(size[0]), .height = py::cast<int>(size[1])};
  for (const py::handle& item : views) {
    const auto view = py::cast<py::tuple>(item);
    frame.views.push_back({.name = py::cast<std::string>(view[0]),
                           .camera = py::cast<Camera>(view[1]),
                           .planes = planes_of(view[2]),
                           .results = planes_of(view[3])});
  }
  return frame;
}

/// The planes that every view has.
std::vector<std::string> common_planes(const DeviceFrame& frame) {
  std::vector<std::string> names;
  for (const DevicePlane& plane : frame.views.front().planes) {
    const bool is_common = std::all_of(frame.views.begin(), frame.views.end(), [&](const DeviceView& view) {
      return std::any_of(view.planes.begin(), view.planes.end(),
                         [&](const DevicePlane& other) { return other.name == plane.name; });
    });
    if (is_common) names.push_back(plane.name);
  }
  return names;
}

/// A plan for the results that are asked for, without the planes that it does not read.
Plan plan_for(PlanRequest request, DeviceFrame& frame) {
  for (const DeviceView& view : frame.views) {
    for (const DevicePlane& result : view.results) request.only_outputs.push_back(result.name);
  }
  const std::vector<std::string> planes = common_planes(frame);
  Plan plan = make_plan(request, planes, planes_in_words(planes));
  const std::optional<Radius> radius = radius_of(plan, request, RadiusSource::frame);
  if (radius && radius->from != RadiusSource::flag)
    throw UsageError("{}: none is given, and planes in a device's memory are not looked at to make one; give a radius",
                     option("radius"));
  for (DeviceView& view : frame.views)
    std::erase_if(view.planes, [&](const DevicePlane& plane) {
      return std::find(plan.inputs.begin(), plan.inputs.end(), plane.name) == plan.inputs.end();
    });
  return plan;
}

Enqueued enqueue_on(const py::dict& request_words, const py::tuple& size, const py::list& views, Device& device,
                    const py::dict& option_words, const std::vector<Handle>& wait_for) {
  const PlanRequest request = plan_request(request_words);
  const RunOptions options = run_options(option_words);
  DeviceFrame frame = frame_of(size, views);
  std::vector<cl_event> events;
  for (const Handle event : wait_for) events.push_back(reinterpret_cast<cl_event>(event));
  return without_lock([&](Interrupts&) { return enqueue(plan_for(request, frame), frame, device, options, events); });
}

void wait(const Enqueued& enqueued) {
  const cl_event done = enqueued.done.get();
  const cl_int failed = without_lock([&](Interrupts&) { return clWaitForEvents(1, &done); });
  if (failed != CL_SUCCESS) throw Error("waiting for a device failed with the OpenCL error {}", failed);
}

}  // namespace

std::uintptr_t handle_of(const std::string& what, const py::object& given) {
  const py::object address = py::getattr(given, "int_ptr", given);
  if (py::isinstance<py::int_>(address) && !py::isinstance<py::bool_>(address)) {
    const unsigned long long number = PyLong_AsUnsignedLongLong(address.ptr());
    if (!PyErr_Occurred() && number > 0) return number;
    PyErr_Clear();
  }
  throw UsageError("{} is of type {}; an object of pyopencl is allowed, or its address, a whole number above 0", what,
                   py::cast<std::string>(py::type::of(given).attr("__name__")));
}

void add_device_memory(py::module_& module) {
  py::class_<Enqueued>(module, "Enqueued", enqueued_help)
      .def_property_readonly("int_ptr", [](const Enqueued& self) { return reinterpret_cast<Handle>(self.done.get()); })
      .def_readonly("copied", &Enqueued::copied)
      .def_readonly("device_bytes", &Enqueued::device_bytes)
      .def("wait", &wait);
  module.def("enqueue", &enqueue_on);
  module.def("handle", &handle_of);
  module.def("device_layout", [](int width, int height) {
    const DeviceLayout layout = device_layout(width, height);
    return py::make_tuple(layout.pitch, layout.offset, layout.bytes);
  });
}

}  // namespace gloam::python
