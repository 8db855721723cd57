// The depth of a file, with the meaning that flags, the header and channel names give it.
#pragma once

#include <string>

#include "exr/file.h"
#include "exr/file_cameras.h"
#include "gloam/frame.h"

namespace gloam {

/// The convention before any pixel is decoded: "z", "ray", "ndc" or "reversed"; empty without depth.
std::string declared_depth_convention(const ExrFile& file);

/// Whether any stored depth of a view is the value of --background.
bool has_named_background(const ExrFile& file, const View& view);

/// Brings a view's depth to planar view-space z, in the units of the positions if they tell, and notes assumptions. Returns the convention (normalise/depth.h); empty
/// without depth.
std::string convert_depth(const ExrFile& file, const FileCameras& cameras, View& view, Frame& frame, FoundDepth& found);

/// Adds the note for a frame without any pixel of the depth that --background names.
void note_missing_background(const ExrFile& file, Frame& frame);

}  // namespace gloam
