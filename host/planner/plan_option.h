// A way to compute an effect: its technique, with those that complete it, a preset and a resolution.
#pragma once

#include <string>
#include <vector>

#include "gloam/plan.h"

namespace gloam {

struct PlanOption {
  PlanRequest request;   ///< its first output is the technique; others complete the effect
  bool is_seen = false;  ///< a look has computed it on few pixels: only the others are filled in

  /// "evidence + multi-bounce, medium, half": names its time and its error.
  std::string label() const;
  /// "medium, half"; "default, full" without a preset; "medium, full, temporal" where it goes on from frame to frame;
  /// "low, quarter, from the look" where a look has computed it.
  std::string setting() const;
};

}  // namespace gloam
