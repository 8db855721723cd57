// The frames of a shot beside their truths: figures of each, and how the error changes from frame to frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "comparison/shot_files.h"

namespace gloam::comparison {

/// Figures of one frame.
struct FrameFigures {
  int number = 0;
  Metrics figures;             ///< of all views
  std::vector<Metrics> views;  ///< in the order of the views
  double exposure = 0;         ///< of radiance, before SSIM, GMSD and FLIP; 0: none
  std::optional<FlickerSums>
      pair;  ///< with the frame before; none after a gap, since motion is from one frame to the next
};

/// Figures of a shot.
struct ShotFigures {
  PlanePair planes;
  ViewPairs views;
  std::vector<FrameFigures> frames;
  FlickerSums sums;  ///< of all pairs of frames that follow one another
  size_t pairs = 0;
  std::string motion;  ///< where motion is from, in words: "plane (of the test)"
  double range = 0;    ///< of differences, at the ends of a picture's colours; 0 where no pictures are drawn

  /// The frame with the largest RMSE.
  const FrameFigures& worst() const;
  /// Means over the frames, which count alike; `max` is the largest, and `psnr` that of the mean squared error.
  Metrics means() const;
  /// Sums over all pairs; none without a pair.
  std::optional<FlickerSums> all_pairs() const { return pairs > 0 ? std::optional(sums) : std::nullopt; }
};

/// Compares every frame. `pictures`: of each frame's differences, all in one scale; a pattern, or empty for none. Appends to `notes` what is
/// assumed, and what cannot be measured. Throws Error for frames that are unlike the first one.
ShotFigures compare_shot(const ComparedShot& shot, const std::string& pictures, const FrameProgress& progress,
                         std::vector<std::string>& notes);

}  // namespace gloam::comparison
