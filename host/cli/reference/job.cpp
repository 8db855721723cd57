#include "cli/reference/job.h"

#include "cli/flags/memory.h"
#include "cli/flags/radius.h"
#include "gloam/error.h"
#include "gloam/margin.h"
#include "scene/falloff.h"

namespace gloam::cli {

TracedFrame trace_frame(const ReferenceCommand& flags, const ReferenceJob& job, FrameFiles& files, SceneOfFrame& scene,
                        ReferenceOptions options) {
  const FrameFile& file = files.files().front();
  const std::string name = file.path().string();
  if (!contains(files.common_planes(), "depth")) throw Error("{}: has no depth; {}", name, holdings(file));
  const Scene& shown = scene.load_for(file);
  planned_memory(flags.frame_flags, name, process_bytes_with_device + 2 * bytes_to_read(files, job.reads),
                 "crop or shrink the frame");
  TracedFrame traced;
  traced.frame = files.read(job.reads);
  if (contains(job.reads, "color"))
    traced.frame.attributes[color_holds_attribute] = file.text_attribute(color_holds_attribute);
  note(traced.frame.assumed);
  note(notes_on_margin(traced.frame, flags.keep_margin, flags.keep_margin));
  if (!flags.keep_margin) leave_out_margin(traced.frame);
  if (job.has_radius) {
    traced.radius = radius_of_truth(job.radius, stated_radius(file), shown, traced.frame);
    options.radius = traced.radius->value;
  }
  traced.truth = job.trace(scene.tracer(), traced.frame, options);
  return traced;
}

}  // namespace gloam::cli
