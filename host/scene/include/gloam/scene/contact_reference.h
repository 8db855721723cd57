// Ray-traced shadows near what casts them: the truth of contact shadows.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "gloam/scene/reference.h"

namespace gloam {

/// `radius` is the length of the shadow rays.
struct ContactReferenceOptions : ReferenceOptions {
  std::optional<glm::dvec3> light_direction;  ///< world, towards a light without end; need not be unit
  std::optional<glm::dvec3> light_position;   ///< world, scene units; neither: the scene's sun
  double light_angle = 0;  ///< angular radius of the light's disc, degrees, 0 to `most_light_angle`; 0: a point
};

inline constexpr double most_light_angle = 80;

/// Share of a light that arrives: 1 where nothing is between the surface and the light within a length, 0 where something is, and 0
/// where the surface faces away, by its normal or by its triangle. A light with a disc is the mean over points of the disc, each
/// taken by itself; every surface sees a disc of the same angular radius.
///
/// Planes: `contact` and `contact_noise`; background is 1 and 0. Numbers and attributes: contactLength, contactSamples (1 without a
/// disc), contactNoise, contactDefinition, gloamScene. Where no surface that the frame shows is lit, a note says so, and whether the
/// light lies inside a closed mesh. Throws as `ao_reference` does, and UsageError for two lights, a direction of length 0, a light
/// that is not finite, and an angle out of range.
Reference contact_reference(const Tracer& tracer, const Frame& frame, const ContactReferenceOptions& options);

}  // namespace gloam
