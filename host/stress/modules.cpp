#include "stress/modules.h"

#include <fmt/format.h>

namespace gloam::stress {

LightFieldDisplay flat_display() {
  LightFieldDisplay display;
  display.name = "test";
  display.observer_distance = 4;
  display.observer_height = 0.1;
  display.screen_width = 3;
  display.screen_height = 2.4;
  display.modules = {{{0.5, 0.2, -6}}};
  display.world = WorldToPhysical{};
  return display;
}

std::vector<NamedDisplay> display_cases() {
  LightFieldDisplay convex = flat_display(), turned = flat_display(), sheared = flat_display();
  convex.screen_radius = 4;
  convex.modules[0].yaw = -4;
  turned.modules[0] = {{-1, 0.5, -6}, 14, -7};
  // Column by column.
  sheared.world->linear = glm::dmat3(1.1, -0.1, 0.2, 0.2, 0.9, 0.1, 0.3, 0.25, 1.3);
  return {{"flat", flat_display()}, {"convex", convex}, {"turned", turned}, {"sheared", sheared}};
}

Shot shot_of_module(const LightFieldDisplay& display, int width, int height, size_t module) {
  return {module_cameras(display, {0, 0, width, height}).at(module).second, width, height};
}

Frame shoot_modules(LightFieldDisplay display, int width, int height, const Scene& scene) {
  display.world->linear *= 2.0;
  display.modules.resize(3, display.modules[0]);
  for (size_t i = 0; i < 3; ++i) display.modules[i].position.x += 0.2 * double(i);
  Frame frame = shoot(shot_of_module(display, width, height, 0), scene);
  for (size_t i = 1; i < 3; ++i)
    frame.views.push_back(std::move(shoot(shot_of_module(display, width, height, i), scene).views[0]));
  for (size_t i = 0; i < 3; ++i) frame.views[i].name = fmt::format("module{}", i);
  return frame;
}

}  // namespace gloam::stress
