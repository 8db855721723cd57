// The camera that is assumed for a view of which none is known.
#pragma once

#include "exr/file.h"
#include "exr/file_cameras.h"
#include "gloam/frame.h"

namespace gloam {

/// Gives the view a camera with a horizontal field of view of 60 degrees where it has none, and says so in `Frame::assumed` where
/// depth or normals depend on the camera.
void assume_missing_camera(const ExrFile& file, const FileCameras& known, View& view, Frame& frame);

}  // namespace gloam
