// Cameras of a camera JSON (docs/gbuffer.md).
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam {

/// Cameras by view name, in pixels of `display` (scaled when the JSON was made for another size of the same aspect; a
/// note goes to `assumed`). A JSON of one view is returned under "", whatever the view's name; so is a view "mono".
/// Fields are looked up in the view, then at the top. camera_to_world wins over world_to_camera, fields in pixels over
/// projection_gl. Rotations may be off by float rounding (1e-4) and are made orthonormal.
/// Throws Error naming the file, the field that is missing, of the wrong type, not finite (NaN and Infinity as Python
/// writes them included), not rigid or out of range (a focal length over 1e7 pixels, a centre beyond 1e6), and what is
/// expected there.
std::map<std::string, Camera> read_camera_file(const std::filesystem::path& file, const Window& display,
                                               std::vector<std::string>& assumed);

/// The cameras of a path: the list "path" of a camera JSON, one view per camera, fields looked up in the entry, then at
/// the top. "frames" (2 to 100000) asks for that many cameras instead, evenly along the list: places and intrinsics in
/// straight lines, rotations by the shortest turn. Throws Error as `read_camera_file` does.
std::vector<Camera> read_camera_path(const std::filesystem::path& file, const Window& display,
                                     std::vector<std::string>& assumed);

/// Whether an object has a field that only cameras have.
bool holds_camera(const nlohmann::json& value);

/// Throws Error naming the file where it is too large for a camera or no JSON.
nlohmann::json parse_camera_json(const std::filesystem::path& file);

}  // namespace gloam
