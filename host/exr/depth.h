// The depth of a file, as flags, the header and channel names say what it means.
#pragma once

#include <string>

#include "exr/file.h"
#include "gloam/frame.h"

namespace gloam {

/// The convention before any pixel is decoded: "z", "ray", "ndc" or "reversed"; empty without depth.
std::string declared_depth_convention(const ExrFile& file);

/// Whether some pixel of a view, as stored, has the depth that --background names.
bool has_named_background(const ExrFile& file, const View& view);

/// Brings a view's depth to planar view-space z, and notes what was assumed. Returns the convention (normalise/depth.h); empty
/// without depth.
std::string convert_depth(const ExrFile& file, View& view, Frame& frame);

/// For a frame of which no view has the background that --background names.
void note_missing_background(const ExrFile& file, Frame& frame);

}  // namespace gloam
