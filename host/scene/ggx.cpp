#include "scene/ggx.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace gloam {
namespace {

using glm::dvec2;
using glm::dvec3;

/// A visible microfacet's normal seen from `v`, z up (Dupuy and Benyoub 2023).
dvec3 visible_normal(const dvec3& v, double alpha, const dvec2& u) {
  const dvec3 w = glm::normalize(dvec3(alpha * v.x, alpha * v.y, v.z));
  const double angle = glm::two_pi<double>() * u.y, z = (1 - u.x) * (1 + w.z) - w.z;
  const double r = std::sqrt(std::max(1 - z * z, 0.0));
  const dvec3 h = dvec3(r * std::cos(angle), r * std::sin(angle), z) + w;
  return glm::normalize(dvec3(alpha * h.x, alpha * h.y, std::max(h.z, 1e-9)));
}

/// Smith's Lambda: microfacets hidden per microfacet seen.
double hidden_per_seen(double alpha, const dvec3& v) {
  return 0.5 * (std::sqrt(1 + alpha * alpha * (v.x * v.x + v.y * v.y) / (v.z * v.z)) - 1);
}

/// As in the kernels.
dvec3 above_surface(dvec3 v) {
  v.z = std::max(v.z, 1e-3);
  return glm::normalize(v);
}

}  // namespace

GgxLobe::GgxLobe(float roughness, const dvec3& to_eye)
    : is_mirror_(roughness < mirror_roughness),
      alpha_(double(std::max(mirror_roughness, roughness))),  // in this order NaN becomes a narrow lobe
      to_eye_(above_surface(to_eye)) {
  alpha_ *= alpha_;
  masked_ = hidden_per_seen(alpha_, to_eye_);
}

GgxLobe::Sample GgxLobe::sample(const dvec2& u) const {
  const dvec3 h = is_mirror_ ? dvec3(0, 0, 1) : visible_normal(to_eye_, alpha_, u);
  Sample sample;
  sample.cosine = glm::dot(to_eye_, h);
  sample.direction = 2 * sample.cosine * h - to_eye_;
  if (sample.direction.z <= 0) return sample;
  sample.weight = is_mirror_ ? 1 : (1 + masked_) / (1 + masked_ + hidden_per_seen(alpha_, sample.direction));
  return sample;
}

}  // namespace gloam
