#include "cli/run/outputs.h"

#include "base/file_identity.h"
#include "gloam/color_holds.h"
#include "gloam/error.h"
#include "gloam/exr_copy.h"

namespace gloam::cli {
namespace {

/// Throws UsageError for a flag that has no effect on any of the files.
void check_of_files_written(const FrameOutputs& outputs, const RunCommand& flags) {
  const bool has_out = !outputs.out.empty();
  const auto refuse = [](const char* flag, const char* of) {
    throw UsageError("{}: changes the file of {}, which is not given; leave it out", flag, of);
  };
  if (flags.half && !has_out) refuse("--half", "-o OUT.exr");
  if (flags.shot.keep_depth && !has_out) refuse("--keep-depth", "-o OUT.exr");
  if (flags.bare && !has_out && outputs.composite.empty()) refuse("--bare", "-o or --composite OUT.exr");
  if (flags.shot.as_float && !has_out && outputs.into.empty()) refuse("--float", "-o OUT.exr or --into COPY.exr");
}

/// The planes asked for, else what a shot's file holds: the first output, with the extras.
std::vector<std::string> planes_for_copy(const PlanRequest& request, const Plan& plan) {
  if (!request.only_outputs.empty()) return plan.outputs;
  std::vector<std::string> planes = {plan.outputs.front()};
  add_new(planes, request.with);
  return planes;
}

/// The plane that a composite is made with.
std::string plane_to_composite(const CompositeFlags& flags, const Plan& plan) {
  const std::string plane = composited_plane(plan.outputs);
  if (plane.empty())
    throw UsageError("--composite {}: is made with 'ao' or 'reflection', and {} makes only {}", flags.path,
                     plan.technique, enumerate(plan.outputs));
  if (plane == "reflection" && flags.tint)
    throw UsageError("--tint: colours ambient occlusion, and '{}' makes a reflection, which is added; leave it out",
                     plan.technique);
  return plane;
}

/// What the composite holds; empty if the file does not state what its colour does.
std::string holds_of_composite(const OutputSources& sources, const std::string& plane) {
  if (sources.holds.empty()) return "";
  ColorHolds holds = parse_color_holds(sources.holds, fmt::format("{}: {}", sources.file, color_holds_attribute));
  if (plane == "reflection")
    holds.reflection = true;
  else
    holds.ambient = holds.ao = true;
  return in_words(holds);
}

/// Lays the result over the colour, and takes over how it was made.
void make_composite(OutputSources& sources, const Frame& result, const OutputSettings& settings) {
  const Compositing& how = settings.compositing;
  composite(sources.colour, result, settings.composited, how);
  sources.colour.attributes = result.attributes;
  sources.colour.attributes["gloamComposite"] =
      fmt::format("{} strength={} tint={}", settings.composited, how.strength, fmt::join(how.tint, ","));
  if (const std::string holds = holds_of_composite(sources, settings.composited); !holds.empty())
    sources.colour.attributes[color_holds_attribute] = holds;
  for (View& view : sources.colour.views) {
    if (!settings.has_cameras) view.camera.reset();
  }
}

}  // namespace

std::vector<std::string> FrameOutputs::paths() const {
  std::vector<std::string> paths;
  for (const auto& [flag, path] : named()) {
    if (!path.empty()) paths.push_back(path);
  }
  return paths;
}

FrameOutputs outputs_of(const RunCommand& flags) {
  const std::string& composite = flags.composite.path;
  const bool in_copy = !composite.empty() && !flags.into.empty() && are_same_file(composite, flags.into);
  return {flags.out, flags.into, in_copy ? "" : composite, in_copy};
}

void check(const FrameOutputs& outputs, const RunCommand& flags) {
  if (outputs.paths().empty())
    throw UsageError("run: nothing is to be written; give --output OUT.exr, --into COPY.exr or --composite OUT.exr");
  for (const auto& [flag, path] : outputs.named()) {
    if (!path.empty()) check_frame_name(path, flag);
  }
  check_of_files_written(outputs, flags);
  if (!outputs.into.empty() && !flags.frame.other_eye.empty())
    throw UsageError("--into {}: copies one file, and the two eyes are in two; write the results with -o",
                     outputs.into);
}

OutputSettings output_settings(const RunCommand& flags, bool half, const PlanRequest& request, const Plan& plan) {
  OutputSettings settings{{half, flags.compression}, {!flags.shot.as_float, flags.compression}, {}};
  if (!flags.shot.as_float) settings.copy.half_planes = {"reflection"};
  settings.copied = planes_for_copy(request, plan);
  if (!flags.composite.path.empty()) settings.composited = plane_to_composite(flags.composite, plan);
  settings.compositing = flags.composite.how();
  settings.has_cameras = !flags.bare;
  return settings;
}

OutputSources read_sources(PlannedFrame& planned) {
  OutputSources sources;
  sources.file = planned.files.files().front().path().string();
  if (!planned.colour) return sources;
  sources.colour = read_layer(*planned.colour, sources.notes);
  sources.half_planes = planned.colour->half_planes;
  sources.part = planned.colour->part;
  sources.holds = planned.colour->files.files().front().text_attribute(color_holds_attribute);
  return sources;
}

std::vector<std::string> write_outputs(const FrameOutputs& outputs, OutputSources& sources, Frame& result,
                                       const OutputSettings& settings) {
  if (!outputs.out.empty()) write_frame(outputs.out, result, settings.out);
  const WriteOptions as_colour{false, settings.out.compression, sources.half_planes};
  if (outputs.has_composite()) make_composite(sources, result, settings);
  if (!outputs.composite.empty())
    write_frame_like(outputs.composite, sources.file, sources.part, sources.colour, as_colour);
  if (outputs.into.empty()) return {};
  keep_planes(result, settings.copied);
  std::vector<AddedPlanes> added = {{settings.copied.front(), &result, settings.copy}};
  if (outputs.composite_in_copy) added.push_back({composite_content, &sources.colour, as_colour});
  return write_copy(outputs.into, sources.file, added);
}

ShotOutputs::ShotOutputs(const FrameOutputs& named, const std::string& shot) {
  composite_in_copy_ = named.composite_in_copy;
  for (const auto& [flag, path] : named.named()) {
    if (path.empty()) continue;
    if (!FramePattern::is_pattern(path))
      throw UsageError("{} {}: is one file, and {} a shot; write both as patterns, such as ao.####.exr", flag, path,
                       shot);
    patterns_.emplace_back(flag, FramePattern(path, flag));
  }
}

FrameOutputs ShotOutputs::of(int frame) const {
  FrameOutputs paths;
  for (const auto& [flag, pattern] : patterns_)
    (flag == "-o" ? paths.out : flag == "--into" ? paths.into : paths.composite) = pattern.path_of(frame).string();
  paths.composite_in_copy = composite_in_copy_;
  return paths;
}

}  // namespace gloam::cli
