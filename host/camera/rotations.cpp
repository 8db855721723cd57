#include "camera/rotations.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "gloam/error.h"

namespace gloam {

namespace {

/// Renderers write matrices as floats: a rotation may be off by their rounding, but not by more.
constexpr double rotation_tolerance = 1e-4;

/// The largest element of m^T m - 1: 0 for a rotation, mirrored or not.
double distance_from_rotation(const glm::dmat3& m) {
  const glm::dmat3 residual = glm::transpose(m) * m - glm::dmat3(1.0);
  double largest = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) largest = std::fmax(largest, std::abs(residual[i][j]));
  return largest;
}

}  // namespace

glm::dmat3 nearest_rotation(glm::dmat3 m) {
  for (int i = 0; i < 4; ++i) m = 0.5 * (m + glm::transpose(glm::inverse(m)));
  return m;
}

std::string rotation_fault(const glm::dmat3& m) {
  if (distance_from_rotation(m) <= rotation_tolerance) return "";
  const double x = glm::length(m[0]), y = glm::length(m[1]), z = glm::length(m[2]);
  const double largest = std::max({x, y, z});
  if (!(std::abs(glm::determinant(m)) > 1e-12 * largest * largest * largest)) return "is singular";
  if (distance_from_rotation(m / x) <= rotation_tolerance) return fmt::format("scales by {:.6g}", x);
  return "scales or shears its axes";
}

}  // namespace gloam
