// A few rows of a file's positions, for what positions tell about cameras.
#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "camera/camera_fit.h"
#include "exr/file.h"

namespace gloam {

struct PositionSamples {
  std::vector<PositionedPixel> pixels;  ///< that show a surface
  std::optional<glm::vec3>
      background;  ///< as stored, relative to gloamOrigin: a position that many pixels share; else none
};

/// Pixels of about `rows` rows, up to 64 in a row, of each view that has positions. A block of the file is decoded once. Background
/// (depth or position zero, not finite or 1e10 and more; a position that many pixels share; alpha 0) is left out, and pixels with
/// alpha between 0 and 1 where enough others are left.
std::map<std::string, PositionSamples> sample_positions(const ExrFile& file, int rows);

}  // namespace gloam
