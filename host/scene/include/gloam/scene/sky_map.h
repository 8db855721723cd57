// The sky of a scene as a lat-long map.
#pragma once

#include "gloam/frame.h"
#include "gloam/scene/scene.h"

namespace gloam {

/// The radiance that rays meet where they leave the scene (`sky_radiance`), in the axes `openexr` (environment_map.h), twice as wide as
/// high: a frame with the plane color and the attribute envmap. The sun is not in it.
Frame sky_map(const Scene& scene, int height = 512);

}  // namespace gloam
