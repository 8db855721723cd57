// Ray-traced openness of glossy lobes: the truth of specular occlusion.
#pragma once

#include "gloam/scene/reference.h"

namespace gloam {

/// Share of the light of a GGX lobe whose directions are open within the radius, under a sky of equal light: the integral of
/// V * BRDF * cosine over that of BRDF * cosine. The BRDF is GGX about the frame's normal, seen from the eye, with
/// height-correlated Smith masking, alpha = roughness^2, and Fresnel left out; V is 1 in a direction in which nothing is within the
/// radius, else 0. Directions below the surface are closed. The roughness is the frame's, if it has one, else the scene's; below
/// 0.03 a surface is a mirror, with one direction and no noise.
///
/// Both integrals are sums over the microfacets that the eye sees (Dupuy and Benyoub 2023); the bias of their ratio is of the order
/// of 1 / samples.
///
/// Planes: `specular_occlusion` and `specular_occlusion_noise`; background is 1 and 0. Numbers and attributes:
/// specular_occlusionRadius, specular_occlusionSamples, specular_occlusionNoise, specular_occlusionDefinition, gloamScene. Throws as
/// `ao_reference` does.
Reference specular_occlusion_reference(const Tracer& tracer, const Frame& frame, const ReferenceOptions& options);

}  // namespace gloam
