// Light-field displays for tests, and what their modules show.
#pragma once

#include <string>
#include <vector>

#include "gloam/light_field.h"
#include "stress/modules.h"
#include "support/stress.h"

namespace gloam::test {

/// The distance of the screen's middle from the observers, scene units.
double depth_of_screen(const Camera& camera);

/// The built-in scene `colonnade` as the modules show it, with depth, normals and positions: what its own camera frames fills the
/// screen, sheared as the display's world is, if it has one.
Frame captured(LightFieldDisplay display, int width, int height);

}  // namespace gloam::test
