#include "exr/depth.h"

#include <algorithm>
#include <cmath>

#include "base/lists.h"
#include "exr/depth_of_positions.h"
#include "exr/errors.h"
#include "exr/normals_beside.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "normalise/depth.h"
#include "normalise/stored_depth.h"

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

/// Values that are no lengths.
bool is_mapped(DepthConvention convention) {
  return is_window_depth(convention) || convention == DepthConvention::inverse;
}

/// What positions tell of a depth; `unknown` where they tell nothing, or are not asked.
DepthRelation relation_to_positions(const ExrFile& file, const FileCameras& cameras, const View& view) {
  const auto found = cameras.positions.find(view.name);
  if (found == cameras.positions.end() || is_mapped(file.options.depth)) return {};
  if (file.options.depth_offset) return {};  // positions are compared with what is stored
  DepthRelation relation = found->second.depth;
  relation.scale *= file.options.depth_scale.value_or(1);
  return relation;
}

/// Takes the convention that the positions show, unless a flag states one. Returns whether they show any.
bool take_shown_depth(const PlaneSource& depth, const DepthRelation& relation, ReadOptions& options,
                      std::vector<std::string>& assumed) {
  const std::string& name = depth.channels.front().name;
  const bool is_free = options.depth == DepthConvention::automatic;
  if (relation.kind == DepthRelation::unknown) return false;
  if (relation.kind == DepthRelation::neither) {
    if (is_free)
      add_new(assumed,
              fmt::format(
                  "depth: '{}' is neither the planar distance of the positions nor their distance along the ray ({})",
                  name, option("depth")));
    return false;
  }
  const bool is_ray = relation.kind == DepthRelation::along_ray;
  const DepthConvention shown = is_ray ? DepthConvention::ray : DepthConvention::z;
  const char* words = is_ray ? "the distance along the ray" : "the planar distance";
  if (!is_free && options.depth != shown)
    add_new(assumed,
            fmt::format("depth: {} overrules the positions, by which '{}' is {}", option("depth"), name, words));
  if (!is_free) return true;
  if (is_ray || depth.said == DeclaredConvention::ray_distance)
    add_new(assumed, fmt::format("depth: '{}' is {}, as the positions show", name, words));
  options.depth = shown;
  return true;
}

/// Brings depth to the units of the positions, and so of the camera's place.
void scale_to_positions(const PlaneSource& source, double scale, Channel& depth, std::vector<std::string>& assumed) {
  if (std::abs(scale - 1) <= 0.01) return;
  for (int y = 0; y < depth.layout().height; ++y)
    for (float* z = depth.row(y); z != depth.row(y) + depth.layout().width; ++z) *z = float(*z / scale);
  add_new(
      assumed,
      fmt::format("depth: '{}' is {:.6g} times as long as the positions say: it is divided by that, and lengths are "
                  "in the units of the positions",
                  source.channels.front().name, scale));
}

/// The options, with the file's declared convention in place of `automatic`.
ReadOptions with_declared_depth(const ExrFile& file, const PlaneSource& depth, const DepthRelation& relation,
                                std::vector<std::string>& assumed) {
  ReadOptions options = file.options;
  if (take_shown_depth(depth, relation, options, assumed)) return options;
  if (options.depth != DepthConvention::automatic) return options;
  const bool is_of_own_file = file.options.plane_files.contains("depth");  // of which the frame's header says nothing
  if (depth.said == DeclaredConvention::planar || (file.headers.has("gloamOrigin") && !is_of_own_file))
    options.depth = DepthConvention::z;
  if (depth.said == DeclaredConvention::ray_distance) {
    options.depth = DepthConvention::ray;
    add_new(
        assumed,
        fmt::format("depth: '{}' is taken as the distance along the ray, as its renderer writes it ({} says otherwise)",
                    depth.channels.front().name, option("depth", "z")));
  }
  return options;
}

/// What is stated of the depth, or else what was found of it for the whole shot that the frame belongs to.
StatedDepth with_shot(const ExrFile& file, const ReadOptions& options, std::vector<std::string>& notes) {
  if (options.depth != DepthConvention::automatic || !options.shot_depth) return options.stated_depth();
  const FoundDepth shot = options.shot_depth(file.path);
  if (!shot.read) return options.stated_depth();
  add_new(notes, shot.notes);
  return *shot.read;
}

}  // namespace

std::string declared_depth_convention(const ExrFile& file) {
  const std::vector<PlaneSource>& planes = file.names.planes;
  const auto depth = std::find_if(planes.begin(), planes.end(), [](const auto& p) { return p.plane == "depth"; });
  if (depth == planes.end()) return "";
  if (depth->said == DeclaredConvention::made_of_positions) return "z";
  switch (file.options.depth) {
    case DepthConvention::ray:
      return "ray";
    case DepthConvention::ndc:
      return "ndc";
    case DepthConvention::reversed:
      return "reversed";
    case DepthConvention::inverse:
      return "inverse";
    case DepthConvention::z:
      return "z";
    default:
      return depth->said == DeclaredConvention::ray_distance ? "ray" : "z";
  }
}

bool has_named_background(const ExrFile& file, const View& view) {
  const Plane* depth = view.find("depth");
  return depth && file.options.background && !is_made_of_positions(file, view.name) &&
         holds(depth->channels.front(), *file.options.background);
}

std::string convert_depth(const ExrFile& file, const FileCameras& cameras, View& view, Frame& frame,
                          FoundDepth& found) {
  const auto plane = view.planes.find("depth");
  if (plane == view.planes.end()) return "";
  if (is_made_of_positions(file, view.name)) {
    make_depth(file, cameras.positions.at(view.name), view, frame);
    return "z";
  }
  Channel& depth = plane->second.channels.front();
  const PlaneSource& source = *file.source("depth", view.name);
  const DepthRelation relation = relation_to_positions(file, cameras, view);
  const ReadOptions options = with_declared_depth(file, source, relation, frame.assumed);
  const Plane* alpha = view.find("alpha");
  std::vector<std::string> notes;
  const std::string convention = named(file.path, [&] {
    const StatedDepth stated = with_shot(file, options, notes);
    const bool is_untold = stated.convention == DepthConvention::automatic;
    const bool is_wrapped = stated.encoding && stated.encoding->wrapped;
    const std::optional<NormalsBeside> normals =
        is_untold || is_wrapped ? normals_beside(file, cameras, view) : std::nullopt;
    return to_view_depth(depth, alpha ? &alpha->channels.front() : nullptr, file.window, *view.camera, stated, notes,
                         normals ? &*normals : nullptr, found.read ? nullptr : &found);
  });
  scale_to_positions(source, relation.scale, depth, notes);
  const bool is_half = std::all_of(source.channels.begin(), source.channels.end(),
                                   [](const ChannelSource& channel) { return channel.type == "half"; });
  if (!is_mapped(options.depth)) {  // whose steps are those of the map, and not told
    const std::string steps =
        note_on_steps([&](int x, int y) { return depth.at(x, y); }, depth.layout(), *view.camera, is_half);
    if (!steps.empty()) notes.push_back(steps);
  }
  if (all_background(depth))
    notes.push_back(fmt::format("depth: no pixel{} has a usable depth; all of it is background",
                                view.name.empty() ? "" : " of view '" + view.name + "'"));
  add_new(frame.assumed, notes);
  return convention;
}

void note_missing_background(const ExrFile& file, Frame& frame) {
  const bool has_depth = std::any_of(frame.views.begin(), frame.views.end(), [](View& v) { return v.find("depth"); });
  if (file.options.background && has_depth)
    add_new(frame.assumed,
            fmt::format("depth: no pixel is {:.9g} ({})", *file.options.background, option("background")));
}

}  // namespace gloam
