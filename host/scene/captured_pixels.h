// Which part of a scene a camera shows at a pixel.
#pragma once

#include "gloam/camera.h"

namespace gloam {

/// The depth at which a view's frustum ends; infinite if the camera has no far plane.
double far_of(const Camera& camera);

/// Whether the image shows anything at a pixel: light of a display's module may miss the screen there.
bool shows(const Camera& camera, int x, int y);

}  // namespace gloam
