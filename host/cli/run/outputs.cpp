#include "cli/run/outputs.h"

#include <filesystem>

#include "base/file_identity.h"
#include "cli/flags/result_name.h"
#include "gloam/error.h"

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
  if (flags.shot.keep_depth && flags.bare)
    throw UsageError("--keep-depth: --bare leaves the depth out; leave one of them out");
  if (flags.bare && !has_out && outputs.composite.empty()) refuse("--bare", "-o or --composite OUT.exr");
  if (flags.shot.as_float && !has_out && outputs.into.empty()) refuse("--float", "-o OUT.exr or --into COPY.exr");
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

}  // namespace

void settle_outputs(RunCommand& flags) {
  if (std::filesystem::path(flags.out).extension() == ".png" && !flags.frame.has_pattern()) {
    if (!flags.picture.empty())
      throw UsageError("-o {}: is a picture, and --picture {} another; leave one out", flags.out, flags.picture);
    flags.picture.swap(flags.out);
  }
  if (!flags.out.empty() || !flags.into.empty() || !flags.composite.path.empty() || !flags.picture.empty()) return;
  flags.out = name_beside(flags.frame, "run", flags.technique);
  flags.is_out_made = true;
}

std::vector<NamedPath> named(const FrameOutputs& outputs) {
  std::vector<NamedPath> asked_for;
  for (const NamedPath& each :
       {NamedPath{"-o", outputs.out}, {"--into", outputs.into}, {"--composite", outputs.composite}})
    if (!each.second.empty()) asked_for.push_back(each);
  return asked_for;
}

std::vector<std::string> paths_of(const FrameOutputs& outputs) {
  std::vector<std::string> paths;
  for (const auto& [flag, path] : named(outputs)) paths.push_back(path);
  return paths;
}

FrameOutputs outputs_of(const RunCommand& flags) {
  const std::string& composite = flags.composite.path;
  const bool in_copy = !composite.empty() && !flags.into.empty() && are_same_file(composite, flags.into);
  return {flags.out, flags.into, in_copy ? "" : composite, in_copy};
}

void check(const FrameOutputs& outputs, const RunCommand& flags) {
  for (const auto& [flag, path] : named(outputs)) check_frame_name(path, flag);
  check_of_files_written(outputs, flags);
  if (!outputs.into.empty() && !flags.frame.other_eye.empty())
    throw UsageError("--into {}: copies one file, and the two eyes are in two; write the results with -o",
                     outputs.into);
}

OutputSettings output_settings(const RunCommand& flags, const PlanRequest& request, const Plan& plan) {
  // A history keeps its digits.
  const bool is_history = is_temporal(flags) && !flags.frame.has_pattern();
  const bool half = flags.half || !(flags.shot.as_float || is_history);
  OutputSettings settings{{half, flags.compression}, {!flags.shot.as_float, flags.compression}, {}};
  settings.out.shows_result = true;
  settings.copy.keeps_margin = flags.shot.keep_margin;
  settings.out.keeps_margin = flags.shot.keep_margin || is_history;
  settings.names_frame =
      !flags.frame.has_pattern() && flags.frame.other_eye.empty() && !flags.frame_flags.changes_depth();
  if (!flags.shot.as_float) settings.copy.half_planes = {"reflection"};
  settings.copied = planes_of_file(request, plan);
  if (!flags.composite.path.empty()) settings.composited = plane_to_composite(flags.composite, plan);
  settings.compositing = flags.composite.how();
  settings.has_cameras = !flags.bare;
  return settings;
}

ShotOutputs outputs_of_shot(const FrameOutputs& outputs, const std::string& shot, NamedPatterns& patterns) {
  for (const auto& [flag, path] : named(outputs)) {
    if (!FramePattern::is_pattern(path))
      throw UsageError("{} {}: is one file, and {} a shot; write both as patterns, such as ao.####.exr", flag, path,
                       shot);
    patterns.emplace_back(flag, FramePattern(path, flag));
  }
  const auto pattern_of = [&](const std::string& name) {
    for (const auto& [flag, pattern] : patterns)
      if (flag == name) return std::optional(pattern);
    return std::optional<FramePattern>();
  };
  return {pattern_of("-o"), pattern_of("--into"), pattern_of("--composite"), outputs.composite_in_copy};
}

}  // namespace gloam::cli
