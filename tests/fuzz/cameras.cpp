#include "fuzz/cameras.h"

#include <cmath>

#include "fuzz/promise.h"

namespace gloam::fuzz {
namespace {

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Mirrored or not: a header may describe a left-handed world.
bool is_rotation(const glm::dmat3& m) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      double product = 0;
      for (int k = 0; k < 3; ++k) product += m[i][k] * m[j][k];
      if (!(std::abs(product - (i == j)) < 1e-9)) return false;
    }
  }
  return true;
}

}  // namespace

void check_camera(const Camera& camera) {
  require(std::isfinite(camera.fx) && std::isfinite(camera.fy), "a focal length is finite");
  require(camera.fx > 0 && camera.fy > 0, "a focal length is above 0");
  require(std::isfinite(camera.cx) && std::isfinite(camera.cy), "a principal point is finite");
  if (camera.near && camera.far) require(*camera.near < *camera.far, "near is before far");
  require(!camera.source.empty(), "a camera says where it is from");
  if (!camera.pose) return;
  require(is_finite(camera.pose->position), "a camera stands somewhere");
  require(is_rotation(camera.pose->world_to_view), "a pose turns and does nothing else");
}

}  // namespace gloam::fuzz
