// Which depths are background, and how they become +inf.
#pragma once

#include <limits>
#include <optional>

#include "gloam/frame.h"

namespace gloam {

/// What renderers write for "nothing here" starts at 1e10 (Blender), and no scene reaches it.
inline constexpr float farthest_depth = 1e10f;
/// Depths that would turn denormal in any product are no depths; the bound is far below every scene's unit.
inline constexpr float nearest_depth = 1e-30f;

/// What is background besides infinities, NaN, 0 and what is negative. A value that the user names takes the place of
/// the rule for 1e10.
struct Background {
  float value = std::numeric_limits<float>::quiet_NaN();  ///< --background; NaN equals nothing
  float from = farthest_depth;                            ///< anything from here on
  float far_low = std::numeric_limits<float>::infinity(),
        far_high = -std::numeric_limits<float>::infinity();  ///< the far plane with its rounding; empty where not known
};

/// `value`: --background. `far`: the far plane, where it is known.
Background background_of(std::optional<float> value, std::optional<double> far);

/// Bitwise operators, so that a loop over it becomes vector instructions. NaN fails the first comparison.
inline bool is_surface(float depth, const Background& background) {
  const bool at_far = (depth >= background.far_low) & (depth <= background.far_high);
  return (depth >= nearest_depth) & (depth < background.from) & !at_far & (depth != background.value);
}

/// Planar depth: only the background and the sign change.
void clean_depth(Channel& depth, float sign, const Background& background);

}  // namespace gloam
