#include "gloam/provenance.h"

#include "gloam/error.h"

namespace gloam {
namespace {

std::string parameters_of(const Plan& plan) {
  std::string parameters;
  const Technique* last = nullptr;
  for (const PlannedPass& planned : plan.passes) {
    if (planned.technique == last) continue;
    last = planned.technique;
    parameters += (parameters.empty() ? "" : "; ") + last->name + ":";
    for (const Parameter& p : last->parameters) parameters += " " + p.name + "=" + planned.values.text(p.name);
  }
  return parameters;
}

}  // namespace

std::map<std::string, std::string> provenance(const std::vector<MadeBy>& plans, const RunOptions& options) {
  std::string techniques, parameters;
  for (const MadeBy& made : plans) {
    if (made.has_run) techniques += (techniques.empty() ? "" : ", ") + made.plan->technique;
    parameters += (parameters.empty() ? "" : "; ") + parameters_of(*made.plan);
  }
  return {{"gloamTechnique", techniques},
          {"gloamParameters", parameters},
          {"gloamRun", fmt::format("math={} real={} seed={}", options.math == Math::fast ? "fast" : "precise",
                                   options.real == Real::float32 ? "float" : "double", options.seed)}};
}

}  // namespace gloam
