#include "scene/reference_kinds.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/lists.h"
#include "base/words.h"
#include "gloam/environment_file.h"
#include "gloam/error.h"
#include "gloam/scene/bounces_reference.h"
#include "gloam/scene/composite_reference.h"
#include "gloam/scene/contact_reference.h"
#include "gloam/scene/environment_reference.h"
#include "gloam/scene/indirect_reference.h"
#include "gloam/scene/reflection_reference.h"
#include "gloam/scene/specular_occlusion_reference.h"
#include "scene/falloff.h"
#include "scene/fingerprint.h"
#include "scene/scene_checks.h"

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

ReferenceJob indirect_job(const ReferenceRequest& request, const OptionSpelling&) {
  ReferenceJob job = job_with(request, ReferenceOptions(), &indirect_reference);
  job.heading = "light from the first surfaces met";
  return job;
}

std::shared_ptr<const EnvironmentMap> environment_of(const ReferenceRequest& request) {
  return std::make_shared<EnvironmentMap>(read_environment(request.environment,
                                                           request.environment_axes.value_or(EnvironmentAxes::openexr),
                                                           request.environment_turn.value_or(0)));
}

/// Says what the light is, in place of the name of its file.
std::string identity_of(const EnvironmentMap& map) {
  Fingerprint print;
  print.add(map.texels());
  return "environment " + print.text();
}

ReferenceJob environment_job(const ReferenceRequest& request, const OptionSpelling& spelled) {
  if (request.environment.empty())
    throw UsageError("reference environment: needs the light; give {} FILE.exr", spelled("environment"));
  const auto map = environment_of(request);
  ReferenceOptions options;
  options.samples = request.samples.value_or(options.samples);
  ReferenceJob job;
  job.reads = {"depth", "normal"};
  job.radius = request.radius;
  job.heading = fmt::format("environment of {} x {}", map->width(), map->height());
  job.words = {{"environment", request.environment}};
  job.identity = identity_of(*map);
  job.trace = [options, map](const Tracer& tracer, const Frame& frame, const ReferenceOptions& of_frame) {
    return environment_reference(tracer, frame, *map, for_frame(options, of_frame));
  };
  return job;
}

ReferenceJob contact_job(const ReferenceRequest& request, const OptionSpelling& spelled) {
  ContactReferenceOptions options;
  if (request.light_direction && request.light_position)
    throw UsageError("{} and {} are two lights; give one of them", spelled("light_direction"),
                     spelled("light_position"));
  options.light_direction = request.light_direction;
  options.light_position = request.light_position;
  options.light_angle = request.light_angle.value_or(0);
  ReferenceJob job = job_with(request, options, &contact_reference);
  job.radius = request.length;
  job.heading = options.light_position    ? "light at a position"
                : options.light_direction ? "light from a direction"
                                          : "the scene's sun";
  if (options.light_angle > 0) job.heading += fmt::format(", a disc of {:g} degrees", options.light_angle);
  job.numbers = {{"light_angle", options.light_angle}};
  return job;
}

ReferenceJob composite_job(const ReferenceRequest& request, const OptionSpelling& spelled) {
  CompositeReferenceOptions options;
  options.samples = request.samples.value_or(options.samples);
  options.reflection_samples = request.samples.value_or(options.reflection_samples);
  options.holds = request.color_holds;
  options.ambient = request.ambient;
  if (request.environment.empty() && (request.environment_axes || request.environment_turn))
    throw UsageError("{}: is of an environment; give {} FILE.exr too",
                     spelled(request.environment_axes ? "environment_axes" : "environment_turn"),
                     spelled("environment"));
  if (request.ambient &&
      std::any_of(request.ambient->begin(), request.ambient->end(), [](double x) { return !(x >= 0); }))
    throw UsageError("{} {:g}: is a radiance; numbers from 0 on are allowed", spelled("ambient"),
                     fmt::join(*request.ambient, ","));
  ReferenceJob job;
  if (!request.environment.empty()) {
    options.environment = environment_of(request);
    job.words = {{"environment", request.environment}};
    job.identity = identity_of(*options.environment);
  }
  job.plane = "color";
  job.reads = {"depth", "normal", "roughness", "reflectance"};
  add_new(job.reads, planes_to_compose());
  job.radius = request.radius;
  job.heading = "the whole picture";
  job.noise_from = "the noises of its parts";
  job.trace = [options](const Tracer& tracer, const Frame& frame, const ReferenceOptions& of_frame) {
    return composite_reference(tracer, frame, for_frame(options, of_frame));
  };
  return job;
}

/// Options that not all kinds take, with what was given for them.
std::vector<std::pair<std::string, std::string>> special_options(const ReferenceRequest& request) {
  std::vector<std::pair<std::string, std::string>> given;
  if (request.radius) given.emplace_back("radius", fmt::format("{:g}", *request.radius));
  if (request.falloff != "none") given.emplace_back("falloff", request.falloff);
  if (request.bounces) given.emplace_back("bounces", fmt::format("{}", *request.bounces));
  if (request.length) given.emplace_back("length", fmt::format("{:g}", *request.length));
  if (request.light_direction) given.emplace_back("light_direction", in_words(*request.light_direction));
  if (request.light_position) given.emplace_back("light_position", in_words(*request.light_position));
  if (request.light_angle) given.emplace_back("light_angle", fmt::format("{:g}", *request.light_angle));
  if (!request.environment.empty()) given.emplace_back("environment", request.environment);
  if (request.environment_axes)
    given.emplace_back("environment_axes", word_for(*request.environment_axes, environment_axes()));
  if (request.environment_turn) given.emplace_back("environment_turn", fmt::format("{:g}", *request.environment_turn));
  if (request.color_holds) given.emplace_back("color_holds", in_words(*request.color_holds));
  if (request.ambient) given.emplace_back("ambient", fmt::format("{:g}", fmt::join(*request.ambient, ",")));
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
      {"indirect", "light from the surfaces around, by one reflection", 256, {"radius"}, indirect_job},
      {"environment",
       "light of an environment from open directions",
       256,
       {"radius", "environment", "environment_axes", "environment_turn"},
       environment_job},
      {"contact",
       "share of a light that arrives past what is near",
       256,
       {"length", "light_direction", "light_position", "light_angle"},
       contact_job},
      {"composite",
       "colour with all of these parts of its light, each once",
       256,
       {"radius", "environment", "environment_axes", "environment_turn", "color_holds", "ambient"},
       composite_job},
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
    if (job.plane.empty()) job.plane = kind.name;
    return job;
  }
  const std::vector<std::string> names = reference_names();
  throw UsageError("reference: no '{}'{}; there are {}", request.what, suggestion(request.what, names),
                   enumerate(names));
}

}  // namespace gloam
