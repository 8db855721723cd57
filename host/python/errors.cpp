// gloam.Error and what it is divided into. A message is the sentence that the command prints.
#include <exception>

#include "base/json_text.h"
#include "gloam/plan.h"
#include "python/bindings.h"

namespace gloam::python {
namespace {

/// Kept as long as the process lives, since exceptions may be raised until its end.
PyObject *error_type, *usage_error_type, *missing_planes_type;

PyObject* new_type(py::module_& module, const char* name, const char* help, const py::tuple& bases) {
  const std::string full = std::string("gloam.") + name;
  PyObject* type = PyErr_NewExceptionWithDoc(full.c_str(), help, bases.ptr(), nullptr);
  if (!type) throw py::error_already_set();
  module.add_object(name, py::reinterpret_borrow<py::object>(type));
  return type;
}

void raise_missing(const MissingPlanes& missing) {
  py::object raised = py::reinterpret_borrow<py::object>(missing_planes_type)(missing.what());
  raised.attr("planes") = missing.planes;
  PyErr_SetObject(missing_planes_type, raised.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const MissingPlanes& missing) {
    raise_missing(missing);
  } catch (const UsageError& error) {
    PyErr_SetString(usage_error_type, error.what());
  } catch (const Error& error) {
    PyErr_SetString(error_type, error.what());
  } catch (const nlohmann::json::exception& error) {
    PyErr_SetString(error_type, ("a value of JSON is of another type than expected: " + reason_of(error)).c_str());
  } catch (const std::bad_alloc&) {
    PyErr_SetString(error_type, "out of memory; use a smaller frame, or ask for fewer planes");
  }
}

}  // namespace

void add_errors(py::module_& module) {
  const py::object runtime_error = py::reinterpret_borrow<py::object>(PyExc_RuntimeError),
                   value_error = py::reinterpret_borrow<py::object>(PyExc_ValueError);
  error_type = new_type(module, "Error",
                        "What gloam cannot do: one sentence that names the thing, the value, what is allowed and what "
                        "to do.",
                        py::make_tuple(runtime_error));
  const py::object error = py::reinterpret_borrow<py::object>(error_type);
  usage_error_type = new_type(module, "UsageError", "A wrong name, or a value out of range. Also a ValueError.",
                              py::make_tuple(error, value_error));
  missing_planes_type = new_type(module, "MissingPlanes",
                                 "Planes that neither the frame nor any technique provides; all their names are in "
                                 "`planes`.",
                                 py::make_tuple(error));
  py::register_exception_translator(&translate);
}

}  // namespace gloam::python
