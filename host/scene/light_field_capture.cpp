#include "gloam/scene/light_field_capture.h"

#include <algorithm>
#include <cmath>

#include "gloam/scene/secondary_camera.h"

namespace gloam {

FittingSize fitting_size(const LightFieldDisplay& display) {
  constexpr int height = 90;  // only the middle depth is asked for
  return {std::max(1, int(std::lround(height * display.screen_width / display.screen_height))), height};
}

std::optional<double> fitting_depth(const LightFieldDisplay& display, const Tracer& tracer, const Camera& camera) {
  const FittingSize size = fitting_size(display);
  CaptureOptions options{.width = size.width, .height = size.height};
  options.views = {{"", camera, {}}};
  const CaptureResult seen = capture(tracer, options);
  const auto depths = visible_depths(seen.frame.views[0].planes.at("depth").channels[0]);
  if (!depths) return {};
  return depths->median;
}

std::optional<LightFieldDisplay> fitted_to(const LightFieldDisplay& display, const Tracer& tracer,
                                           const Camera& camera) {
  const FittingSize size = fitting_size(display);
  const std::optional<double> depth = fitting_depth(display, tracer, camera);
  if (!depth) return {};
  return fitted_to(display, camera, {0, 0, size.width, size.height}, *depth);
}

std::vector<CaptureView> module_views(const LightFieldDisplay& display, int width, int height) {
  std::vector<CaptureView> views;
  for (const auto& [name, camera] : module_cameras(display, {0, 0, width, height})) views.push_back({name, camera, {}});
  return views;
}

}  // namespace gloam
