#include "shot/outputs.h"

#include <filesystem>

#include "base/lists.h"
#include "gloam/color_holds.h"
#include "gloam/error.h"
#include "gloam/exr_copy.h"

namespace gloam {
namespace {

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
  keep_planes(sources.colour, {"color", "alpha"});
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

std::vector<std::string> planes_of_file(const PlanRequest& request, const Plan& plan) {
  if (!request.only_outputs.empty()) return plan.outputs;
  std::vector<std::string> planes = {plan.outputs.front()};
  add_new(planes, request.with);
  return planes;
}

OutputSources read_sources(PlannedFrame& planned) {
  OutputSources sources;
  sources.file = planned.files.files().front().path().string();
  if (!planned.colour) return sources;
  sources.colour = read_layer(*planned.colour, sources.notes);
  if (composited_plane(planned.plan.outputs) != "reflection")
    add_new(sources.notes, notes_on_darkening(*planned.colour, sources.colour));
  sources.half_planes = planned.colour->half_planes;
  sources.part = planned.colour->part;
  sources.holds = planned.colour->files.files().front().text_attribute(color_holds_attribute);
  return sources;
}

std::string frame_seen_from(const std::string& frame, const std::string& out) {
  namespace fs = std::filesystem;
  return fs::absolute(frame)
      .lexically_normal()
      .lexically_proximate(fs::absolute(out).lexically_normal().parent_path())
      .generic_string();
}

void name_frame(Frame& result, const std::string& frame, const std::string& out) {
  std::error_code unknown;
  const auto bytes = std::filesystem::file_size(frame, unknown);
  if (unknown) return;
  result.attributes[frame_attribute] = frame_seen_from(frame, out);
  result.attributes[frame_bytes_attribute] = std::to_string(bytes);
}

std::vector<std::string> write_outputs(const FrameOutputs& outputs, OutputSources& sources, Frame& result,
                                       const OutputSettings& settings) {
  if (!outputs.out.empty()) {
    if (settings.names_frame) name_frame(result, sources.file, outputs.out);
    write_frame(outputs.out, result, settings.out);
  }
  const WriteOptions as_colour{.compression = settings.out.compression,
                               .half_planes = sources.half_planes,
                               .keeps_margin = settings.copy.keeps_margin};
  if (outputs.has_composite()) make_composite(sources, result, settings);
  if (!outputs.composite.empty())
    write_frame_like(outputs.composite, sources.file, sources.part, sources.colour, as_colour);
  if (outputs.into.empty())
    return outputs.composite.empty() ? std::vector<std::string>() : notes_on_cryptomattes(sources.file);
  keep_planes(result, settings.copied);
  std::vector<AddedPlanes> added = {{settings.copied.front(), &result, settings.copy}};
  if (outputs.composite_in_copy) added.push_back({composite_content, &sources.colour, as_colour});
  return write_copy(outputs.into, sources.file, added);
}

FrameOutputs ShotOutputs::of(int frame) const {
  const auto path_of = [&](const std::optional<FramePattern>& pattern) {
    return pattern ? pattern->path_of(frame).string() : "";
  };
  return {path_of(out), path_of(into), path_of(composite), composite_in_copy};
}

}  // namespace gloam
