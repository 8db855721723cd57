#include "exr/header_cameras.h"

#include "base/lists.h"
#include "camera/matrices.h"
#include "exr/attributes.h"
#include "gloam/display_json.h"
#include "gloam/error.h"
#include "gloam/light_field.h"

namespace gloam {
namespace {

std::optional<Imath::M44d> matrix(const AttributePlace& place, const char* name) {
  return matrix_attribute(*place.header, place.prefix + name);
}

glm::dvec3 origin(const AttributePlace& place) {
  return origin_attribute(*place.header, place.prefix).value_or(glm::dvec3(0.0));
}

bool declares_unknown_pose(const AttributePlace& place) {
  return text_attribute(*place.header, place.prefix + "gloamPose") == "unknown";
}

void note_unusable(const std::string& what, std::vector<std::string>& notes) {
  add_new(notes, fmt::format("camera: {} in the header is impossible and is not used", what));
}

/// Reads the near and far planes, unless their values are impossible.
void read_clipping(const AttributePlace& place, Camera& camera, std::vector<std::string>& notes) {
  const auto usable = [&](const char* name) -> std::optional<double> {
    const std::optional<double> value = number_attribute(*place.header, place.prefix + name);
    if (!value || *value > 0) return value;
    note_unusable(fmt::format("{}{} {:g}", place.prefix, name, *value), notes);
    return {};
  };
  camera.near = usable("near");
  camera.far = usable("far");
  if (!camera.near || !camera.far || *camera.near < *camera.far) return;
  note_unusable(fmt::format("{}near {:g} with far {:g}", place.prefix, *camera.near, *camera.far), notes);
  camera.near.reset();
  camera.far.reset();
}

std::optional<Camera> camera_at(const AttributePlace& place, const Window& display, std::vector<std::string>& notes) {
  const auto to_camera = matrix(place, "worldToCamera"), to_ndc = matrix(place, "worldToNDC");
  if (!to_camera || !to_ndc) return {};
  Camera camera = camera_from_matrices(*to_camera, *to_ndc, display, origin(place), &notes);
  camera.source = printable(text_attribute(*place.header, place.prefix + "gloamCamera"));
  if (camera.source.empty()) camera.source = "header";
  // gloam writes matrices for a camera of unknown pose too; they must not be taken for a known pose.
  if (declares_unknown_pose(place)) camera.pose.reset();
  read_clipping(place, camera, notes);
  return camera;
}

std::optional<Pose> pose_at(const AttributePlace& place) {
  const auto to_camera = matrix(place, "worldToCamera");
  if (!to_camera || declares_unknown_pose(place)) return {};
  return pose_from_matrix(*to_camera, origin(place));
}

}  // namespace

const std::map<std::string, Camera>& HeaderCameras::modules() {
  if (!modules_.empty()) return modules_;
  const std::string json = headers_.text("gloamDisplay");
  if (json.empty()) return modules_;
  for (auto& [name, camera] : module_cameras(display_from_text(json, "attribute gloamDisplay"), display_)) {
    camera.source = "header";
    modules_.emplace(name, camera);
  }
  return modules_;
}

std::optional<Camera> HeaderCameras::camera(const std::string& view, std::vector<std::string>& notes) {
  if (const auto module = modules().find(view); module != modules_.end()) return module->second;
  for (const AttributePlace& place : headers_.places_of(view))
    if (std::optional<Camera> found = camera_at(place, display_, notes)) return found;
  return {};
}

std::optional<Pose> HeaderCameras::pose(const std::string& view, std::vector<std::string>& notes) const {
  std::optional<Pose> pose;
  bool has_projection = false;
  for (const AttributePlace& place : headers_.places_of(view)) {
    if (!pose) pose = pose_at(place);
    has_projection = has_projection || matrix(place, "worldToNDC");
  }
  if (pose)
    add_new(notes, "camera: the header has worldToCamera and no worldToNDC: only the pose is used");
  else if (has_projection)
    add_new(notes, "camera: the header has worldToNDC and no worldToCamera: it is not used");
  return pose;
}

}  // namespace gloam
