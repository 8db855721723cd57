// Ray-traced reflection of a captured frame: the truth that techniques are measured against.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "gloam/frame.h"
#include "gloam/scene/reference.h"
#include "gloam/scene/tracer.h"

namespace gloam {

struct ReflectionReferenceOptions {
  int samples = 1024;  ///< rays per pixel, rounded up to a multiple of 32; mirrors take 32
  uint32_t seed = 0;
  std::filesystem::path checkpoint = {};  ///< as in `AoReferenceOptions`, like what follows
  double checkpoint_seconds = 15;
  std::function<void(double share_done)> progress = {};
  std::function<void()> poll = {};
};

/// Light that the visible surfaces reflect towards the eye: two bounces. The first, on the visible surface: GGX with
/// height-correlated Smith and Schlick's Fresnel, about the frame's normal, with the frame's `roughness` and `reflectance` if it
/// has them (else the scene's). The second, on the surface that a ray meets: its `radiance` (radiance.h), the same in every
/// direction, as in captured colours; or the sky. Directions below the surface contribute nothing.
///
/// Planes: `reflection`, whose a is the weighted share of the light from surfaces that a view of the frame shows, so that a
/// screen-space ray could meet them; and `reflection_noise`, the error of the mean of r, g and b. Background is 0.
/// Numbers and attributes: reflectionSamples, reflectionNoise, gloamExposure (brings nearly all values to 1 at most),
/// reflectionDefinition, gloamScene. Throws as `ao_reference` does.
Reference reflection_reference(const Tracer& tracer, const Frame& frame, const ReflectionReferenceOptions& options);

}  // namespace gloam
