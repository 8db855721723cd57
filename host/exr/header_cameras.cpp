#include "exr/header_cameras.h"

#include <algorithm>

#include "base/lists.h"
#include "camera/matrices.h"
#include "exr/attributes.h"
#include "exr/writer_cameras.h"
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

/// Whether a matrix is stored for column vectors: its last row is that of an affine map, and its last column is not.
bool is_transposed(const Imath::M44d& m) {
  const bool is_last_row = m[3][0] == 0 && m[3][1] == 0 && m[3][2] == 0 && m[3][3] == 1;
  return is_last_row && (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0);
}

/// pbrt stores matrices for column vectors (image.cpp, WriteEXR), and its NDC covers -1 to 1 of the shorter side, halved and moved
/// to the middle (ProjectiveCamera::InitMetadata in cameras.cpp): the longer side reaches beyond 0 to 1.
Camera camera_of_pbrt(const Imath::M44d& to_camera, const Imath::M44d& to_ndc, const Window& display,
                      const glm::dvec3& origin, std::vector<std::string>& notes) {
  Camera camera = camera_from_matrices(to_camera.transposed(), to_ndc.transposed(), display, origin, &notes);
  const double aspect = double(display.width()) / display.height();
  const double middle_x = (display.x0 + display.x1) / 2.0, middle_y = (display.y0 + display.y1) / 2.0;
  const double across = 1 / std::max(aspect, 1.0), down = std::min(aspect, 1.0);
  camera.fx *= across;
  camera.cx = middle_x + (camera.cx - middle_x) * across;
  camera.fy *= down;
  camera.cy = middle_y + (camera.cy - middle_y) * down;
  add_new(notes, "camera: the header's matrices are stored for column vectors and read as pbrt writes them");
  return camera;
}

std::optional<Camera> camera_at(const AttributePlace& place, const Window& display, std::vector<std::string>& notes) {
  const auto to_camera = matrix(place, "worldToCamera"), to_ndc = matrix(place, "worldToNDC");
  if (!to_camera || !to_ndc) return {};
  Camera camera = is_transposed(*to_camera) ? camera_of_pbrt(*to_camera, *to_ndc, display, origin(place), notes)
                                            : camera_from_matrices(*to_camera, *to_ndc, display, origin(place), &notes);
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
  std::vector<std::string> said;
  const std::optional<Camera> found = of_writer(view, said);
  if (!found || !found->pose) return {};
  add_new(notes, said);
  return found;
}

std::optional<Camera> HeaderCameras::of_writer(const std::string& view, std::vector<std::string>& notes) const {
  for (const AttributePlace& place : headers_.places_of(view)) {
    if (!place.prefix.empty()) continue;  // these attributes know no views
    if (const auto found = writer_camera(*place.header, display_, pixel_aspect_, notes)) return found;
  }
  return {};
}

std::optional<Camera> HeaderCameras::lens(const std::string& view, std::vector<std::string>& notes) const {
  return of_writer(view, notes);
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
