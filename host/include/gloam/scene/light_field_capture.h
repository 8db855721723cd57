// What a light-field display shows of a scene.
#pragma once

#include <optional>
#include <vector>

#include "gloam/light_field.h"
#include "gloam/scene/capture.h"

namespace gloam {

/// Pixels of a small image as wide as the display's screen, from top to bottom what the screen shows.
struct FittingSize {
  int width = 1, height = 1;
};
FittingSize fitting_size(const LightFieldDisplay& display);

/// With the part of the world on display that a camera of an image of `fitting_size` frames: the median depth of what it sees comes
/// to lie in the screen. None where it sees nothing of the scene. The camera has a pose.
std::optional<LightFieldDisplay> fitted_to(const LightFieldDisplay& display, const Tracer& tracer,
                                           const Camera& camera);

/// The views of all modules, for images of a size. The display says which part of the world it shows.
std::vector<CaptureView> module_views(const LightFieldDisplay& display, int width, int height);

}  // namespace gloam
