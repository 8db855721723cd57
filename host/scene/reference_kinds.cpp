#include "scene/reference_kinds.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/scene/bounces_reference.h"
#include "gloam/scene/reflection_reference.h"
#include "gloam/scene/specular_occlusion_reference.h"
#include "scene/falloff.h"

namespace gloam {
namespace {

/// Takes over what changes from frame to frame.
template <typename Options>
Options for_frame(Options options, const ReferenceOptions& frame) {
  if constexpr (requires { options.radius; }) options.radius = frame.radius;
  options.seed = frame.seed;
  options.checkpoint = frame.checkpoint;
  options.checkpoint_seconds = frame.checkpoint_seconds;
  options.progress = frame.progress;
  options.poll = frame.poll;
  return options;
}

/// A job that calls `reference` with options that stay the same in all frames.
template <typename Options>
ReferenceJob job_with(const ReferenceRequest& request, Options options,
                      Reference (*reference)(const Tracer&, const Frame&, const Options&)) {
  options.samples = request.samples.value_or(options.samples);
  ReferenceJob job;
  job.reads = {"depth", "normal"};
  job.radius = request.radius;
  job.trace = [options, reference](const Tracer& tracer, const Frame& frame, const ReferenceOptions& of_frame) {
    return reference(tracer, frame, for_frame(options, of_frame));
  };
  return job;
}

ReferenceJob ao_job(const ReferenceRequest& request, const OptionSpelling& spelled) {
  AoReferenceOptions options;
  set_falloff(options, request.falloff, request.falloff_settings);
  if (options.contribution && request.radius && !std::isfinite(*request.radius))
    throw UsageError("{} inf: the falloff of {} is in relation to the radius; give a finite one", spelled("radius"),
                     request.falloff);
  ReferenceJob job = job_with(request, options, &ao_reference);
  job.words = {{"falloff", options.falloff}};
  job.heading = fmt::format("falloff {}", options.falloff);
  return job;
}

ReferenceJob reflection_job(const ReferenceRequest& request, const OptionSpelling&) {
  ReferenceJob job = job_with(request, ReflectionReferenceOptions(), &reflection_reference);
  job.reads = {"depth", "normal", "roughness", "reflectance"};
  job.heading = "two bounces";
  job.has_radius = false;
  return job;
}

ReferenceJob bounces_job(const ReferenceRequest& request, const OptionSpelling&) {
  BouncesReferenceOptions options;
  options.bounces = request.bounces.value_or(options.bounces);
  ReferenceJob job = job_with(request, options, &bounces_reference);
  job.heading = fmt::format("up to {} reflections between surfaces", options.bounces);
  job.numbers = {{"bounces", options.bounces}};
  return job;
}

ReferenceJob specular_occlusion_job(const ReferenceRequest& request, const OptionSpelling&) {
  ReferenceJob job = job_with(request, ReferenceOptions(), &specular_occlusion_reference);
  job.reads = {"depth", "normal", "roughness"};
  job.heading = "GGX lobe";
  return job;
}

/// Options that not all kinds take, with what was given for them.
std::vector<std::pair<std::string, std::string>> special_options(const ReferenceRequest& request) {
  std::vector<std::pair<std::string, std::string>> given;
  if (request.radius) given.emplace_back("radius", fmt::format("{:g}", *request.radius));
  if (request.falloff != "none") given.emplace_back("falloff", request.falloff);
  if (request.bounces) given.emplace_back("bounces", fmt::format("{}", *request.bounces));
  return given;
}

/// Names of the kinds that take an option.
std::vector<std::string> takers_of(const std::string& option) {
  std::vector<std::string> names;
  for (const ReferenceKind& kind : reference_kinds()) {
    if (contains(kind.options, option)) names.push_back(kind.name);
  }
  return names;
}

void check_options(const ReferenceKind& kind, const ReferenceRequest& request, const OptionSpelling& spelled) {
  for (const auto& [option, value] : special_options(request)) {
    if (contains(kind.options, option)) continue;
    throw UsageError("{} {}: is for {}, and {} has none; leave it out", spelled(option), value,
                     enumerate(takers_of(option)), kind.name);
  }
  if (!request.falloff_settings.empty() && !contains(kind.options, "falloff"))
    throw UsageError("{} {}: sets a falloff, and {} has none; leave it out", spelled("set"),
                     request.falloff_settings.front().first, kind.name);
}

}  // namespace

std::string as_flag(const std::string& name) {
  std::string flag = "--" + name;
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

std::string as_keyword(const std::string& name) { return name; }

const std::vector<ReferenceKind>& reference_kinds() {
  static const std::vector<ReferenceKind> kinds = {
      {"ao", "share of the directions that are open", 256, {"radius", "falloff"}, ao_job},
      {"reflection", "light that a surface reflects to the eye", 1024, {}, reflection_job},
      {"bounces",
       "ambient light, with light that surfaces reflect among each other",
       256,
       {"radius", "bounces"},
       bounces_job},
      {"specular_occlusion", "share of a glossy lobe that is open", 256, {"radius"}, specular_occlusion_job},
  };
  return kinds;
}

std::vector<std::string> reference_names() {
  std::vector<std::string> names;
  for (const ReferenceKind& kind : reference_kinds()) names.push_back(kind.name);
  return names;
}

ReferenceJob job_of(const ReferenceRequest& request, const OptionSpelling& spelled) {
  for (const ReferenceKind& kind : reference_kinds()) {
    if (kind.name != request.what) continue;
    check_options(kind, request, spelled);
    ReferenceJob job = kind.job(request, spelled);
    job.plane = kind.name;
    return job;
  }
  const std::vector<std::string> names = reference_names();
  throw UsageError("reference: no '{}'{}; there are {}", request.what, suggestion(request.what, names),
                   enumerate(names));
}

}  // namespace gloam
