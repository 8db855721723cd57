// Microfacets after GGX with height-correlated Smith masking, in double: what references of gloss share.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace gloam {

/// Below this roughness a surface is a mirror: all rays go one way (the same bound as in kernels/shared/rays/ggx.h).
inline constexpr float mirror_roughness = 0.03f;

/// The lobe of a surface of some roughness seen from `to_eye`, about +z.
class GgxLobe {
 public:
  /// `to_eye` is unit. It may lie below the surface, as a shading normal may face away; it is lifted just above then.
  GgxLobe(float roughness, const glm::dvec3& to_eye);

  bool is_mirror() const { return is_mirror_; }

  struct Sample {
    glm::dvec3 direction;  ///< unit; those that do not leave the surface (z at most 0) carry no light
    double weight =
        0;  ///< G2 / G1: share of the light, without Fresnel, that is not masked on its way to the microfacet
    double cosine = 0;  ///< between direction and microfacet, for Fresnel
  };
  /// A direction in proportion to the microfacets that the eye sees. A mirror's is the same for each u in [0,1)^2.
  Sample sample(const glm::dvec2& u) const;

 private:
  bool is_mirror_;
  double alpha_;
  glm::dvec3 to_eye_;
  double masked_;  ///< Smith's Lambda towards the eye
};

}  // namespace gloam
