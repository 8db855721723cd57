#include "support/light_field.h"

#include "gloam/capture.h"

namespace gloam::test {

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
  // By columns.
  sheared.world->linear = glm::dmat3(1.1, -0.1, 0.2, 0.2, 0.9, 0.1, 0.3, 0.25, 1.3);
  return {{"flat", flat_display()}, {"convex", convex}, {"turned", turned}, {"sheared", sheared}};
}

Shot shot_of_module(const LightFieldDisplay& display, int width, int height, size_t module) {
  return {module_cameras(display, {0, 0, width, height}).at(module).second, width, height};
}

double depth_of_screen(const Camera& camera) {
  return camera.slits->observer_distance / camera.slits->to_physical[2][2];
}

Frame captured(LightFieldDisplay display, int width, int height) {
  static const auto& scene = *new auto(load_scene("colonnade", {}));
  static const Tracer& tracer = *new Tracer(scene);
  const glm::dmat3 shear = display.world ? display.world->linear : glm::dmat3(1.0);
  display = fitted_to(display, camera_for(scene.cameras[0], 100, 80), {0, 0, 100, 80}, 6);
  display.world->linear = shear * display.world->linear;
  CaptureOptions options;
  options.width = width, options.height = height;
  options.planes = {"normal", "position"};
  for (const auto& [name, camera] : module_cameras(display, {0, 0, width, height}))
    options.views.push_back({name, camera, {}});
  return std::move(capture(tracer, options).frame);
}

}  // namespace gloam::test
