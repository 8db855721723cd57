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

/// The median depth of the surfaces in the image, of `fitting_size`, of a camera: that of the screen for a display that shows the
/// camera's image (`fitted_to` in light_field.h). None if the camera sees nothing of the scene. The camera needs a pose.
std::optional<double> fitting_depth(const LightFieldDisplay& display, const Tracer& tracer, const Camera& camera);

/// A display that shows the part of the world in that image, with the surfaces at the median depth in the screen. None as above.
std::optional<LightFieldDisplay> fitted_to(const LightFieldDisplay& display, const Tracer& tracer,
                                           const Camera& camera);

/// The views of all modules, for images of a size. The display must state which part of the world it shows.
std::vector<CaptureView> module_views(const LightFieldDisplay& display, int width, int height);

}  // namespace gloam
