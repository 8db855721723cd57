// Light-field displays, and what their modules show, in closed form.
#pragma once

#include <string>
#include <vector>

#include "gloam/light_field.h"
#include "stress/frames.h"

namespace gloam::stress {

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

/// A scene through three modules of a display side by side; the room fills the screen of any of `display_cases`.
Frame shoot_modules(LightFieldDisplay display, int width, int height, const Scene& scene);

}  // namespace gloam::stress
