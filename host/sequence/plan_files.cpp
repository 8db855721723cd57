#include "sequence/plan_files.h"

#include "exr/holdings.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {

Plan plan_for_files(const FrameFiles& files, const PlanRequest& request) {
  try {
    Plan plan = make_plan(request, files.common_planes(), holdings(files));
    for (const FrameFile& file : files.files())
      check_stored_map(plan, [&](const std::string& name) { return file.text_attribute(name); });
    return plan;
  } catch (const MissingPlanes& missing) {
    // If only some views lack the plane, a list of channels would confuse.
    std::vector<std::string> wanted = missing.planes;
    for (const auto& [plane, instead] : missing.instead) wanted.push_back(instead);
    for (const std::string& plane : wanted) {
      const std::string why = files.why_missing(plane);
      if (!why.empty()) {
        throw Error("{}: needs '{}', and in {} {}; {}", request.outputs.front(), plane, files.name(), why,
                    files.files().size() > 1 ? std::string("give the file of the other view alone")
                                             : option("view", "NAME") + " chooses another view");
      }
    }
    throw;
  }
}

std::optional<double> stated_radius(const FrameFile& file, std::vector<std::string>& notes) {
  const std::optional<double> stated = file.number_attribute("aoRadius");
  if (!stated || (*stated >= least_radius && *stated <= most_radius)) return stated;
  notes.push_back(fmt::format("{}: aoRadius {:g} in the header is not a valid radius, and is ignored",
                              file.path().filename().string(), *stated));
  return {};
}

std::optional<Radius> settle_radius(PlanRequest& request, Plan& plan, const Frame& frame, std::optional<double> stated,
                                    const std::vector<std::string>& available, const std::string& holds) {
  if (request.radius) return radius_of(plan, request, RadiusSource::flag);
  const Radius made = default_radius(frame, stated);
  if (!radius_of(plan, request, made.from)) return {};
  request.radius = made.value;
  plan = make_plan(request, available, holds);
  return radius_of(plan, request, made.from);
}

}  // namespace gloam
