// Light-field displays: rows of optical modules behind a screen that spreads light upwards and downwards only, so that an observer
// who moves sideways along the observer line sees another picture (Balogh et al. 2007; Doronin, Kara, Barsi, Martini 2017).
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam {

/// Position of an optical module in physical space (`TwoSlits`), and the direction of its light.
struct OpticalModule {
  glm::dvec3 position{0.0, 0.0, -1.0};
  double yaw = 0, pitch = 0;  ///< degrees, to the right and up as the observers see it
};

/// The point of the world in the middle of the screen, and how the world's axes turn, stretch and shear into those of physical
/// space: physical = linear * (world - origin).
struct WorldToPhysical {
  glm::dmat3 linear{1.0};
  glm::dvec3 origin{0.0};  ///< in double: it may be far from the world's own origin
};

/// Contents of a display JSON (display_json.h). Lengths in the display's units.
struct LightFieldDisplay {
  std::string name;
  double observer_distance = 1, observer_height = 0;  ///< of the observer line, from the middle of the screen
  double screen_width = 1, screen_height = 1;
  std::optional<double> screen_radius;  ///< radius of an upright cylinder, convex to the observers; none: flat
  int width = 1024, height = 768;       ///< pixels of each module's image
  std::vector<OpticalModule> modules;
  std::optional<WorldToPhysical> world;  ///< none: a capture chooses one
};

/// Names of the views: "module00", "module01", ..., with as many digits as the last one needs, at least two.
std::vector<std::string> module_names(const LightFieldDisplay& display);

/// The camera of every module, by name, in pixels of an image of `window`'s size. Each image holds the module's view of the whole
/// screen. All modules share one pose: that of the display's view space. Throws Error if the display does not state which part of
/// the world it shows.
std::vector<std::pair<std::string, Camera>> module_cameras(const LightFieldDisplay& display, const Window& window);

/// A display that shows the part of the world in a camera's image: the middle of the observer line is at the camera's position, and
/// the image at `depth` (scene units) fills the screen from top to bottom, about its middle. The camera needs a pose.
LightFieldDisplay fitted_to(LightFieldDisplay display, const Camera& camera, const Window& window, double depth);

}  // namespace gloam
