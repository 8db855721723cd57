#include "camera/camera_search.h"

#include <algorithm>
#include <string_view>

#include "base/file_ledger.h"
#include "camera/camera_json.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// File name without `.json` or `.camera.json`.
std::string camera_stem(const fs::path& file) {
  std::string stem = file.stem().string();
  if (stem.ends_with(".camera")) stem.resize(stem.size() - std::string_view(".camera").size());
  return stem;
}

bool has_camera_name(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with("camera") || name.ends_with(".camera.json");
}

/// Whether a JSON whose name is not a camera's holds one. Frames lie beside other JSON files too, such as gloam's own reports, so
/// any file that is clearly not a camera is ignored; `why_not` is filled if it may have been meant as one.
bool looks_like_camera(const fs::path& file, std::string& why_not) {
  const LooksAtFiles looks;
  try {
    const json document = parse_camera_json(file);
    if (!document.is_object()) return false;
    const auto views = document.find("views");
    if (views == document.end()) return holds_camera(document);
    if (views->is_array() && !views->empty() && holds_camera(views->front())) return true;
    if (!document.contains("planes")) why_not = "its \"views\" is no list of cameras";  // `gloam info` writes planes
  } catch (const Error& error) {
    const std::string message = error.what(), name = printable(file.string()) + ": ";
    why_not = message.starts_with(name) ? message.substr(name.size()) : message;
  }
  return false;
}

std::vector<fs::path> json_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
    std::error_code unknown;
    if (entry->path().extension() == ".json" && entry->is_regular_file(unknown)) files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::optional<fs::path> only_one(const std::vector<fs::path>& candidates, const fs::path& frame) {
  if (candidates.empty()) return {};
  if (candidates.size() == 1) return candidates.front();
  throw Error("{}: both {} and {} could be its camera; say which with {}", frame.string(),
              candidates[0].filename().string(), candidates[1].filename().string(), option("camera"));
}

}  // namespace

bool may_be_camera_file(const fs::path& file) {
  std::error_code unknown;
  std::string why_not;
  return file.extension() == ".json" && fs::is_regular_file(file, unknown) &&
         (has_camera_name(file) || looks_like_camera(file, why_not));
}

std::optional<fs::path> find_camera_file(const fs::path& frame, std::vector<std::string>* notes) {
  const std::string frame_name = frame.filename().string();
  const fs::path folder = frame.has_parent_path() ? frame.parent_path() : fs::path(".");
  std::vector<fs::path> by_prefix, by_name;
  std::vector<std::string> no_cameras;
  size_t longest = 0;
  for (const fs::path& file : json_files(folder)) {
    const std::string stem = camera_stem(file);
    const bool named_camera = has_camera_name(file);
    if (file.filename().string().starts_with("camera")) by_name.push_back(file);
    if (stem.empty() || stem.size() < longest || !frame_name.starts_with(stem)) continue;
    std::string why_not;
    if (!named_camera && !looks_like_camera(file, why_not)) {
      if (!why_not.empty())
        no_cameras.push_back(
            fmt::format("camera: {} is there but is no camera ({})", file.filename().string(), why_not));
      continue;
    }
    if (stem.size() > longest) by_prefix.clear();
    longest = stem.size();
    by_prefix.push_back(file);
  }
  if (const auto found = only_one(by_prefix, frame)) return found;
  if (notes) notes->insert(notes->end(), no_cameras.begin(), no_cameras.end());
  return only_one(by_name, frame);
}

}  // namespace gloam
