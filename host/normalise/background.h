// Recognises background depths and sets them to +inf.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "gloam/frame.h"

namespace gloam {

/// Depths that renderers write for "nothing here" start at 1e10 (Blender); no scene reaches it.
inline constexpr float farthest_depth = 1e10f;
/// Smaller depths count as background: they would turn denormal in a product. The bound is far below the unit of any scene.
inline constexpr float nearest_depth = 1e-30f;

/// Whether a value is no such mark of either sign, NaN or infinity.
inline bool is_no_mark(float value) { return std::abs(value) < farthest_depth; }

/// Values that mean background besides infinities, NaN, 0 and negative numbers. A value from the user replaces the rule for 1e10.
struct Background {
  float value = std::numeric_limits<float>::quiet_NaN();  ///< --background; NaN equals nothing
  float from = farthest_depth;                            ///< anything from here on is background
  float far_low = std::numeric_limits<float>::infinity(),
        far_high = -std::numeric_limits<float>::infinity();  ///< the far plane with its rounding; empty if not known
};

/// `value`: --background. `far`: the far plane, if known.
Background background_of(std::optional<float> value, std::optional<double> far);

/// Bitwise operators, so that a loop over it becomes vector instructions. NaN fails the first comparison.
inline bool is_surface(float depth, const Background& background) {
  const bool at_far = (depth >= background.far_low) & (depth <= background.far_high);
  return (depth >= nearest_depth) & (depth < background.from) & !at_far & (depth != background.value);
}

/// For planar depth: sets background to +inf and applies the sign.
void clean_depth_row(float* row, int width, float sign, const Background& background);
/// As above, of all rows.
void clean_depth(Channel& depth, float sign, const Background& background);

}  // namespace gloam
