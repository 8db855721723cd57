// Images of a scene for a light-field display.
#pragma once

#include <optional>
#include <vector>

#include "gloam/light_field.h"
#include "gloam/scene/capture.h"

namespace gloam {

/// Size in pixels of a small image with the shape of the display's screen.
struct FittingSize {
  int width = 1, height = 1;
};
FittingSize fitting_size(const LightFieldDisplay& display);

/// A display that shows the part of the world in the image, of `fitting_size`, of a camera: the median depth of its surfaces lies
/// in the screen. None if the camera sees nothing of the scene. The camera needs a pose.
std::optional<LightFieldDisplay> fitted_to(const LightFieldDisplay& display, const Tracer& tracer,
                                           const Camera& camera);

/// The views of all modules, for images of a size. The display must state which part of the world it shows.
std::vector<CaptureView> module_views(const LightFieldDisplay& display, int width, int height);

}  // namespace gloam
