// Cameras of a file, in words and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gloam/exr.h"

namespace gloam {

/// "camera" (the first), "cameras" by view, "camera_from" ("flag", "header", "json", "fit", "matrix", "default" or null) and, where positions tell it,
/// "camera_residual_pixels" (median) and "camera_residual_pixels_99" of the first; else null. `options`: those that the file was opened with.
void add_cameras(const FrameFile& file, const ReadOptions& options, nlohmann::ordered_json& document);

/// A camera's entry of "cameras" in one line, without its view.
std::string camera_line(const nlohmann::ordered_json& camera);

/// Whether Blender wrote the file: it says so in files of several layers, and stamps others with its scene, file and date.
bool is_of_blender(const FrameFile& file);

/// Three lines for Blender's Python console that write the camera JSON which gloam finds beside the frame; none where a camera is
/// known or there is nothing to see.
std::vector<std::string> lines_for_blender(const FrameFile& file);

}  // namespace gloam
