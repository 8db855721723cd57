#include "camera/camera_list.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/json_text.h"
#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::uintmax_t largest_list = 256 << 20;

json read_list(const fs::path& file) {
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(file, failed);
  if (!failed && size > largest_list) throw Error("{}: {} bytes, too large for a list of cameras", file.string(), size);
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

std::optional<std::string> camera_text_of_image(const fs::path& file, const ImageNumbers& numbers,
                                                std::vector<std::string>& notes) {
  json document = read_list(file);
  if (!document.is_object() || !document.contains("frames") || !document["frames"].is_structured()) return {};
  const json list = std::move(document["frames"]);
  document.erase("frames");
  const auto text_of = [&](const std::optional<int>& number) -> std::optional<std::string> {
    if (!number || !list.is_object() || !list.contains(std::to_string(*number))) return {};
    return camera_text(document, list[std::to_string(*number)], file, *number);
  };
  const std::string name = file.filename().string();
  const std::optional<std::string> by_name = text_of(numbers.by_name), by_header = text_of(numbers.by_header);
  if (by_name && by_header && *by_name != *by_header)
    add_new(notes, fmt::format("camera: that of frame {} in {}, as the file's name says; its header says frame {}",
                               *numbers.by_name, name, *numbers.by_header));
  if (by_name) return by_name;
  if (by_header) {
    add_new(notes, fmt::format("camera: that of frame {} in {}, as the header says", *numbers.by_header, name));
    return by_header;
  }
  if (list.is_object() && numbers.by_name)
    throw Error("{}: has no camera for frame {}", file.string(), *numbers.by_name);
  const bool is_one =
      !list.empty() && std::all_of(list.begin(), list.end(), [&](const json& own) { return own == list.front(); });
  if (!is_one)
    throw Error(
        "{}: holds a camera for each frame of a sequence, and neither the name nor the header of {} says which frame "
        "it "
        "is; end its name in the number, as in still.0001.exr, or give the frames as a pattern, such as shot.####.exr",
        file.string(), numbers.image);
  add_new(notes, fmt::format("camera: the one of {}, which is the same for all of its frames", name));
  return camera_text(document, list.front(), file, 0);
}

}  // namespace gloam
