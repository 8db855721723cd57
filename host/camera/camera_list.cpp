#include "camera/camera_list.h"

#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/json_text.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::uintmax_t largest_file = 256 << 20;

json read_list(const fs::path& file) {
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(file, failed);
  if (!failed && size > largest_file) throw Error("{}: {} bytes, too large for a list of cameras", file.string(), size);
  return json_of_text(read_text(file), file.string());
}

/// The camera of a frame with the fields of the top that it lacks.
std::string camera_text(const json& top, const json& own, const fs::path& file, int frame) {
  if (!own.is_object())
    throw Error("{}: frames: the camera of frame {} is {}, expected an object", file.string(), frame, own.type_name());
  json camera = top;
  camera.update(own);
  return camera.dump();
}

}  // namespace

std::optional<CameraList> CameraList::of_file(const fs::path& file, const std::vector<int>& frames) {
  json document = read_list(file);
  if (!document.is_object() || !document.contains("frames") || !document["frames"].is_structured()) return {};
  const json list = std::move(document["frames"]);
  document.erase("frames");
  if (list.is_array() && list.size() != frames.size())
    throw Error(
        "{}: has cameras for {} frames, and there are {} frames ({}); list one for each, or write their numbers: "
        "{{\"frames\": {{\"1001\": ...}}}}",
        file.string(), list.size(), frames.size(), frames_in_words(frames));
  CameraList cameras;
  cameras.is_in_order_ = list.is_array();
  std::vector<int> missing;
  for (size_t i = 0; i < frames.size(); ++i) {
    const std::string number = std::to_string(frames[i]);
    if (list.is_object() && !list.contains(number)) {
      missing.push_back(frames[i]);
      continue;
    }
    cameras.texts_[frames[i]] = camera_text(document, list.is_array() ? list[i] : list[number], file, frames[i]);
  }
  if (!missing.empty())
    throw Error("{}: has no camera for {} {}", file.string(), missing.size() == 1 ? "frame" : "frames",
                frames_in_words(missing));
  return cameras;
}

std::optional<std::string> camera_text_of_frame(const fs::path& file, int frame) {
  const json document = read_list(file);
  if (!document.is_object() || !document.contains("frames") || !document["frames"].is_object()) return {};
  return CameraList::of_file(file, {frame})->text_of(frame);
}

}  // namespace gloam
