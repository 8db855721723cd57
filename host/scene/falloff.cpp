#include "scene/falloff.h"

#include <vector>

#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {
namespace {

/// The technique whose contribution is traced; null for no falloff.
const Technique* falloff_technique(const std::string& name) {
  if (name == "none") return nullptr;
  std::vector<std::string> names = {"none"};
  for (const Technique& t : registry()) {
    if (!t.contribution) continue;
    if (t.name == name) return &t;
    names.push_back(t.name);
  }
  throw UsageError("{} is not allowed{}; {} are", option("falloff", name), suggestion(name, names), enumerate(names));
}

}  // namespace

void set_falloff(AoReferenceOptions& options, const std::string& name, const Settings& settings) {
  const Technique* technique = falloff_technique(name);
  options.falloff = name;
  ParameterValues values(technique ? technique->parameters : ParameterList());
  for (const auto& [key, value] : settings) {
    const size_t dot = key.rfind('.');
    if (!technique || key.substr(0, dot) != technique->name)
      throw UsageError("{}: the falloff is {}; with {} it can be set", option("set", key), name,
                       option("falloff", key.substr(0, dot)));
    if (key.substr(dot + 1) == "radius")
      throw UsageError("{}: the radius is the reference's; give {}", option("set", key), option("radius"));
    values.set(key.substr(dot + 1), value, technique->name);
  }
  if (!technique) return;
  for (const Parameter& p : technique->parameters) {
    if (p.name == "radius") continue;  // the reference has its own radius
    options.falloff_parameters += (options.falloff_parameters.empty() ? "" : " ") + p.name + "=" + values.text(p.name);
  }
  options.contribution = [contribution = technique->contribution, values](double cosine, double distance) {
    return contribution(values, cosine, distance);
  };
}

Radius radius_of_truth(std::optional<double> given, std::optional<double> stated, const Scene& scene,
                       const Frame& frame) {
  if (given) return {*given, RadiusSource::flag};
  if (stated) return {*stated, RadiusSource::scene};
  if (scene.ao_radius > 0) return {scene.ao_radius, RadiusSource::scene};
  return default_radius(frame, {});
}

}  // namespace gloam
