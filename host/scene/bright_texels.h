// Directions towards the bright parts of an environment, such as its sun, which few directions drawn evenly would find.
#pragma once

#include <vector>

#include "gloam/environment_map.h"

namespace gloam {

/// Draws directions in proportion to what texels have above the mean of the map, interpolated as its radiance is (what is below is
/// left to directions drawn another way: Karlik et al. 2019).
class BrightTexels {
 public:
  explicit BrightTexels(const EnvironmentMap& map);

  /// False if the map is so even that drawing texels would not help.
  bool any() const { return !rows_.empty(); }

  /// For u in [0,1)^2; only if there are any.
  glm::dvec3 direction(const glm::dvec2& u) const;
  /// Density of `direction`, per steradian; 0 if there are no bright texels.
  double density(const glm::dvec3& direction) const;

 private:
  double probability(int x, int y) const;

  const EnvironmentMap& map_;
  std::vector<double> rows_;     ///< cumulated, ending with 1
  std::vector<double> columns_;  ///< cumulated within each row, ending with 1; of rows without bright texels 0
};

}  // namespace gloam
