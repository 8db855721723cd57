#include "camera/matrices.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "camera/camera_range.h"
#include "camera/rotations.h"
#include "gloam/error.h"

namespace gloam {

namespace {

/// Imath's row i is GLM's column i: the same transform, for row vectors in Imath and for column vectors here.
glm::dmat4 columns_of(const Imath::M44d& m) {
  glm::dmat4 result;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) result[i][j] = m[i][j];
  return result;
}

Imath::M44d rows_of(const glm::dmat4& m) {
  Imath::M44d result;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) result[i][j] = m[i][j];
  return result;
}

void require_finite(const Imath::M44d& m, const char* name) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (!std::isfinite(m[i][j])) throw Error("{}: element [{}][{}] is not finite", name, i, j);
}

/// From gloam's view space (-z forward) to OpenEXR's camera space (+z forward) and back.
const glm::dmat3 flip_z(1, 0, 0, 0, 1, 0, 0, 0, -1);

Pose pose_from_header(const Imath::M44d& world_to_camera) {
  const glm::dmat4 m = columns_of(world_to_camera);
  if (!(std::abs(m[0][3]) + std::abs(m[1][3]) + std::abs(m[2][3]) + std::abs(m[3][3] - 1) <= 1e-6))
    throw Error("worldToCamera: has a last column other than 0 0 0 1, which is no camera");
  const glm::dmat3 rotation(m);
  const std::string fault = rotation_fault(rotation);
  if (!fault.empty()) throw Error("worldToCamera: {}, expected a rotation and a translation", fault);
  const glm::dmat3 to_camera = nearest_rotation(rotation);
  return {flip_z * to_camera, -(glm::transpose(to_camera) * glm::dvec3(m[3]))};
}

/// Camera space to NDC. The rotation is inverted by transposition, so that a distant origin costs no digits.
glm::dmat4 camera_to_ndc(const Imath::M44d& world_to_ndc, const Pose& pose) {
  const glm::dmat3 to_world = glm::transpose(flip_z * pose.world_to_view);
  const glm::dmat4 camera_to_world(glm::dvec4(to_world[0], 0), glm::dvec4(to_world[1], 0), glm::dvec4(to_world[2], 0),
                                   glm::dvec4(pose.position, 1));
  return columns_of(world_to_ndc) * camera_to_world;
}

[[noreturn]] void refuse_ndc(const char* fault) { throw Error("worldToNDC: {}", fault); }

/// Range of a writer's normalised device coordinates: OpenEXR's 0 to 1 with y down, or y up from 0 or from -1.
enum class NdcRange { y_down, y_up, symmetric_y_up };

/// The range in whose middle the principal point lies, or is nearest to. `x`, `y`: principal point in NDC.
NdcRange range_of(bool y_grows_up, double x, double y) {
  if (!y_grows_up) return NdcRange::y_down;
  return std::hypot(x, y) / 2 < std::hypot(x - 0.5, y - 0.5) ? NdcRange::symmetric_y_up : NdcRange::y_up;
}

/// Intrinsics from `p` = camera to NDC, where p[i][j] is the contribution of camera axis i (3: the constant) to x, y, z, w.
Camera intrinsics_from_ndc(const glm::dmat4& p, const Window& display, double camera_distance, NdcRange& range) {
  const double slope_x = std::hypot(p[0][0], p[1][0]), slope_y = std::hypot(p[0][1], p[1][1]);
  if (!(slope_x > 0 && slope_y > 0)) refuse_ndc("is singular: it flattens the image");
  // Growth of w along an axis relative to that of x, without a unit: 2 tan(fov / 2) for a perspective, 0 for an orthographic
  // camera.
  const double w_sideways = std::hypot(p[0][3], p[1][3]) / slope_x, w_forwards = std::abs(p[2][3]) / slope_x;
  const bool orthographic = w_forwards < 1e-5;
  if (w_sideways > 1e-4 * std::max(w_forwards, 0.1))
    refuse_ndc("tilts the image plane against the viewing axis of worldToCamera");
  const int source = orthographic ? 3 : 2;  // the row that carries the principal point: the constant, or depth
  const double w = p[source][3];
  if (w == 0) refuse_ndc("is singular: it has no w");
  if (std::abs(p[1][0]) > 1e-4 * slope_x || std::abs(p[0][1]) > 1e-4 * slope_y)
    refuse_ndc("shears or turns the image against worldToCamera");
  if (orthographic && (std::abs(p[2][0]) > 1e-4 * slope_x || std::abs(p[2][1]) > 1e-4 * slope_y))
    refuse_ndc("is an oblique projection; expected a perspective or an upright orthographic one");
  // The eye is where w vanishes. Float rounding in the header moves it by a share of the camera's distance.
  if (!orthographic && std::abs(p[3][3] / w) > 1e-4 * camera_distance)
    refuse_ndc("has its centre of projection away from the origin of worldToCamera");
  Camera camera;
  camera.orthographic = orthographic;
  const double x = p[source][0] / w, y = p[source][1] / w;
  range = range_of(p[1][1] / w > 0, x, y);
  const bool is_symmetric = range == NdcRange::symmetric_y_up;
  const double scale = is_symmetric ? 0.5 : 1, zero = is_symmetric ? 0.5 : 0;
  const double down = range == NdcRange::y_down ? 1 : -1;
  camera.fx = display.width() * scale * p[0][0] / w;
  camera.fy = -down * display.height() * scale * p[1][1] / w;
  camera.cx = display.x0 + display.width() * (zero + scale * x);
  camera.cy = display.y0 + display.height() * (down > 0 ? y : 1 - zero - scale * y);
  if (!(camera.fx > 0 && camera.fy > 0)) refuse_ndc("mirrors the image: x has to grow to the right");
  if (!std::isfinite(camera.fx + camera.fy + camera.cx + camera.cy)) refuse_ndc("has a w too small for its image");
  return camera;
}

/// Whether the camera looks along -z. Whatever a matrix is scaled by, x must grow to the right in the image: if it does so only
/// along -z, the camera looks there. For an orthographic camera z decides, but only if y grows up, which is not so in OpenEXR's
/// own form.
bool looks_along_minus_z(const glm::dmat4& p) {
  const double slope_x = std::hypot(p[0][0], p[1][0]);
  if (std::abs(p[2][3]) >= 1e-5 * slope_x) return p[0][0] / p[2][3] < 0;
  return p[1][1] / p[3][3] > 0 && p[2][2] / p[3][3] < 0;
}

void note_form(NdcRange range, bool looks_back, std::vector<std::string>& assumed) {
  if (range == NdcRange::y_down && !looks_back) return;
  std::string form;
  if (range == NdcRange::symmetric_y_up) form = "worldToNDC as -1 to 1, y up";
  if (range == NdcRange::y_up) form = "worldToNDC as 0 to 1, y up";
  if (looks_back) form += std::string(form.empty() ? "" : ", and ") + "worldToCamera as looking along -z";
  const std::string sentence = fmt::format("camera: the header's matrices tell their form: {}", form);
  if (std::find(assumed.begin(), assumed.end(), sentence) == assumed.end()) assumed.push_back(sentence);
}

/// NDC z is 0 at near and 1 at far. If these are unknown, any invertible choice will do: nothing reads it back.
glm::dvec2 ndc_z(const Camera& camera) {
  const double near = camera.near.value_or(camera.orthographic ? 0 : 1);
  const bool has_far = camera.far && std::isfinite(*camera.far) && *camera.far > near;
  if (camera.orthographic) {
    const double range = has_far ? *camera.far - near : 1;
    return {1 / range, -near / range};
  }
  const double scale = has_far ? *camera.far / (*camera.far - near) : 1;
  return {scale, -near * scale};
}

}  // namespace

Pose pose_from_matrix(const Imath::M44d& world_to_camera, const glm::dvec3& origin) {
  require_finite(world_to_camera, "worldToCamera");
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(origin[i])) throw Error("gloamOrigin: component {} is not finite", i);
  Pose pose = pose_from_header(world_to_camera);
  pose.position += origin;
  return pose;
}

Camera camera_from_matrices(const Imath::M44d& world_to_camera, const Imath::M44d& world_to_ndc, const Window& display,
                            const glm::dvec3& origin, std::vector<std::string>* assumed) {
  require_finite(world_to_camera, "worldToCamera");
  require_finite(world_to_ndc, "worldToNDC");
  Pose pose = pose_from_header(world_to_camera);
  glm::dmat4 projection = camera_to_ndc(world_to_ndc, pose);
  const bool looks_back = looks_along_minus_z(projection);
  if (looks_back) {
    pose.world_to_view = flip_z * pose.world_to_view;
    projection = camera_to_ndc(world_to_ndc, pose);
  }
  NdcRange range;
  Camera camera = intrinsics_from_ndc(projection, display, glm::length(pose.position), range);
  // A mirrored matrix in OpenEXR's own form looks the same.
  if (looks_back && !camera.orthographic && range == NdcRange::y_up)
    refuse_ndc("mirrors the image: x has to grow to the right");
  if (assumed) note_form(range, looks_back, *assumed);
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(origin[i])) throw Error("gloamOrigin: component {} is not finite", i);
  pose.position += origin;
  for (const double scale : {camera.fx, camera.fy})
    if (!is_sensible_scale(scale, camera.orthographic))
      throw Error("worldToNDC: gives {:g} pixels to the unit; {} make sense", scale,
                  sensible_scale(camera.orthographic));
  const double x = camera.cx - display.x0, y = camera.cy - display.y0;
  if (!(std::abs(x) <= farthest_centre && std::abs(y) <= farthest_centre))
    throw Error(
        "worldToNDC: has the principal point at ({:g}, {:g}); at most 1e6 pixels from the image's corner make sense", x,
        y);
  camera.pose = pose;
  camera.source = "header";
  return camera;
}

CameraMatrices matrices_of(const Camera& camera, const Window& display) {
  const Pose pose = camera.pose.value_or(Pose{});
  const glm::dmat4 world_to_camera(flip_z * pose.world_to_view);
  const double width = display.width(), height = display.height();
  const int source = camera.orthographic ? 3 : 2;
  glm::dmat4 projection(0.0);
  projection[0][0] = camera.fx / width;
  projection[1][1] = -camera.fy / height;
  projection[source][0] = (camera.cx - display.x0) / width;
  projection[source][1] = (camera.cy - display.y0) / height;
  projection[source][3] = 1;
  const glm::dvec2 z = ndc_z(camera);
  projection[2][2] = z.x;
  projection[3][2] = z.y;
  return {rows_of(world_to_camera), rows_of(projection * world_to_camera), pose.position};
}

}  // namespace gloam
