// The compiled part of the Python module: gloam/__init__.py is what users import.
#include "gloam/option.h"
#include "python/bindings.h"

PYBIND11_MODULE(_gloam, module) {
  using namespace gloam::python;
  gloam::set_caller(gloam::Caller::python);
  module.attr("version") = GLOAM_VERSION;
  add_errors(module);
  add_camera(module);
  add_devices(module);
  add_device_memory(module);
  add_frames(module);
  add_files(module);
  add_pictures(module);
  add_techniques(module);
  add_run(module);
  add_auto(module);
  add_pick(module);
  add_sequences(module);
  add_compare(module);
  add_scenes(module);
}
