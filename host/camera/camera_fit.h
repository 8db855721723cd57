// The camera that explains where surfaces lie: fitted to pixels and the world positions that they show.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <vector>

#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam {

/// A pixel and the position that it shows.
struct PositionedPixel {
  glm::dvec2 pixel{0.0};  ///< of its centre, as in `Camera`
  glm::dvec3 world{0.0};
  double rounding = 0;  ///< standard deviation of the stored coordinates by their rounding, scene units
  double depth = std::numeric_limits<double>::quiet_NaN();  ///< as the file has it, its sign left out; NaN: none
};

/// What the image is known to be before anything is fitted.
struct FitPrior {
  Window display;
  double pixel_aspect = 1;  ///< width of a pixel over its height
};

/// What a fit had to take for granted, as the positions do not tell.
enum class FitAssumption { none, square_pixels, centred_lens };

struct CameraFit {
  Camera camera;  ///< with a pose
  std::string
      why_refused;  ///< empty if the camera can be used; else the end of a sentence: "all of them lie in one plane ..."
  FitAssumption assumption = FitAssumption::none;
  double median = 0, percentile_99 = 0;  ///< distance in the image of a position from its pixel's centre, pixels
  double rounding = 0;                   ///< the median that the rounding of the positions alone explains, pixels
  size_t used = 0;                       ///< pixels
};

/// Fits a perspective or an orthographic camera with a linear start and a robust refinement, all in double. A right-handed world
/// gives a rotation, a left-handed one a mirrored one. Positions that no camera explains (edges against the background, noise) are
/// outvoted up to three tenths of all. Pixels are taken as square, and the lens as centred, where the positions do not tell otherwise.
/// An orthographic camera stands one extent of the scene before its nearest position, and its world is taken as right-handed.
/// Refuses what does not determine a camera, and what no camera explains to half a pixel or to twice the rounding of the positions.
CameraFit fit_camera(const std::vector<PositionedPixel>& pixels, const FitPrior& prior);

/// Distances in the image of the positions from their pixels' centres, for a camera with a pose: pixels; infinite behind the camera.
std::vector<double> position_errors(const Camera& camera, const std::vector<PositionedPixel>& pixels);

/// The value below which `share` of them lie. Not empty.
double share_below(std::vector<double> values, double share);

/// Largest median error, pixels, of positions that belong to a camera: half a pixel, or twice their rounding up to 3 pixels.
double allowed_error(const Camera& camera, const std::vector<PositionedPixel>& pixels);

}  // namespace gloam
