// Linear estimates of a camera from positions, as starts of a refinement.
#pragma once

#include <vector>

#include "camera/camera_fit.h"

namespace gloam {

/// How the positions lie: standard deviations along their principal axes, the longest first.
struct Spread {
  glm::dvec3 centre{0.0};
  glm::dmat3 axes{1.0};  ///< columns, right-handed
  glm::dvec3 deviations{0.0};
};

/// Of the errors of the pixels' positions.
double median_error(const Camera& camera, const std::vector<PositionedPixel>& pixels);

Spread spread_of(const std::vector<PositionedPixel>& pixels);

/// Cameras that may explain the positions: perspective from all of space (direct linear transform), perspective from a plane if
/// they nearly lie in one, and orthographic. Each is the best of many small samples, so that wild positions do not matter.
std::vector<Camera> linear_cameras(const std::vector<PositionedPixel>& pixels, const FitPrior& prior);

}  // namespace gloam
