// Depth of a file that has positions alone.
#pragma once

#include "exr/file.h"
#include "exr/file_cameras.h"
#include "gloam/frame.h"

namespace gloam {

/// Adds the plane `depth` to each view that has positions and no depth, unless --plane depth=none leaves it out or the file is
/// read for measuring: its channels are those of the positions.
void add_depth_of_positions(ExrFile& file);

/// Whether the depth of the view is made of positions.
bool is_made_of_positions(const ExrFile& file, const std::string& view);

/// Makes planar view-space z of the three channels of `depth`, and +inf of what is no position or does not lie at its pixel.
void make_depth(const ExrFile& file, const PositionFindings& findings, View& view, Frame& frame);

}  // namespace gloam
