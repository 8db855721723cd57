// Light-field displays: rows of optical modules behind a screen that spreads light upwards and downwards alone, so that who
// moves sideways along the observer line sees another picture (Balogh et al. 2007; Doronin, Kara, Barsi, Martini 2017).
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam {

/// Where an optical module stands in physical space (`TwoSlits`) and which way it throws its light.
struct OpticalModule {
  glm::dvec3 position{0.0, 0.0, -1.0};
  double yaw = 0, pitch = 0;  ///< degrees, to the right and up, of the observers that look at the screen
};

/// What the screen's middle shows, and how the world's axes turn, stretch and shear into those of physical space:
/// physical = linear * (world - origin).
struct WorldToPhysical {
  glm::dmat3 linear{1.0};
  glm::dvec3 origin{0.0};  ///< in double: it may be far from the world's own origin
};

/// What a display JSON says (display_json.h). Lengths in the display's units.
struct LightFieldDisplay {
  std::string name;
  double observer_distance = 1, observer_height = 0;  ///< of the observer line, from the screen's middle
  double screen_width = 1, screen_height = 1;
  std::optional<double> screen_radius;  ///< of an upright cylinder, convex to the observers; none: flat
  int width = 1024, height = 768;       ///< pixels of each module's image
  std::vector<OpticalModule> modules;
  std::optional<WorldToPhysical> world;  ///< without it a capture chooses one
};

/// "module00", "module01", ...: names of views, with as many digits as the last one needs, two at least.
std::vector<std::string> module_names(const LightFieldDisplay& display);

/// The camera of every module, by name, in pixels of an image of `window`'s size. Each image holds the module's view of the whole
/// screen. The poses are the same: all modules share one view space.
/// Throws Error for a display that does not say which part of the world it shows.
std::vector<std::pair<std::string, Camera>> module_cameras(const LightFieldDisplay& display, const Window& window);

/// With the part of the world on display that a camera's image frames: who stands in the middle of the observer line stands where
/// the camera does, and its image at `depth` fills the screen from top to bottom, about its middle. The camera has a pose.
LightFieldDisplay fitted_to(LightFieldDisplay display, const Camera& camera, const Window& window, double depth);

}  // namespace gloam
