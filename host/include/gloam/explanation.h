// The picture of `gloam auto`: where a frame calls for what, and why.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

/// What `gloam auto` has found out of one effect.
struct Explanation {
  std::string title, why, cost;  ///< lines of text
  const Plane* where = nullptr;  ///< above 0 where it is called for: one pixel for each pixel or square tile
  bool is_everywhere = false;
};

/// A view's colours, or its surfaces lit from the eye where it has none, tinted where effects are called for, and under
/// it the lines of each. PNG, written atomically.
void write_explanation(const std::filesystem::path& path, const View& view,
                       const std::vector<Explanation>& explanations);

}  // namespace gloam
