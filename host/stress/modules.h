// Light-field displays, and the images of their modules, in closed form.
#pragma once

#include <string>
#include <vector>

#include "gloam/light_field.h"
#include "stress/frames.h"

namespace gloam::stress {

/// Observers 4 units before a screen of 3 x 2.4, one module 6 behind it, a little aside. World space is physical space.
LightFieldDisplay flat_display();

/// Displays with one module each: flat as above, with a convex screen, with a turned module, and with a sheared world.
struct NamedDisplay {
  std::string name;
  LightFieldDisplay display;
};
std::vector<NamedDisplay> display_cases();

/// A display's module as a shot.
Shot shot_of_module(const LightFieldDisplay& display, int width, int height, size_t module = 0);

/// A scene through three modules of a display side by side; the room fills the screen of every display of `display_cases`.
Frame shoot_modules(LightFieldDisplay display, int width, int height, const Scene& scene);

}  // namespace gloam::stress
