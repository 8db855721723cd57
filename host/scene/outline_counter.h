// How many outlines the rays of a view are in where they meet what is visible.
#pragma once

#include <optional>

#include "gloam/scene/capture.h"
#include "scene/capture_target.h"

namespace gloam {

/// Counts the outlines that one view's rays are in where they meet what is visible.
class OutlineCounter {
 public:
  OutlineCounter(const Outlines* outlines, const Camera& camera, const CaptureTarget& target);

  /// Once the row has its depths.
  void row(int y) const;

 private:
  const Outlines* outlines_;
  const Camera& camera_;
  const CaptureTarget& target_;
  std::optional<int> at_eye_;
};

}  // namespace gloam
