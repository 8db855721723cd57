// Light-field displays for tests, and the images of their modules.
#pragma once

#include <string>
#include <vector>

#include "gloam/light_field.h"
#include "stress/modules.h"
#include "support/stress.h"

namespace gloam::test {

/// The distance of the screen's middle from the observers, scene units.
double depth_of_screen(const Camera& camera);

/// The built-in scene `colonnade` through the modules, with depth, normals and positions: the image of its own camera fills the
/// screen, sheared like the display's world, if it has one.
Frame captured(LightFieldDisplay display, int width, int height);

}  // namespace gloam::test
