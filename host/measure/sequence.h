// Techniques on the frames of a sequence: error, time and flicker of each setting.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gloam/flicker.h"
#include "measure/measurement.h"

namespace gloam::bench {

/// A frame of a sequence, with its truth and the pixels that errors are over.
struct MeasuredFrame {
  int number = 0;
  Frame frame;
  Image truth;
  Foreground foreground;
};

/// The frames to measure on, all of one size, in order.
struct MeasuredSequence {
  std::string name, scene_class;  ///< "gallery:walk" and "architecture", or a pattern and "own"
  std::string holds;              ///< text for messages about the planes of the first frame
  Radius radius;                  ///< of all frames
  std::vector<MeasuredFrame> frames;
  std::optional<double> truth_rays, truth_noise;  ///< fewest per pixel, and largest RMS
  std::vector<std::string> made, reused;          ///< files of a built-in shot
};

/// Where the surfaces of a view are, for flicker.
Surfaces surfaces_of_view(const Frame& frame, const View& view);

/// Moves a frame to the end of a sequence. Throws Error for a frame without a truth, and for one of another size or radius than the
/// first.
void add_frame(MeasuredSequence& sequence, int number, Subject subject);

/// One setting. Means are over the frames, which count alike.
struct SequenceRow {
  Variation variation;
  Series ms;                    ///< of the kernels, one per frame
  std::optional<double> ratio;  ///< to HBAO+ medium on the same frame: the median over the frames
  double rmse = 0, bias = 0, worst_rmse = 0, ssim = 0;
  std::optional<double> flip;
  int worst_frame = 0;
  FlickerSums flicker;  ///< of all pairs of frames
};

struct SequenceMeasurement {
  std::vector<SequenceRow> rows;
  std::vector<Skipped> skipped;
  std::vector<std::string> motions;    ///< how surfaces were found in the frame before, in words, each once
  std::optional<double> truth_change;  ///< from frame to frame, root of the mean square
  std::optional<double> comparable;    ///< share of the foreground that two frames in a row show
};

/// Each technique with its presets, and each of these accumulated over time where the technique can. Settings that the frames do not
/// allow are skipped and listed.
SequenceMeasurement measure_sequence(MeasuredSequence& sequence, const MeasureOptions& options, Device& device);

}  // namespace gloam::bench
