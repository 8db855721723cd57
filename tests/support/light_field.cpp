#include "support/light_field.h"

#include "gloam/scene/capture.h"

namespace gloam::test {

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
