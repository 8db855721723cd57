#include "cli/run_outputs.h"

#include "gloam/error.h"
#include "gloam/exr_copy.h"

namespace gloam::cli {
namespace {

/// The planes asked for, else what a shot's file holds: the first output, with the extras.
std::vector<std::string> planes_for_copy(const PlanRequest& request, const Plan& plan) {
  if (!request.only.empty()) return plan.outputs;
  std::vector<std::string> planes = {plan.outputs.front()};
  add_new(planes, request.with);
  return planes;
}

void keep_planes(Frame& frame, const std::vector<std::string>& planes) {
  for (View& view : frame.views)
    std::erase_if(view.planes, [&](const auto& plane) { return !contains(planes, plane.first); });
}

}  // namespace

std::vector<std::string> FrameOutputs::paths() const {
  std::vector<std::string> paths;
  for (const auto& [flag, path] : named()) {
    if (!path.empty()) paths.push_back(path);
  }
  return paths;
}

FrameOutputs outputs_of(const RunCommand& flags) { return {flags.out, flags.into}; }

void check(const FrameOutputs& outputs, const FrameArguments& frame) {
  if (outputs.paths().empty()) throw UsageError("nothing is to be written; give -o OUT.exr, or --into COPY.exr");
  for (const auto& [flag, path] : outputs.named()) {
    if (!path.empty()) check_frame_name(path, flag);
  }
  if (!outputs.into.empty() && !frame.other_eye.empty())
    throw UsageError("--into {}: copies one file, and the two eyes are in two; write the results with -o",
                     outputs.into);
}

OutputSettings output_settings(const RunCommand& flags, bool half, const PlanRequest& request, const Plan& plan) {
  OutputSettings settings{{half, flags.compression}, {!flags.shot.as_float, flags.compression}, {}};
  if (!flags.shot.as_float) settings.copy.half_planes = {"reflection"};
  settings.copied = planes_for_copy(request, plan);
  return settings;
}

std::vector<std::string> write_outputs(const FrameOutputs& outputs, const std::string& input, Frame& result,
                                       const OutputSettings& settings) {
  if (!outputs.out.empty()) write_frame(outputs.out, result, settings.out);
  if (outputs.into.empty()) return {};
  keep_planes(result, settings.copied);
  return write_copy(outputs.into, input, {{settings.copied.front(), &result, settings.copy}});
}

ShotOutputs::ShotOutputs(const FrameOutputs& named, const std::string& shot) {
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
    (flag == "-o" ? paths.out : paths.into) = pattern.path_of(frame).string();
  return paths;
}

}  // namespace gloam::cli
