#include "cli/flags/scene_flags.h"

#include <filesystem>

#include "camera/camera_json.h"
#include "gloam/error.h"

namespace gloam::cli {
namespace {

bool is_file_name(const std::string& text) {
  return std::filesystem::path(text).extension() == ".json" || std::filesystem::is_regular_file(text);
}

}  // namespace

glm::dvec3 parse_point(const std::string& text, const std::string& flag) {
  const std::vector<std::string> items = split_list(text, flag);
  if (items.size() != 3) throw UsageError("{} {} is not a point; write {} 1,2,3", flag, text, flag);
  glm::dvec3 point;
  for (int i = 0; i < 3; ++i) point[i] = parse_number(items[size_t(i)], flag, Range<double>{-1e12, 1e12});
  return point;
}

void SceneFlags::add_settings_to(CLI::App& app) {
  add_text(app, "--set", settings, "NAME=VALUE",
           "set a parameter of a built-in scene; --faces 50000 is short for it (repeatable)")
      ->expected(1)
      ->take_all();
}

NamedScene SceneFlags::named() const { return {scene, parse_settings(settings, "--set")}; }

Settings SceneFlags::take_dotted_settings() {
  Settings dotted;
  const auto parsed = parse_settings(settings, "--set");
  std::vector<std::string> own;
  for (size_t i = 0; i < parsed.size(); ++i) {
    if (parsed[i].first.find('.') == std::string::npos)
      own.push_back(settings[i]);
    else
      dotted.push_back(parsed[i]);
  }
  settings = own;
  return dotted;
}

void SceneCameraFlags::add_to(CLI::App& app) {
  const Heading heading(app, "Camera");
  add_text(app, "--camera", camera, "NAME|FILE",
           "a camera of the scene by its name, or a camera JSON; default: the scene's first");
  add_parsed(app, "--eye", eye, parse_point, "place of the camera, scene units; with --target", "X,Y,Z");
  add_parsed(app, "--target", target, parse_point, "what it looks at", "X,Y,Z");
  add_number(app, "--fov", fov, {1, 179}, "horizontal field of view in degrees, over the camera's own", "DEG");
}

std::vector<std::pair<std::string, Camera>> SceneCameraFlags::cameras(const Scene& scene, int width, int height) const {
  if (eye.has_value() != target.has_value()) throw UsageError("--eye and --target go together; give both or neither");
  if (eye && !camera.empty()) throw UsageError("--camera and --eye both place the camera; give one of them");
  const double degrees = fov.value_or(0);
  if (!camera.empty() && is_file_name(camera)) {
    if (degrees > 0) throw UsageError("--fov cannot be given with a camera file; change the file's focal length");
    std::vector<std::string> assumed;
    std::vector<std::pair<std::string, Camera>> cameras;
    for (auto& [view, read] : read_camera_file(camera, {0, 0, width, height}, assumed)) {
      if (!read.pose) throw Error("{}: has no pose; expected camera_to_world or world_to_camera", camera);
      cameras.emplace_back(view, read);
    }
    note(assumed);
    return cameras;
  }
  SceneCamera chosen = named_camera(scene, camera);
  if (eye) {
    if (*eye == *target) throw UsageError("--eye and --target are the same point");
    chosen = looking_at("--eye", *eye, *target, chosen.orthographic ? 60 : chosen.fov_degrees, scene.up);
  }
  if (degrees > 0) {
    if (chosen.orthographic) throw UsageError("--fov: camera '{}' is orthographic and has none", chosen.name);
    chosen.fov_degrees = degrees;
  }
  return {{"", camera_for(chosen, width, height)}};
}

}  // namespace gloam::cli
