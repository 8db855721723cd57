// What a file's positions tell about its cameras and its depth.
#pragma once

#include "exr/file.h"
#include "exr/file_cameras.h"

namespace gloam {

/// Whether any view has positions, from which cameras can be fitted.
bool has_positions(const ExrFile& file);

/// Fits the cameras and poses that neither flag, header nor JSON gives, where a view has positions; for others tells whether they
/// agree with the positions. Fills `cameras.positions`, adds cameras, poses and notes. Depth that cannot be made from positions is
/// no longer a plane of the file. Decodes some rows of the positions. Throws Error naming the file if it is damaged.
void settle_by_positions(ExrFile& file, FileCameras& cameras);

}  // namespace gloam
