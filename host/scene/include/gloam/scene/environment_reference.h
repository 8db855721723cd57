// Ray-traced light of an environment: the truth of image-based light.
#pragma once

#include "gloam/environment_map.h"
#include "gloam/scene/reference.h"

namespace gloam {

/// Light of an environment that arrives: mean over cosine-weighted directions about the normal of the environment's radiance in
/// directions in which nothing is within the radius, and 0 in others. That is irradiance / pi, not yet times the receiver's albedo.
/// Directions below the surface are closed. Where a map has bright parts, as many rays again go towards these, and both sorts are
/// weighted by the balance heuristic (Veach 1997).
///
/// Planes: `environment` (r, g, b) and `environment_noise`, the error of the mean of r, g and b; background is 0. Numbers and
/// attributes: environmentRadius, environmentSamples (cosine-weighted ones), environmentNoise, environmentDefinition, gloamScene.
/// Throws as `ao_reference` does.
Reference environment_reference(const Tracer& tracer, const Frame& frame, const EnvironmentMap& map,
                                const ReferenceOptions& options);

}  // namespace gloam
