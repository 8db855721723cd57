#include "camera/camera_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <string>
#include <vector>

#include "base/files.h"
#include "base/json_text.h"
#include "camera/camera_fields.h"
#include "camera/camera_range.h"
#include "camera/rotations.h"
#include "gloam/camera.h"
#include "gloam/error.h"
#include "gloam/frame.h"

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

/// The camera in pixels of `display`. A JSON for another size of the same aspect is scaled, with a note to `assumed`. Throws
/// Error as `read_camera_file` does (camera_json.h).
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

namespace fs = std::filesystem;
using nlohmann::json;

/// A camera takes a few kilobytes; a larger JSON is no camera.
constexpr std::uintmax_t largest_camera_file = 16 << 20;

json checked_object(json document, const fs::path& file) {
  if (!document.is_object())
    throw Error("{}: holds {}, expected an object with \"views\"", file.string(), document.type_name());
  return document;
}

json parse_camera_file(const fs::path& file) { return checked_object(parse_camera_json(file), file); }

/// Interpolates between two cameras; t: 0 to 1.
Camera between(const Camera& a, const Camera& b, double t) {
  if (t == 0 || t == 1) return t == 0 ? a : b;
  Camera camera = a;
  const auto mixed = [t](double from, double to) { return from + t * (to - from); };
  if (a.near && b.near) camera.near = mixed(*a.near, *b.near);
  if (a.far && b.far) camera.far = mixed(*a.far, *b.far);
  camera.fx = mixed(a.fx, b.fx), camera.fy = mixed(a.fy, b.fy);
  camera.cx = mixed(a.cx, b.cx), camera.cy = mixed(a.cy, b.cy);
  camera.pose->position = a.pose->position + t * (b.pose->position - a.pose->position);
  const glm::dquat from = glm::quat_cast(a.pose->world_to_view), to = glm::quat_cast(b.pose->world_to_view);
  camera.pose->world_to_view = glm::mat3_cast(glm::slerp(from, to, t));
  return camera;
}

}  // namespace

std::optional<std::pair<int, int>> stated_size(const fs::path& file) {
  const json document = parse_camera_file(file);
  const CameraFields fields{file.string(), "", document, document};
  const std::optional<double> width = fields.positive("width"), height = fields.positive("height");
  const auto is_size = [](const std::optional<double>& n) { return n && *n == std::floor(*n) && *n <= 65536; };
  if (!is_size(width) || !is_size(height) || *width * *height > double(max_pixels)) return {};
  return std::pair(int(*width), int(*height));
}

bool holds_camera(const json& value) {
  if (!value.is_object()) return false;
  constexpr std::array fields = {"camera_to_world", "world_to_camera", "projection_gl", "fx", "pixels_per_unit"};
  return std::any_of(fields.begin(), fields.end(), [&](const char* field) { return value.contains(field); });
}

json parse_camera_json(const fs::path& file) {
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(file, failed);
  if (!failed && size > largest_camera_file) throw Error("{}: {} bytes, too large for a camera", file.string(), size);
  return json_of_text(read_text(file), file.string());
}

std::map<std::string, Camera> read_camera_file(const fs::path& file, const Window& display,
                                               std::vector<std::string>& assumed) {
  return cameras_of(parse_camera_file(file), file, display, assumed);
}

std::map<std::string, Camera> cameras_of(const json& camera_json, const fs::path& file, const Window& display,
                                         std::vector<std::string>& assumed) {
  const json document = checked_object(camera_json, file);
  std::map<std::string, Camera> cameras;
  const auto views = document.find("views");
  if (views == document.end() && document.contains("path"))
    throw Error("{}: holds a path of cameras; give it as --camera-path of gloam capture", file.string());
  if (views == document.end() && document.contains("frames") && document["frames"].is_structured())
    throw Error("{}: holds a camera for each frame of a sequence; give the frames as a pattern, such as shot.####.exr",
                file.string());
  if (document.contains("modules") && !holds_camera(document))
    throw Error("{}: describes a light-field display and no camera; give it as --display of gloam capture",
                file.string());
  if (views == document.end()) {
    cameras[""] = camera_of_view({file.string(), "", document, document}, display, assumed);
    return cameras;
  }
  if (!views->is_array() || views->empty())
    throw Error("{}: views {}; expected a list of at least one view", file.string(),
                views->empty() ? "is empty" : type_in_words(*views));
  for (size_t i = 0; i < views->size(); ++i) {
    const json& view = (*views)[i];
    if (!view.is_object()) throw Error("{}: views[{}] {}; expected an object", file.string(), i, type_in_words(view));
    const json nothing = json::object();
    const CameraFields fields{file.string(), fmt::format("views[{}].", i), view, document};
    std::string name = CameraFields{fields.file, fields.prefix, view, nothing}.text("view").value_or("");
    if (views->size() == 1 || name == "mono") name = "";
    if (!cameras.emplace(name, camera_of_view(fields, display, assumed)).second)
      fields.refuse("view", name.empty() ? "is missing or \"mono\"" : fmt::format("is {} again", name),
                    "a name that no other view has");
  }
  return cameras;
}

std::vector<Camera> read_camera_path(const fs::path& file, const Window& display, std::vector<std::string>& assumed) {
  const json document = parse_camera_file(file);
  const auto path = document.find("path");
  if (path == document.end() || !path->is_array() || path->size() < 2)
    throw Error("{}: has no path; expected \"path\", a list of two cameras or more", file.string());
  std::vector<Camera> keys;
  for (size_t i = 0; i < path->size(); ++i) {
    const json& entry = (*path)[i];
    if (!entry.is_object()) throw Error("{}: path[{}] {}; expected an object", file.string(), i, type_in_words(entry));
    keys.push_back(camera_of_view({file.string(), fmt::format("path[{}].", i), entry, document}, display, assumed));
    if (!keys.back().pose)
      throw Error("{}: path[{}] has no pose; expected camera_to_world or world_to_camera", file.string(), i);
  }
  for (const Camera& key : keys) {
    if (key.orthographic != keys.front().orthographic)
      throw Error("{}: path mixes perspective and orthographic cameras; expected one kind", file.string());
  }
  const std::optional<double> frames = CameraFields{file.string(), "", document, document}.number("frames");
  if (!frames) return keys;
  if (!(*frames >= 2 && *frames <= 100000) || *frames != std::floor(*frames))
    throw Error("{}: frames {:g} is not allowed; a whole number from 2 to 100000 is", file.string(), *frames);
  std::vector<Camera> cameras;
  for (int i = 0; i < int(*frames); ++i) {
    const double at = double(keys.size() - 1) * i / (*frames - 1);
    const size_t key = std::min(size_t(at), keys.size() - 2);
    cameras.push_back(between(keys[key], keys[key + 1], at - double(key)));
  }
  return cameras;
}

}  // namespace gloam
