// Cameras in the words and the document of gloam info.
#pragma once

#include <string>
#include <vector>

#include "cli/flags/options.h"
#include "gloam/exr.h"

namespace gloam::cli {

/// What gloam info says of cameras: "camera" (the first), "cameras" by view, "camera_from" ("flag", "header", "json", "fit" or null)
/// and, where positions tell it, "camera_residual_pixels" (median) and "camera_residual_pixels_99" of the first; else null.
void add_cameras(const FrameFile& file, const FrameFlags& flags, Json& document);

/// A camera's entry of "cameras" in one line, without its view.
std::string camera_line(const Json& camera);

/// Three lines for Blender's Python console that write the camera JSON which gloam finds beside the frame; none where a camera is
/// known or there is nothing to see.
std::vector<std::string> lines_for_blender(const FrameFile& file);

}  // namespace gloam::cli
