#include "camera/camera_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "base/files.h"
#include "base/json_text.h"
#include "camera/camera_fields.h"
#include "camera/camera_of_view.h"
#include "gloam/error.h"

namespace gloam {

namespace {

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
