#include "normalise/common_turn.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace gloam {

using glm::dmat3;
using glm::dvec3;

// Pairs that lie far apart are edges and curved surfaces, and say nothing of a small turn.
CommonTurn small_turn(const std::vector<NormalPair>& pairs, const NormalForm& form, const std::optional<Pose>& pose) {
  constexpr double near = 0.8;  // cosine
  dmat3 spread(0.0);
  dvec3 sum(0.0);
  double count = 0;
  for (const NormalPair& pair : pairs) {
    const dvec3 given = view_normal(pair.stored, form, pose);
    if (!(glm::dot(given, pair.from_depth) > near)) continue;
    spread += dmat3(1.0) - glm::outerProduct(given, given);
    sum += glm::cross(given, pair.from_depth);
    ++count;
  }
  if (count == 0) return {};
  // Normals of one direction do not tell a turn about it: the small addition leaves it out.
  const dvec3 turn = glm::inverse(spread + 1e-3 * count * dmat3(1.0)) * sum;
  const double angle = glm::length(turn);
  const dmat3 rotation(angle > 0 ? glm::rotate(glm::dmat4(1.0), angle, turn / angle) : glm::dmat4(1.0));
  double agreement = 0;
  for (const NormalPair& pair : pairs)
    agreement += glm::dot(rotation * view_normal(pair.stored, form, pose), pair.from_depth);
  return {glm::degrees(angle), agreement / double(pairs.size()), count / double(pairs.size())};
}

// A quaternion that maximises the sum of cosines (Horn 1987): the eigenvector of the largest eigenvalue, by
// repeated multiplication.
CommonTurn any_turn(const std::vector<NormalPair>& pairs, const NormalForm& form, const std::optional<Pose>& pose) {
  dmat3 s(0.0);  // s[a][i]: component i of the normals with axis a of the depth's
  for (const NormalPair& pair : pairs) s += glm::outerProduct(view_normal(pair.stored, form, pose), pair.from_depth);
  const auto at = [&](int i, int a) { return s[a][i] / double(pairs.size()); };
  const double trace = at(0, 0) + at(1, 1) + at(2, 2);
  glm::dmat4 n(0.0);
  n[0][0] = trace;
  for (int i : {0, 1, 2}) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    n[0][i + 1] = n[i + 1][0] = at(j, k) - at(k, j);
    for (int other : {0, 1, 2}) n[i + 1][other + 1] = at(i, other) + at(other, i);
    n[i + 1][i + 1] = 2 * at(i, i) - trace;
  }
  glm::dvec4 quaternion(1, 1e-3, 2e-3, 3e-3);  // near to no turn
  for (int step = 0; step < 200; ++step) {
    quaternion = n * quaternion + 1.5 * quaternion;  // no eigenvalue is below -1
    quaternion /= glm::length(quaternion);
  }
  return {2 * glm::degrees(std::acos(std::min(1.0, std::abs(quaternion[0])))), glm::dot(quaternion, n * quaternion), 1};
}

}  // namespace gloam
