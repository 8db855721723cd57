// The normals of a file as they are stored, beside a depth that they tell the meaning of.
#pragma once

#include <optional>

#include "exr/file.h"
#include "exr/file_cameras.h"
#include "gloam/frame.h"
#include "normalise/told_depth.h"

namespace gloam {

/// Samples of a view's normals, decoded row by row where `view` is without them: a depth means the same whether a command needs normals or
/// not. None where the file has no normals.
std::optional<NormalsBeside> normals_beside(const ExrFile& file, const FileCameras& cameras, const View& view);

}  // namespace gloam
