// Robust nonlinear refinement of a fitted camera.
#pragma once

#include <optional>
#include <vector>

#include "camera/camera_fit.h"

namespace gloam {

struct Refined {
  Camera camera;
  double cost = 0;   ///< robust sum of squares, in units of the expected error
  double sigma = 1;  ///< scale of the errors, in units of the expected error; at least 1
  /// Standard deviations that the positions leave: of the logarithms of the focal length and of the aspect, and of the principal
  /// point, pixels. Large where they do not tell.
  double focal_error = 0, aspect_error = 0, centre_error = 0;
};

/// Least errors that are told apart, pixels: positions are floats.
inline constexpr double least_error = 1e-3;

/// Changes the pose, the focal lengths and the principal point, as far as the assumption leaves them free, until the robust sum of
/// squared errors is least (Levenberg and Marquardt, weights of Geman and McClure). None if the camera leaves the numbers' range.
std::optional<Refined> refine_camera(const Camera& start, const std::vector<PositionedPixel>& pixels,
                                     FitAssumption assumption);

}  // namespace gloam
