// Cameras of a camera JSON (docs/gbuffer.md).
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam {

/// Cameras by view name, in pixels of `display` (scaled if the JSON was made for another size of the same aspect; a note goes to
/// `assumed`). The single view of a JSON, and a view "mono", is returned under "". Fields are looked up in the view, then at the
/// top. camera_to_world overrides world_to_camera, and fields in pixels override projection_gl. Rotations may be off by float
/// rounding (1e-4) and are made orthonormal.
/// Throws Error naming the file, the field and what is expected, for a field that is missing, of the wrong type, not finite (also
/// NaN and Infinity as Python writes them), not rigid or out of range (a focal length over 1e7 pixels, a centre beyond 1e6).
std::map<std::string, Camera> read_camera_file(const std::filesystem::path& file, const Window& display,
                                               std::vector<std::string>& assumed);

/// As above, of a JSON at hand; `file` names it in messages.
std::map<std::string, Camera> cameras_of(const nlohmann::json& camera_json, const std::filesystem::path& file,
                                         const Window& display, std::vector<std::string>& assumed);

/// The cameras of a path: the list "path" of a camera JSON, one view per camera; fields are looked up in the entry, then at the
/// top. "frames" (2 to 100000) asks for this many cameras instead, evenly along the list: positions and intrinsics are
/// interpolated linearly, rotations by the shortest turn. Throws Error as `read_camera_file` does.
std::vector<Camera> read_camera_path(const std::filesystem::path& file, const Window& display,
                                     std::vector<std::string>& assumed);

/// The size of the image that a JSON of a camera or of a path states for all its views, pixels.
std::optional<std::pair<int, int>> stated_size(const std::filesystem::path& file);

/// Whether an object has a field that only cameras have.
bool holds_camera(const nlohmann::json& value);

/// Throws Error naming the file if it is too large for a camera or no JSON.
nlohmann::json parse_camera_json(const std::filesystem::path& file);

}  // namespace gloam
