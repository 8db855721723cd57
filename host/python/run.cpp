// gloam.run
#include "gloam/run.h"

#include "python/frames.h"
#include "python/outcome.h"
#include "python/requests.h"

namespace gloam::python {
namespace {

py::list arrays_of(const Outcome& outcome) {
  py::list views;
  for (const ViewValues& view : outcome.views) {
    py::dict planes;
    for (const auto& [name, values] : view.planes) planes[py::str(name)] = array_of(values);
    views.append(std::move(planes));
  }
  return views;
}

py::list passes_of(const Outcome& outcome) {
  py::list passes;
  for (const PassTime& pass : outcome.passes) passes.append(py::make_tuple(text_of(pass.view), pass.name, pass.ms));
  return passes;
}

py::object radius_of(const Outcome& outcome) {
  if (!outcome.radius) return py::none();
  // A kernel has it as float: back to the decimals that a user wrote.
  return py::make_tuple(std::stod(fmt::format("{}", float(outcome.radius->value))), name_of(outcome.radius->from));
}

Outcome run_on(const py::dict& request_words, const SharedFrame& frame, bool is_own,
               const std::shared_ptr<Device>& device, const py::dict& option_words, std::optional<int> strips) {
  const PlanRequest request = plan_request(request_words);
  const RunOptions options = run_options(option_words);
  return without_lock([&](Interrupts& interrupts) {
    return compute_outcome(request, frame, is_own, *device, options, interrupts, nullptr, strips);
  });
}

}  // namespace

void add_run(py::module_& module) {
  py::class_<Outcome>(module, "Outcome")
      .def_property_readonly("arrays", &arrays_of)
      .def_property_readonly("views",
                             [](const Outcome& self) {
                               std::vector<std::string> names;
                               for (const ViewValues& view : self.views) names.push_back(view.view);
                               return texts_of(names);
                             })
      .def_readonly("technique", &Outcome::technique)
      .def_readonly("device", &Outcome::device)
      .def_readonly("lanes", &Outcome::lanes)
      .def_property_readonly("passes", &passes_of)
      .def_readonly("total_ms", &Outcome::total_ms)
      .def_property_readonly("radius", &radius_of)
      .def_property_readonly("notes", [](const Outcome& self) { return texts_of(self.notes); })
      .def_readonly("attributes", &Outcome::attributes)
      .def_readonly("skipped_share", &Outcome::skipped_share)
      .def_readonly("device_bytes", &Outcome::device_bytes)
      .def_readonly("source", &Outcome::source)
      .def_readonly("number", &Outcome::number);
  module.def("run", &run_on);
  module.def("pixels_at_median_depth", [](const HeldFrame& held) { return pixels_at_median_depth(held.frame); });
  module.def("suggestion",
             [](const std::string& name, const std::vector<std::string>& names) { return suggestion(name, names); });
  module.def("enumerate", &enumerate);
  module.def("printable", [](const std::string& text) { return printable(text); });
}

}  // namespace gloam::python
