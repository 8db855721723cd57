// The search for the camera JSON beside a frame.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gloam {

/// The camera JSON that belongs to a frame (docs/gbuffer.md): the file whose stem (before `.camera`) is the longest prefix of the
/// frame's name, else `camera*.json` in the folder. A JSON named neither `*.camera.json` nor `camera*.json` counts only if it
/// holds a camera; if it cannot be read, or its "views" are no cameras, and no other file fits the frame's name, a note goes to
/// `notes`. None if there is none. Throws Error naming both files if two fit equally.
std::optional<std::filesystem::path> find_camera_file(const std::filesystem::path& frame,
                                                      std::vector<std::string>* notes = nullptr);

/// Whether the search may find this file for a frame beside it.
bool may_be_camera_file(const std::filesystem::path& file);

}  // namespace gloam
