#include "camera/camera_of_view.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "camera/camera_range.h"
#include "camera/rotations.h"
#include "gloam/error.h"

namespace gloam {

namespace {

/// A rigid transform between world and camera, from a checked 4x4 matrix.
struct Rigid {
  glm::dmat3 rotation;
  glm::dvec3 translation;
};

Rigid rigid_from(const CameraFields& fields, const char* name, const glm::dmat4& m) {
  const std::string expected = "a rotation and a translation of a right-handed camera that looks along -z";
  const glm::dvec4 last(m[0][3], m[1][3], m[2][3], m[3][3] - 1);
  if (!(glm::length(last) <= 1e-9)) fields.refuse(name, "has a last row other than 0 0 0 1", expected);
  const glm::dmat3 rotation(m);
  const std::string fault = rotation_fault(rotation);
  if (!fault.empty()) fields.refuse(name, fault, expected);
  if (glm::determinant(rotation) < 0) fields.refuse(name, "mirrors the world (determinant -1)", expected);
  return {nearest_rotation(rotation), glm::dvec3(m[3])};
}

/// The pose. camera_to_world is preferred: its translation is the camera's position in full precision.
Pose pose_from(const CameraFields& fields) {
  if (const auto m = fields.matrix("camera_to_world")) {
    const Rigid camera_to_world = rigid_from(fields, "camera_to_world", *m);
    return {glm::transpose(camera_to_world.rotation), camera_to_world.translation};
  }
  if (const auto m = fields.matrix("world_to_camera")) {
    const Rigid world_to_camera = rigid_from(fields, "world_to_camera", *m);
    return {world_to_camera.rotation, -(glm::transpose(world_to_camera.rotation) * world_to_camera.translation)};
  }
  fields.refuse("camera_to_world", "is missing", "it or world_to_camera, a 4x4 matrix");
}

/// Whether the view is orthographic, by camera_type or else by the other fields.
bool is_orthographic(const CameraFields& fields, const std::optional<glm::dmat4>& projection) {
  if (const auto type = fields.text("camera_type")) {
    if (*type == "ORTHO") return true;
    if (*type == "PERSP") return false;
    fields.refuse("camera_type", fmt::format("is {}", *type), "PERSP or ORTHO (panoramas cannot be used)");
  }
  if (fields.find("fx")) return false;
  if (fields.find("pixels_per_unit")) return true;
  return projection && (*projection)[2][3] == 0;
}

/// Size of the image that the JSON describes, pixels.
struct Size {
  double width, height;
};

/// Intrinsics from an OpenGL projection: clip space -1..1, y up.
Camera camera_from_projection(const CameraFields& fields, glm::dmat4 m, bool orthographic, const Size& size) {
  const std::string expected = orthographic ? "an OpenGL orthographic matrix" : "an OpenGL perspective matrix";
  const double w = orthographic ? m[3][3] : -m[2][3], other = orthographic ? m[2][3] : m[3][3];
  const bool is_camera = w != 0 && other == 0 && m[0][3] == 0 && m[1][3] == 0 && m[1][0] == 0 && m[0][1] == 0;
  if (!is_camera) fields.refuse("projection_gl", "mixes its axes", expected);
  m /= w;
  if (!(m[0][0] > 0 && m[1][1] > 0)) fields.refuse("projection_gl", "has no positive scale in x and y", expected);
  Camera camera;
  camera.orthographic = orthographic;
  camera.fx = m[0][0] * size.width / 2;
  camera.fy = m[1][1] * size.height / 2;
  const double shift_x = orthographic ? m[3][0] : -m[2][0], shift_y = orthographic ? m[3][1] : -m[2][1];
  camera.cx = size.width / 2 * (1 + shift_x);
  camera.cy = size.height / 2 * (1 - shift_y);
  return camera;
}

void check_range(const CameraFields& fields, const Camera& camera) {
  if (!is_sensible_scale(camera.fx, camera.orthographic))
    fields.refuse(camera.orthographic ? "pixels_per_unit" : "fx", fmt::format("is {:g}", camera.fx),
                  sensible_scale(camera.orthographic));
  if (!is_sensible_scale(camera.fy, camera.orthographic))
    fields.refuse(camera.orthographic ? "pixels_per_unit" : "fy", fmt::format("is {:g}", camera.fy),
                  sensible_scale(camera.orthographic));
  if (!(std::abs(camera.cx) <= farthest_centre))
    fields.refuse("cx", fmt::format("is {:g}", camera.cx), "at most 1e6 pixels to either side");
  if (!(std::abs(camera.cy) <= farthest_centre))
    fields.refuse("cy", fmt::format("is {:g}", camera.cy), "at most 1e6 pixels up or down");
}

/// Intrinsics in pixels of `size`: from the fields in pixels if present, the rest from the projection.
Camera intrinsics_from(const CameraFields& fields, const Size& size) {
  const std::optional<glm::dmat4> projection = fields.matrix("projection_gl");
  const bool orthographic = is_orthographic(fields, projection);
  Camera camera;
  camera.orthographic = orthographic;
  if (projection) camera = camera_from_projection(fields, *projection, orthographic, size);
  if (orthographic) {
    // One number for both axes; if pixels are not square, the projection gives their ratio.
    const std::optional<double> scale = fields.positive("pixels_per_unit");
    const double aspect = projection ? camera.fy / camera.fx : 1;
    camera.fx = scale.value_or(camera.fx);
    camera.fy = camera.fx * aspect;
    if (!scale && !projection) fields.refuse("pixels_per_unit", "is missing", "it or projection_gl");
  } else {
    const std::optional<double> fx = fields.positive("fx"), fy = fields.positive("fy");
    if (!projection && !fx) fields.refuse("fx", "is missing", "it or projection_gl");
    if (!projection && !fy) fields.refuse("fy", "is missing", "it or projection_gl");
    camera.fx = fx.value_or(camera.fx);
    camera.fy = fy.value_or(camera.fy);
  }
  const std::optional<double> cx = fields.number("cx"), cy = fields.number("cy");
  if (!projection && !cx) fields.refuse("cx", "is missing", "it or projection_gl");
  if (!projection && !cy) fields.refuse("cy", "is missing", "it or projection_gl");
  camera.cx = cx.value_or(camera.cx);
  camera.cy = cy.value_or(camera.cy);
  check_range(fields, camera);
  return camera;
}

void add_clipping(const CameraFields& fields, Camera& camera) {
  camera.near = camera.orthographic ? fields.number("near") : fields.positive("near");
  camera.far = camera.orthographic ? fields.number("far") : fields.positive("far");
  if (camera.near && camera.far && !(*camera.far > *camera.near))
    fields.refuse("far", fmt::format("is {:g}", *camera.far), fmt::format("more than near, {:g}", *camera.near));
}

/// Size of the image that the JSON was made for; the display's if it states none. The aspect must be the display's.
Size size_from(const CameraFields& fields, const Window& display) {
  const double width = fields.positive("width").value_or(display.width());
  const double height = fields.positive("height").value_or(display.height());
  // Half-size frames round to whole pixels: a difference of one pixel is the same aspect.
  if (std::abs(display.width() * height - display.height() * width) > std::max(width, height))
    fields.refuse("width", fmt::format("and height are {:g}x{:g}", width, height),
                  fmt::format("the aspect of the frame, {}x{}", display.width(), display.height()));
  return {width, height};
}

/// Scales a camera from pixels of the JSON's image to those of the display window.
void fit_to_display(Camera& camera, const Size& size, const Window& display) {
  const double scale_x = display.width() / size.width, scale_y = display.height() / size.height;
  camera.fx *= scale_x;
  camera.fy *= scale_y;
  camera.cx = display.x0 + camera.cx * scale_x;
  camera.cy = display.y0 + camera.cy * scale_y;
}

/// Checks the camera in pixels of the frame as well: scaling may take it out of range.
void check_fit(const CameraFields& fields, const Camera& camera, const Size& size, const Window& display) {
  const double x = camera.cx - display.x0, y = camera.cy - display.y0;
  if (is_sensible_scale(camera.fx, camera.orthographic) && is_sensible_scale(camera.fy, camera.orthographic) &&
      std::abs(x) <= farthest_centre && std::abs(y) <= farthest_centre)
    return;
  fields.refuse(
      "width",
      fmt::format("and height are {:g}x{:g}, and for the frame's {}x{} that makes fx {:g} fy {:g} cx {:g} cy {:g}",
                  size.width, size.height, display.width(), display.height(), camera.fx, camera.fy, x, y),
      fmt::format("{}, and a centre of at most 1e6 pixels", sensible_scale(camera.orthographic)));
}

void add_once(std::vector<std::string>& sentences, const std::string& sentence) {
  if (std::find(sentences.begin(), sentences.end(), sentence) == sentences.end()) sentences.push_back(sentence);
}

}  // namespace

Camera camera_of_view(const CameraFields& fields, const Window& display, std::vector<std::string>& assumed) {
  const Size size = size_from(fields, display);
  Camera camera = intrinsics_from(fields, size);
  add_clipping(fields, camera);
  camera.pose = pose_from(fields);
  camera.source = std::filesystem::path(fields.file).filename().string();
  if (size.width != display.width() || size.height != display.height())
    add_once(assumed, fmt::format("camera: {} is for {:g}x{:g} pixels and was scaled to the frame's {}x{}",
                                  camera.source, size.width, size.height, display.width(), display.height()));
  fit_to_display(camera, size, display);
  check_fit(fields, camera, size, display);
  return camera;
}

}  // namespace gloam
