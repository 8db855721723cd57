#include "exr/conversion.h"

#include "base/lists.h"
#include "exr/assumed_camera.h"
#include "exr/depth.h"
#include "exr/fills.h"
#include "exr/view_planes.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/unfit.h"
#include "normalise/normalise.h"

namespace gloam {
namespace {

/// Positions are in the world, and of no use without a pose.
void drop_positions_without_pose(const FileCameras& cameras, View& view, Frame& frame) {
  const auto findings = cameras.positions.find(view.name);
  if (findings != cameras.positions.end() && findings->second.in_camera_space) {
    view.planes.erase("position");  // a note says so
    return;
  }
  if (view.camera->pose || view.planes.erase("position") == 0) return;
  add_new(frame.assumed, "positions: not used, since the camera's pose is unknown (" + option("camera") + " gives it)");
}

}  // namespace

void Conventions::take(const std::string& depth_convention) {
  if (!depth_convention.empty()) depth = depth_convention;
}

void Conventions::take(const std::optional<NormalForm>& form) {
  if (form) normal_space = form->space == NormalSpace::world ? "world" : "view";
}

void Conventions::take(const Conventions& found) {
  take(found.depth);
  if (!found.normal_space.empty()) normal_space = found.normal_space;
  normals = found.normals;
  read_depth = found.read_depth;
}

std::vector<std::string> planes_to_decode(const std::vector<std::string>& asked) {
  std::vector<std::string> planes;
  add_new(planes, asked);
  if (contains(planes, "normal")) add_new(planes, "depth");
  return planes;
}

void note_assumptions(const ExrFile& file, const FileCameras& cameras, const std::vector<std::string>& asked,
                      Frame& frame) {
  const auto& by_plane = file.names.assumed;
  if (const auto general = by_plane.find(""); general != by_plane.end()) add_new(frame.assumed, general->second);
  for (const std::string& plane : planes_to_decode(asked))
    if (const auto notes = by_plane.find(plane); notes != by_plane.end()) add_new(frame.assumed, notes->second);
  add_new(frame.assumed, unused_planes(file.names.planes, file.names.views, asked, option("view") + " chooses one"));
  add_new(frame.assumed, file.notes);
  add_new(frame.assumed, cameras.notes);
}

void convert_planes(const ExrFile& file, const FileCameras& cameras, Frame& frame, Conventions& conventions) {
  bool has_background = false;
  LightCounts light;
  for (View& view : frame.views) {
    assume_missing_camera(file, cameras, view, frame);
    has_background |= has_named_background(file, view);
    conventions.take(convert_depth(file, cameras, view, frame, conventions.read_depth));
    conventions.take(convert_normals(file, view, frame, conventions.normals));
    note_fills(file, view, frame);
    light.add(view, view.find("depth"));
    if (!file.options.as_stored) drop_positions_without_pose(cameras, view, frame);
  }
  if (!has_background) note_missing_background(file, frame);
  note_light(file, light, frame);
}

void finish_frame(const ExrFile& file, Frame& frame) {
  if (!file.options.unconverted) normalise_planes(frame, file.options.background, file.options.as_stored);
  for (std::string& sentence : frame.assumed) sentence = printable(sentence);
}

void note_light(const ExrFile& file, const LightCounts& counts, Frame& frame) {
  std::vector<std::string> judged;  // a user who names a channel means it
  for (const char* plane : {"color", "albedo"})
    if (!file.options.channels.contains(plane)) judged.emplace_back(plane);
  if (counts.color.pixels > 0) {
    for (const View& view : frame.views) {
      const PlaneSource* color = file.source("color", view.name);
      if (!color || color->channels.empty()) continue;
      const std::string space = file.headers.text_for_part(color->channels.front().part, "colorInteropID");
      if (is_linear(space)) continue;
      const std::string why = fmt::format(
          "the header's colorInteropID '{}' names no scene-linear light, and the values are taken for it as they are",
          space);
      add_new(frame.assumed, contains(judged, "color") ? note_on({"color", why}) : "color: " + why);
    }
  }
  add_new(frame.assumed, counts.notes(judged));
}

}  // namespace gloam
