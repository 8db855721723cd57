// Images side by side, each under its name: the figures of a paper.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gloam/frame.h"
#include "gloam/stereo_consistency.h"

namespace gloam::bench {

/// Of errors: one of 0.05 is white (Shi, Billeter, Eisemann 2022, figure 9).
inline constexpr double error_magnification = 20;

struct Panel {
  std::string label;
  Plane plane;  ///< of one component, 0 to 1, or a unit vector
  /// Shown instead, magnified, with the plane under what does not count.
  std::optional<StereoErrors> errors = {};
};

/// In rows of up to `columns`, all of the same size. PNG, written atomically.
void write_panels(const std::filesystem::path& path, const std::vector<Panel>& panels, int columns);

}  // namespace gloam::bench
