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
  std::filesystem::path checkpoint = {};  ///< and the rest as for `ao_reference`
  double checkpoint_seconds = 15;
  std::function<void(double share_done)> progress = {};
};

/// Light that the visible surfaces reflect towards the eye: two bounces. The first is on the visible surface: GGX with
/// height-correlated Smith and Schlick's Fresnel, about the frame's normal, with the frame's `roughness` and `reflectance` where
/// it has them (else the scene's). The second is on what is met there: its `radiance` (radiance.h), the same in every
/// direction, as the captured color has it; or the sky. Directions under the surface bring nothing.
///
/// Planes `reflection`, whose a is the share of the light's weight that comes from something that a view of the frame shows,
/// so that a screen-space ray could meet it; and `reflection_noise`, the error of the mean of r, g and b. Background is 0.
/// Numbers and attributes: reflectionSamples, reflectionNoise, gloamExposure (what brings nearly all of it to 1 at most),
/// reflectionDefinition, gloamScene.
/// Throws as `ao_reference` does.
Reference reflection_reference(const Tracer& tracer, const Frame& frame, const ReflectionReferenceOptions& options);

}  // namespace gloam
