// Ray-traced light from the surfaces around: the truth of indirect diffuse light.
#pragma once

#include "gloam/scene/reference.h"

namespace gloam {

/// Light that arrives by one reflection: mean over cosine-weighted directions about the normal of the radiance that the first
/// surface within the radius sends to the pixel; 0 where nothing is within the radius. That is irradiance / pi, not yet times the
/// receiver's albedo. What a surface sends is `radiance` (radiance.h): its emission, and what its diffuse part makes of the scene's
/// own sun, with shadows, and sky, as in captured colours. Both sides of a surface are lit and send light. Directions below the
/// pixel's surface bring nothing.
///
/// Planes: `indirect` (r, g, b) and `indirect_noise`, the error of the mean of r, g and b; background is 0. Numbers and attributes:
/// indirectRadius, indirectSamples, indirectNoise, indirectDefinition, gloamScene. Throws as `ao_reference` does, and Error for a
/// scene without light, with negative light, or with an albedo outside 0 to 1.
Reference indirect_reference(const Tracer& tracer, const Frame& frame, const ReferenceOptions& options);

}  // namespace gloam
