// The camera JSON that lies beside a frame.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gloam {

/// The camera JSON that belongs to a frame (docs/gbuffer.md): the file whose stem (before `.camera`) is the longest
/// prefix of the frame's name, else `camera*.json` in the folder. A JSON that is named neither `*.camera.json` nor
/// `camera*.json` counts only when it holds a camera; where it cannot be read or has "views" that are none, and no
/// other file fits the frame's name, a sentence goes to `notes`. None when there is none; throws Error naming both when
/// two fit equally.
std::optional<std::filesystem::path> find_camera_file(const std::filesystem::path& frame,
                                                      std::vector<std::string>* notes = nullptr);

}  // namespace gloam
