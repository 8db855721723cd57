// gloam.techniques
#include <cmath>

#include "gloam/plan.h"
#include "gloam/radius.h"
#include "gloam/technique.h"
#include "python/bindings.h"
#include "technique/variant_words.h"

namespace gloam::python {
namespace {

py::object number(const Parameter& parameter, double value) {
  if (parameter.type == Parameter::Type::integer) return py::int_((long long)value);
  // Through float, as the kernel has it, then in its shortest decimal form.
  return py::float_(std::isfinite(value) ? std::stod(fmt::format("{}", float(value))) : value);
}

py::object initial_value(const Parameter& parameter) {
  if (is_radius(parameter)) return py::none();
  if (parameter.type == Parameter::Type::boolean) return py::bool_(parameter.initial != 0);
  if (parameter.type == Parameter::Type::floating || parameter.type == Parameter::Type::integer)
    return number(parameter, parameter.initial);
  return py::str(ParameterValues({parameter}).text(parameter.name));
}

py::dict parameter_of(const Parameter& parameter) {
  const bool is_number = parameter.type == Parameter::Type::floating || parameter.type == Parameter::Type::integer;
  py::dict facts;
  facts["name"] = parameter.name;
  facts["type"] = type_name(parameter);
  facts["default"] = initial_value(parameter);
  facts["min"] = is_number ? number(parameter, parameter.min) : py::none();
  facts["max"] = is_number ? number(parameter, parameter.max) : py::none();
  facts["choices"] = parameter.choices;
  facts["unit"] = parameter.unit;
  facts["help"] = parameter.help;
  return facts;
}

py::object variant_facts(const Variant& variant) {
  if (variant.of.empty()) return py::none();
  return py::dict(py::arg("of") = variant.of, py::arg("layers") = word_for(variant.layers, layers_words),
                  py::arg("eyes") = word_for(variant.both_eyes, eyes_words));
}

py::dict technique_of(const Technique& technique) {
  py::list parameters;
  for (const Parameter& parameter : technique.parameters) parameters.append(parameter_of(parameter));
  py::dict presets;
  for (const Preset& preset : technique.presets) {
    py::dict settings;
    for (const auto& [name, value] : preset.settings) settings[py::str(name)] = value;
    presets[py::str(preset.name)] = settings;
  }
  py::dict facts;
  facts["name"] = technique.name;
  facts["summary"] = technique.summary;
  facts["paper"] = technique.paper;
  facts["reads"] = technique.reads;
  facts["optional"] = technique.may_read;
  facts["writes"] = technique.writes;
  facts["outputs"] = outputs_of(technique);
  facts["extras"] = technique.extras;
  facts["then"] = technique.then;
  facts["views"] = technique.views;
  facts["caution"] = technique.caution;
  facts["parameters"] = parameters;
  facts["presets"] = presets;
  facts["variant"] = variant_facts(technique.variant);
  return facts;
}

}  // namespace

void add_techniques(py::module_& module) {
  module.def("techniques", [] {
    py::list list;
    for (const Technique& technique : registry()) list.append(technique_of(technique));
    return list;
  });
}

}  // namespace gloam::python
