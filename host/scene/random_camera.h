// Cameras at random in a scene, the same on every machine for the same seed.
#pragma once

#include <optional>

#include "base/random.h"
#include "gloam/frame.h"
#include "gloam/scene/tracer.h"

namespace gloam {

/// A camera between one of the scene's own and a surface that it sees, looking at another surface that it sees. None where one of
/// these is missing: try again.
std::optional<SceneCamera> random_camera(const Tracer& tracer, Random& random);

/// Surfaces, and those nearer to the eye than the radius, over all pixels.
struct SurfaceShares {
  double surfaces = 0, near = 0;
};
SurfaceShares surface_shares(const Channel& depth, double radius);

/// Whether an image shows enough surfaces to measure on, and few that are nearer to the eye than the radius.
bool shows_enough(const SurfaceShares& shares);

}  // namespace gloam
