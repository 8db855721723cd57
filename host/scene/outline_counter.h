// Counts the outlines that contain the visible surfaces of a view.
#pragma once

#include <optional>

#include "gloam/scene/capture.h"
#include "scene/capture_target.h"

namespace gloam {

/// Counts the outlines that contain the visible surfaces of one view.
class OutlineCounter {
 public:
  OutlineCounter(const Outlines* outlines, const Camera& camera, const CaptureTarget& target);

  /// Counts for a row whose depths are filled.
  void row(int y) const;

 private:
  const Outlines* outlines_;
  const Camera& camera_;
  const CaptureTarget& target_;
  std::optional<int> at_eye_;
};

}  // namespace gloam
