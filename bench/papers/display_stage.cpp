#include "papers/display_stage.h"

#include "gloam/display_json.h"
#include "gloam/error.h"
#include "gloam/scene/light_field_capture.h"

namespace gloam::bench {

LightFieldDisplay eighty_modules() { return display_from_text(eighty_modules_json, "data/displays/eighty.json"); }

size_t middle_module(const LightFieldDisplay& display) { return display.modules.size() / 2; }

LightFieldDisplay showing(const LightFieldDisplay& display, const std::string& scene, const Settings& settings) {
  const Scene shown = load_scene(scene, settings);
  const FittingSize size = fitting_size(display);
  const auto fitted = fitted_to(display, Tracer(shown), camera_for(shown.cameras.front(), size.width, size.height));
  if (!fitted) throw Error("{}: its first camera sees nothing that display '{}' could show", scene, display.name);
  return *fitted;
}

Stage stage_of(const LightFieldDisplay& display, const std::string& scene, const Settings& settings, int width,
               int height, const std::vector<size_t>& modules) {
  Stage s;
  s.scene = load_scene(scene, settings);
  s.tracer = std::make_unique<Tracer>(s.scene);
  s.radius = s.scene.ao_radius;
  CaptureOptions options{.width = width, .height = height, .planes = {"depth", "normal", "position"}};
  const std::vector<CaptureView> views = module_views(display, width, height);
  for (const size_t i : modules) options.views.push_back(views.at(i));
  if (modules.empty()) options.views = views;
  CaptureResult captured = capture(*s.tracer, options);
  s.frame = std::move(captured.frame);
  s.capture_seconds = captured.seconds;
  s.surfaces = foreground(s.frame);
  return s;
}

Frame views_of(const Frame& frame, const std::vector<size_t>& numbers) {
  Frame some;
  some.display = frame.display;
  some.window = frame.window;
  some.attributes = frame.attributes;
  for (const size_t i : numbers) {
    const View& view = frame.views.at(i);
    View& copy = some.views.emplace_back();
    copy.name = view.name;
    copy.camera = view.camera;
    copy.origin = view.origin;
    for (const auto& [name, plane] : view.planes) copy.planes[name] = plane.clone();
  }
  return some;
}

}  // namespace gloam::bench
