#include "exr/json_cameras.h"

#include "base/file_ledger.h"
#include "base/files.h"
#include "base/json_text.h"
#include "camera/camera_json.h"
#include "camera/camera_list.h"
#include "camera/camera_search.h"
#include "exr/errors.h"
#include "gloam/display_json.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"
#include "gloam/light_field.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

/// "the view left", "the views left and right"
std::string views_in_words(const std::vector<std::string>& views) {
  return (views.size() == 1 ? "the view " : "the views ") + enumerate(views);
}

/// Whether the JSON belongs to both eyes: it lies beside both files, or --camera names it.
bool is_shared_by_eyes(const JsonRequest& request, const fs::path& json) {
  if (!request.eye) return false;
  const std::optional<fs::path> others = request.json.empty() ? find_camera_file(request.eye->other) : json;
  std::error_code unknown;
  return others && fs::equivalent(*others, json, unknown);
}

std::map<std::string, Camera> cameras_of_display(const fs::path& json, const Window& display) {
  const LightFieldDisplay of_file = read_display(json);
  const auto of_modules = named(json, [&] { return module_cameras(of_file, display); });
  return {of_modules.begin(), of_modules.end()};
}

}  // namespace

const Camera* JsonCameras::find(const std::string& view, const std::vector<std::string>& wanted) const {
  if (const auto exact = cameras.find(view); exact != cameras.end()) return &exact->second;
  // A single camera is for a single view of any name; two eyes do not share it.
  const auto single = cameras.find("");
  return single != cameras.end() && wanted.size() == 1 && !is_shared ? &single->second : nullptr;
}

JsonCameras read_json_cameras(const JsonRequest& request, std::vector<std::string>& notes) {
  const bool is_asked_for = !request.json.empty();
  const std::optional<fs::path> json = is_asked_for ? request.json : find_camera_file(request.frame, &notes);
  if (!json) return {};
  if (!is_asked_for) reads_file(*json, "the camera file of " + request.frame.filename().string());
  std::string text = request.text;
  if (text.empty()) {
    const ImageNumbers numbers{request.frame.filename().string(), last_number(request.frame.stem().string()),
                               last_number(request.frame_in_header)};
    text = camera_text_of_image(*json, numbers, notes).value_or("");
  }
  if (!text.empty()) {
    const std::string name = json->filename().string();
    return {name, cameras_of(json_of_text(text, json->string()), *json, request.display, notes),
            request.eye.has_value()};
  }
  JsonCameras found{json->filename().string(), {}, is_shared_by_eyes(request, *json)};
  found.cameras = is_asked_for && is_display_text(read_text(*json)) ? cameras_of_display(*json, request.display)
                                                                    : read_camera_file(*json, request.display, notes);
  return found;
}

std::string misfit_in_words(const JsonCameras& json, const std::string& frame, const std::vector<std::string>& views) {
  std::vector<std::string> own;
  for (const auto& [view, camera] : json.cameras)
    if (!view.empty()) own.push_back(view);
  return fmt::format("{} has {}, and {} {}", json.name,
                     own.empty() ? "one camera that names no view" : views_in_words(own), frame,
                     views == std::vector<std::string>{""} ? "names none" : "has " + views_in_words(views));
}

}  // namespace gloam
