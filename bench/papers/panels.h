// Images side by side with their names: the figures of a paper.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gloam/frame.h"
#include "gloam/stereo_consistency.h"

namespace gloam::bench {

/// Factor on errors in panels: an error of 0.05 is white (Shi, Billeter, Eisemann 2022, figure 9).
inline constexpr double error_magnification = 20;

struct Panel {
  std::string label;
  Plane plane;  ///< one component, 0 to 1, or a unit vector
  /// Magnified errors to show instead; pixels that do not count show the plane.
  std::optional<StereoErrors> errors = {};
};

/// Draws panels of equal size in rows of up to `columns`. PNG, written atomically.
void write_panels(const std::filesystem::path& path, const std::vector<Panel>& panels, int columns);

}  // namespace gloam::bench
