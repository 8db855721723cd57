#include "cli/reference_job.h"

#include <cmath>

#include "cli/memory.h"
#include "cli/radius.h"
#include "gloam/error.h"
#include "gloam/scene/reflection_reference.h"
#include "scene/falloff.h"

namespace gloam::cli {
namespace {

template <typename Options>
Options with_tracing(Options options, const TracingOfFrame& tracing) {
  options.seed = tracing.seed;
  options.checkpoint = tracing.checkpoint;
  options.progress = tracing.progress;
  return options;
}

ReferenceJob ao_job(ReferenceCommand& flags) {
  AoReferenceOptions options;
  options.samples = flags.samples.value_or(options.samples);
  set_falloff(options, flags.falloff, flags.scene.take_dotted_settings());
  ReferenceJob job;
  job.plane = "ao";
  job.reads = {"depth", "normal"};
  job.settings = {{"falloff", options.falloff}};
  job.heading = fmt::format("falloff {}", options.falloff);
  job.has_radius = true;
  job.needs_finite_radius = bool(options.contribution);
  job.trace = [options](const Tracer& tracer, const Frame& frame, double radius, const TracingOfFrame& tracing) {
    AoReferenceOptions of_frame = with_tracing(options, tracing);
    of_frame.radius = radius;
    return ao_reference(tracer, frame, of_frame);
  };
  return job;
}

ReferenceJob reflection_job(const ReferenceCommand& flags) {
  if (flags.radius) throw UsageError("--radius {}: a reflection has no radius; leave it out", *flags.radius);
  if (flags.falloff != "none")
    throw UsageError("--falloff {}: a reflection has no falloff; leave it out", flags.falloff);
  ReflectionReferenceOptions options;
  options.samples = flags.samples.value_or(options.samples);
  ReferenceJob job;
  job.plane = "reflection";
  job.reads = {"depth", "normal", "roughness", "reflectance"};
  job.settings = Json::object();
  job.heading = "two bounces";
  job.trace = [options](const Tracer& tracer, const Frame& frame, double, const TracingOfFrame& tracing) {
    return reflection_reference(tracer, frame, with_tracing(options, tracing));
  };
  return job;
}

}  // namespace

const std::vector<std::string>& reference_kinds() {
  static const std::vector<std::string> kinds = {"ao", "reflection"};
  return kinds;
}

ReferenceJob job_of(ReferenceCommand& flags) {
  if (!contains(reference_kinds(), flags.what))
    throw UsageError("reference: no '{}'{}; there are {}", flags.what, suggestion(flags.what, reference_kinds()),
                     enumerate(reference_kinds()));
  ReferenceJob job = flags.what == "ao" ? ao_job(flags) : reflection_job(flags);
  if (job.needs_finite_radius && flags.radius && !std::isfinite(*flags.radius))
    throw UsageError("--radius inf: the falloff of {} is in relation to the radius; give a finite one", flags.falloff);
  return job;
}

TracedFrame trace_frame(const ReferenceCommand& flags, const ReferenceJob& job, FrameFiles& files, SceneOfFrame& scene,
                        const TracingOfFrame& tracing) {
  const FrameFile& file = files.files().front();
  const std::string name = file.path().string();
  if (!contains(files.common_planes(), "depth")) throw Error("{}: has no depth; {}", name, holdings(file));
  const Scene& shown = scene.load_for(file);
  planned_memory(flags.frame_flags, name, process_bytes_with_device + 2 * bytes_to_read(files, job.reads),
                 "crop or shrink the frame");
  TracedFrame traced;
  traced.frame = files.read(job.reads);
  note(traced.frame.assumed);
  if (job.has_radius) traced.radius = radius_of_truth(flags.radius, stated_radius(file), shown, traced.frame);
  traced.truth = job.trace(scene.tracer(), traced.frame, traced.radius ? traced.radius->value : 0, tracing);
  return traced;
}

}  // namespace gloam::cli
