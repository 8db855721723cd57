// The camera that is assumed for a view without a known one.
#pragma once

#include "exr/file.h"
#include "exr/file_cameras.h"
#include "gloam/frame.h"

namespace gloam {

/// Gives a view without a camera one with a horizontal field of view of 60 degrees, and says so in `Frame::assumed` if depth or
/// normals depend on the camera.
void assume_missing_camera(const ExrFile& file, const FileCameras& known, View& view, Frame& frame);

}  // namespace gloam
