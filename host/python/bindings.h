// What the files of the Python module share. Each of them adds a part to the module `gloam._gloam`; what users see is gloam/__init__.py.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gloam/device.h"
#include "gloam/error.h"
#include "gloam/frame.h"

namespace gloam::python {

namespace py = pybind11;

/// A frame as Python holds it. It does not change, so that threads may share it.
struct HeldFrame {
  Frame frame;
  std::string name;  ///< of its file, or of what made it, for messages; may be empty
};
using SharedFrame = std::shared_ptr<HeldFrame>;

/// A text of a file, whose names need not be UTF-8, as `os.fsdecode` makes such names.
inline py::str text_of(const std::string& text) {
  PyObject* const made = PyUnicode_DecodeUTF8(text.data(), py::ssize_t(text.size()), "surrogateescape");
  if (!made) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(made);
}
inline py::list texts_of(const std::vector<std::string>& texts) {
  py::list list;
  for (const std::string& text : texts) list.append(text_of(text));
  return list;
}

/// The address of an OpenCL object: of one of pyopencl, or a whole number. `what`: in the error's sentence.
std::uintptr_t handle_of(const std::string& what, const py::object& given);

void add_errors(py::module_& module);
void add_camera(py::module_& module);
void add_devices(py::module_& module);
void add_device_memory(py::module_& module);
void add_frames(py::module_& module);
void add_files(py::module_& module);
void add_pictures(py::module_& module);
void add_techniques(py::module_& module);
void add_run(py::module_& module);
void add_auto(py::module_& module);
void add_pick(py::module_& module);
void add_sequences(py::module_& module);
void add_compare(py::module_& module);
void add_scenes(py::module_& module);

}  // namespace gloam::python
