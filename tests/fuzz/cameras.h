// Properties of every camera that is read.
#pragma once

#include "gloam/camera.h"

namespace gloam::fuzz {

void check_camera(const Camera& camera);

}  // namespace gloam::fuzz
