// Light-field displays for tests, and what their modules show.
#pragma once

#include <string>
#include <vector>

#include "gloam/light_field.h"
#include "support/stress.h"

namespace gloam::test {

/// Observers 4 before a screen of 3 x 2.4, one module 6 behind it, a little aside. The world is physical space.
LightFieldDisplay flat_display();

/// One module each: flat as above, a convex screen, a turned module, a world that is sheared.
struct NamedDisplay {
  std::string name;
  LightFieldDisplay display;
};
std::vector<NamedDisplay> display_cases();

/// A display's module and the size of its image.
Shot shot_of_module(const LightFieldDisplay& display, int width, int height, size_t module = 0);

/// The distance of the screen's middle from the observers, scene units.
double depth_of_screen(const Camera& camera);

/// The built-in scene `colonnade` as the modules show it, with depth, normals and positions: what its own camera frames fills the
/// screen, sheared as the display's world is, if it has one.
Frame captured(LightFieldDisplay display, int width, int height);

}  // namespace gloam::test
