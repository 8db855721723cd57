// The picture of `gloam auto`: which effects a frame calls for, where, and why.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

/// What `gloam auto` has found about one effect.
struct Explanation {
  std::string title, why, cost;  ///< lines of text
  const Plane* where = nullptr;  ///< above 0 where the effect is called for; one value per pixel or square tile
  bool is_everywhere = false;
};

/// Draws a view's colours (or its surfaces lit from the eye, if it has none), tinted where effects are called for, and below it the
/// lines of each effect. PNG, written atomically.
void write_explanation(const std::filesystem::path& path, const View& view,
                       const std::vector<Explanation>& explanations);

}  // namespace gloam
