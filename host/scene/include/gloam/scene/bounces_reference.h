// Ray-traced ambient light with interreflection: the truth of AO that knows the surfaces' colours.
#pragma once

#include "gloam/scene/reference.h"

namespace gloam {

struct BouncesReferenceOptions : ReferenceOptions {
  /// Reflections after which a path ends; 0: none, which is AO. What a longer path would bring is lost, so that values are too
  /// low by at most the scene's largest albedo to this power.
  int bounces = 128;
};

/// Largest `BouncesReferenceOptions::bounces`.
inline constexpr int most_bounces = 1024;

/// Ambient light that arrives, with the light that surfaces reflect among each other: G(x) = mean over cosine-weighted directions
/// about the normal of 1 where nothing is within the radius, else of albedo * G at the surface that is met, with the same radius
/// there. 1 is as from an open white sky. Directions below the surface bring nothing. The albedo is the scene's base colour,
/// also that of metals. Paths end at random once their weight is low (Russian roulette), which adds no bias.
///
/// Planes: `bounces` (r, g, b) and `bounces_noise`, the error of the mean of r, g and b. Background is 1 and 0.
/// Numbers and attributes: bouncesRadius, bouncesSamples (paths per pixel), bouncesNoise, bouncesMost, bouncesDefinition,
/// gloamScene. Throws as `ao_reference` does, and Error for a scene with an albedo outside 0 to 1.
Reference bounces_reference(const Tracer& tracer, const Frame& frame, const BouncesReferenceOptions& options);

}  // namespace gloam
