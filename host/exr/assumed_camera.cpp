#include "exr/assumed_camera.h"

#include "base/lists.h"
#include "frame/field_of_view.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {
namespace {

constexpr double assumed_fov = 60;

}  // namespace

void assume_missing_camera(const ExrFile& file, const FileCameras& known, View& view, Frame& frame) {
  if (view.camera) return;
  view.camera = camera_from_fov(assumed_fov, file.display, file.pixel_aspect, "assumed 60 degrees");
  view.camera->near = file.options.near;
  view.camera->far = file.options.far;
  const auto pose = known.poses.find(view.name);
  if (pose != known.poses.end()) view.camera->pose = pose->second;
  if (!view.find("depth") && !view.find("normal")) return;
  // Another note already says why a JSON or an incomplete header was not used.
  const bool is_explained = !known.json_misfit.empty() || pose != known.poses.end();
  const char* none = is_explained ? "" : "none by flag, header or a JSON beside the file; ";
  // gloam info has these lines below its notes.
  const bool has_lines = !file.headers.text("BlenderMultiChannel").empty() && !file.options.only_looks;
  add_new(frame.assumed, fmt::format("camera: {}a horizontal field of view of {:g} degrees is assumed ({}, {}{})", none,
                                     assumed_fov, option("fov"), option("camera"),
                                     has_lines ? "; gloam info prints lines with which Blender writes it" : ""));
}

}  // namespace gloam
