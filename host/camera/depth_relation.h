// What a file's depth is, told by positions and a camera.
#pragma once

#include <vector>

#include "camera/camera_fit.h"

namespace gloam {

struct DepthRelation {
  /// `unknown`: without depths, or both readings fit (a narrow view). `neither`: no reading fits.
  enum Kind { unknown, planar, along_ray, neither } kind = unknown;
  double scale = 1;  ///< depth for one unit of the positions; 1 where nothing is known
};

/// For a perspective camera with a pose that explains the positions.
DepthRelation relate_depth(const Camera& camera, const std::vector<PositionedPixel>& pixels);

/// For a fitted orthographic camera, whose place along its axis and whose world's handedness only depths tell: puts it where its
/// depths are those of the file, and mirrors its axis if depths grow against it.
DepthRelation place_by_depth(Camera& camera, const std::vector<PositionedPixel>& pixels);

}  // namespace gloam
