#include "plan/relevant_map.h"

#include <algorithm>
#include <cstdlib>

#include "base/lists.h"
#include "gloam/option.h"

namespace gloam {
namespace {

bool reads_stochastic(const PlannedPass& planned) { return contains(planned.technique->reads, "stochastic"); }

/// Whether a pass reads the stochastic depths of the other view.
bool reads_those_of_other_view(const PlannedPass& planned) {
  const auto is_hidden = [](const Binding& b) { return b.from == From::other_view && b.layers > 0; };
  const std::vector<Binding>& reads = planned.pass.reads;
  return reads_stochastic(planned) && std::any_of(reads.begin(), reads.end(), is_hidden);
}

/// The technique that takes the second view for another look at all that the first shows; null if none does. Two eyes that agree, close
/// together, get a warning.
const Technique* reader_for_other_view(const Plan& plan) {
  const auto found = std::find_if(plan.passes.begin(), plan.passes.end(), [](const PlannedPass& planned) {
    return reads_those_of_other_view(planned) && makes_first_view_only(*planned.technique);
  });
  return found == plan.passes.end() ? nullptr : found->technique;
}

bool has_stored_map(const Plan& plan) { return plan.stacks.count("stochastic") > 0; }

/// The technique of the plan that makes a map of relevant surfaces; null if none does.
const Technique* maker_of_relevant(const Plan& plan) {
  const auto found = std::find_if(plan.passes.begin(), plan.passes.end(), [](const PlannedPass& planned) {
    return contains(planned.technique->writes, "stochastic") && planned.values.text("surfaces") == "relevant";
  });
  return found == plan.passes.end() ? nullptr : found->technique;
}

[[noreturn]] void refuse(const Technique& reader, const std::string& instead) {
  throw UsageError(
      "{}: looks among one view's stochastic depths for occluders of what the other view shows, and those of relevant "
      "surfaces serve their own view alone; {}",
      reader.name, instead);
}

/// The words after a technique's name in the attribute gloamParameters (provenance.h); empty if it did not run.
std::string parameters_in(const std::string& attribute, const std::string& technique) {
  const size_t own = attribute.find(technique + ":");
  return own == std::string::npos ? "" : attribute.substr(own, attribute.find(';', own) - own);
}

/// Whether attributes say that a frame's map is of relevant surfaces: of gloam capture, or of a run of stochastic-depth.
bool says_relevant(const std::function<std::string(const std::string&)>& says) {
  if (const std::string surfaces = says("gloamStochasticSurfaces"); !surfaces.empty()) return surfaces == "relevant";
  return radius_of_relevant(says("gloamParameters")).has_value();
}

}  // namespace

std::optional<double> radius_of_relevant(const std::string& parameters) {
  const std::string of_map = parameters_in(parameters, "stochastic-depth"), key = " radius=";
  const size_t radius = of_map.find(key);
  if (of_map.find(" surfaces=relevant") == std::string::npos || radius == std::string::npos) return {};
  return std::strtod(of_map.c_str() + radius + key.size(), nullptr);
}

void check_made_map(const Plan& plan) {
  const Technique *reader = reader_for_other_view(plan), *maker = maker_of_relevant(plan);
  if (reader && maker) refuse(*reader, "use " + option("set", maker->name + ".surfaces=hidden"));
}

void check_stored_map(const Plan& plan, const std::function<std::string(const std::string&)>& says) {
  if (!has_stored_map(plan) || !says_relevant(says)) return;
  if (const Technique* reader = reader_for_other_view(plan))
    refuse(*reader, "give a frame with those of hidden ones (gloam capture --stochastic-surfaces hidden)");
}

std::string warning_about_map(const Plan& plan, std::optional<double> radius_of_stored) {
  const bool is_stored = has_stored_map(plan);
  if (is_stored ? !radius_of_stored : !maker_of_relevant(plan)) return "";
  const std::string instead = is_stored
                                  ? "give a frame with hidden surfaces (gloam capture --stochastic-surfaces hidden)"
                                  : "use " + option("set", "stochastic-depth.surfaces=hidden");
  for (const PlannedPass& planned : plan.passes) {
    if (!reads_stochastic(planned)) continue;
    const std::string& name = planned.technique->name;
    const ParameterValues& values = planned.values;
    // The header holds a float.
    if (is_stored && values.has("radius") && values.number("radius") > *radius_of_stored * (1 + 1e-6))
      return fmt::format(
          "{}: the map's surfaces are relevant within {:g} scene units, and a radius of {:g} misses some; {}", name,
          *radius_of_stored, values.number("radius"), instead);
    if (reads_those_of_other_view(planned))
      return fmt::format(
          "{}: looks in the other eye's map too for occluders of what one eye alone shows, and a map of relevant "
          "surfaces may leave them out; {}",
          name, instead);
    // Up to twice the range before what it occludes something counts.
    if (values.has("range") && values.number("range") > 0.5)
      return fmt::format(
          "{}: range {:g} lets surfaces count that are farther away than the radius, and a map of relevant surfaces "
          "leaves some of them out; {}",
          name, values.number("range"), instead);
  }
  return "";
}

}  // namespace gloam
