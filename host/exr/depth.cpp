#include "exr/depth.h"

#include <algorithm>

#include "base/lists.h"
#include "exr/errors.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "normalise/depth.h"

namespace gloam {
namespace {

bool holds(const Channel& channel, float value) {
  for (int y = 0; y < channel.layout().height; ++y)
    if (const float* row = channel.row(y);
        std::find(row, row + channel.layout().width, value) != row + channel.layout().width)
      return true;
  return false;
}

bool all_background(const Channel& depth) {
  for (int y = 0; y < depth.layout().height; ++y)
    if (const float* row = depth.row(y); !std::all_of(row, row + depth.layout().width, is_background)) return false;
  return true;
}

/// The options, with the file's declared convention in place of `automatic`.
ReadOptions with_declared_depth(const ExrFile& file, const PlaneSource& depth, std::vector<std::string>& assumed) {
  ReadOptions options = file.options;
  if (options.depth != DepthConvention::automatic) return options;
  if (depth.said == DeclaredConvention::planar || file.headers.has("gloamOrigin")) options.depth = DepthConvention::z;
  if (depth.said == DeclaredConvention::ray_distance) {
    options.depth = DepthConvention::ray;
    add_new(assumed,
            fmt::format("depth: '{}' is taken as the distance along the ray, as its renderer writes it (--depth z "
                        "says otherwise)",
                        depth.channels.front().name));
  }
  return options;
}

}  // namespace

std::string declared_depth_convention(const ExrFile& file) {
  const std::vector<PlaneSource>& planes = file.names.planes;
  const auto depth = std::find_if(planes.begin(), planes.end(), [](const auto& p) { return p.plane == "depth"; });
  if (depth == planes.end()) return "";
  switch (file.options.depth) {
    case DepthConvention::ray:
      return "ray";
    case DepthConvention::ndc:
      return "ndc";
    case DepthConvention::reversed:
      return "reversed";
    case DepthConvention::z:
      return "z";
    default:
      return depth->said == DeclaredConvention::ray_distance ? "ray" : "z";
  }
}

bool has_named_background(const ExrFile& file, const View& view) {
  const Plane* depth = view.find("depth");
  return depth && file.options.background && holds(depth->channels.front(), *file.options.background);
}

std::string convert_depth(const ExrFile& file, View& view, Frame& frame) {
  const auto found = view.planes.find("depth");
  if (found == view.planes.end()) return "";
  Channel& depth = found->second.channels.front();
  const ReadOptions options = with_declared_depth(file, *file.source("depth", view.name), frame.assumed);
  const Plane* alpha = view.find("alpha");
  std::vector<std::string> notes;
  const std::string convention = named(file.path, [&] {
    return to_view_depth(depth, alpha ? &alpha->channels.front() : nullptr, file.window, *view.camera, options, notes);
  });
  if (all_background(depth))
    notes.push_back(fmt::format("depth: no pixel{} has a usable depth; all of it is background",
                                view.name.empty() ? "" : " of view '" + view.name + "'"));
  add_new(frame.assumed, notes);
  return convention;
}

void note_missing_background(const ExrFile& file, Frame& frame) {
  const bool has_depth = std::any_of(frame.views.begin(), frame.views.end(), [](View& v) { return v.find("depth"); });
  if (file.options.background && has_depth)
    add_new(frame.assumed, fmt::format("depth: no pixel is {:.9g} (--background)", *file.options.background));
}

}  // namespace gloam
