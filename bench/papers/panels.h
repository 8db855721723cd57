// Images side by side, each under its name: the figures of a paper.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam::bench {

struct Panel {
  std::string label;
  Plane plane;  ///< of one component, 0 to 1, or a unit vector
};

/// In rows of up to `columns`, all of the same size. PNG, written atomically.
void write_panels(const std::filesystem::path& path, const std::vector<Panel>& panels, int columns);

}  // namespace gloam::bench
