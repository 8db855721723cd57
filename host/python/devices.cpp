// gloam.Device
#include "python/devices.h"

#include <map>
#include <mutex>

#include "base/memory.h"
#include "gloam/device_memory.h"
#include "python/bindings.h"
#include "python/doc_strings.h"
#include "python/interrupts.h"
#include "run/kept_folders.h"

namespace gloam::python {
namespace {

struct Kept {
  std::mutex mutex;
  std::map<std::string, std::shared_ptr<Device>> devices;
};

/// Never destroyed: at the end of the process the driver may be gone before.
Kept& kept() {
  static Kept& only = *new Kept;
  return only;
}

int lanes_of(const DeviceInfo& info) { return info.tuning.lanes; }

std::string in_words(const DeviceInfo& info) {
  return fmt::format("'{}' ({}), {}, {} lanes, {}", info.name, info.platform, info.type, info.tuning.lanes,
                     memory_in_words(info.memory));
}

/// The device of a caller's queue: an object of pyopencl, or its address.
std::shared_ptr<Device> of_queue(const py::object& queue) {
  const auto handle = reinterpret_cast<cl_command_queue>(handle_of("queue", queue));
  return without_lock([&](Interrupts&) { return std::make_shared<Device>(device_of(handle)); });
}

}  // namespace

std::shared_ptr<Device> shared_device(const std::string& text) {
  const std::lock_guard lock(kept().mutex);
  std::shared_ptr<Device>& device = kept().devices[text];
  if (!device) device = std::make_shared<Device>(text);
  return device;
}

void add_devices(py::module_& module) {
  py::class_<DeviceInfo>(module, "DeviceInfo", device_info_help)
      .def_readonly("platform", &DeviceInfo::platform)
      .def_readonly("name", &DeviceInfo::name)
      .def_readonly("type", &DeviceInfo::type)
      .def_readonly("driver", &DeviceInfo::driver)
      .def_property_readonly("lanes", lanes_of)
      .def_readonly("has_double", &DeviceInfo::has_double)
      .def_readonly("memory", &DeviceInfo::memory)
      .def_readonly("largest_buffer", &DeviceInfo::largest_buffer)
      .def("__repr__", [](const DeviceInfo& info) { return fmt::format("<gloam.DeviceInfo {}>", in_words(info)); });
  py::class_<Device, std::shared_ptr<Device>> device(module, "Device", device_help);
  device
      .def(py::init([](const py::object& given, const py::object& queue) {
             if (!queue.is_none()) return of_queue(queue);
             if (!py::isinstance<py::str>(given))
               throw UsageError("device is of type {}; a text is allowed, part of a name of gloam.devices()",
                                py::cast<std::string>(py::type::of(given).attr("__name__")));
             const auto text = py::cast<std::string>(given);
             return without_lock([&](Interrupts&) { return std::make_shared<Device>(text); });
           }),
           py::arg("text") = "", py::arg("queue") = py::none())
      .def("__repr__", [](const Device& self) { return fmt::format("<gloam.Device {}>", in_words(self.info())); });
  const auto of_info = [&](const char* name, auto member) {
    device.def_property_readonly(name, [member](const Device& self) { return self.info().*member; });
  };
  of_info("platform", &DeviceInfo::platform);
  of_info("name", &DeviceInfo::name);
  of_info("type", &DeviceInfo::type);
  of_info("driver", &DeviceInfo::driver);
  device.def_property_readonly("lanes", [](const Device& self) { return lanes_of(self.info()); });
  of_info("has_double", &DeviceInfo::has_double);
  of_info("memory", &DeviceInfo::memory);
  of_info("largest_buffer", &DeviceInfo::largest_buffer);
  module.def(
      "devices", [] { return without_lock([](Interrupts&) { return list_devices(); }); }, devices_help);
  module.def(
      "shared_device",
      [](const std::string& text) { return without_lock([&](Interrupts&) { return shared_device(text); }); },
      py::arg("text"));
  module.def("give_pocl_a_folder", &give_pocl_a_folder);
  module.def("foreign_folders_note", &foreign_folders_note);
}

}  // namespace gloam::python
