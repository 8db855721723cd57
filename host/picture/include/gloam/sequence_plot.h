// The plot of `gloam compare` on a sequence: figures over time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gloam {

/// A figure over the frames of a sequence: a value for each frame, none where there is none. Lines have gaps there.
struct SequenceCurve {
  std::string name;
  std::vector<std::optional<double>> values;
};

/// Curves over one axis of values, which begins at 0. At most four curves, none negative.
struct SequenceChart {
  std::string title;
  std::vector<SequenceCurve> curves;
};

/// Charts below one another, over one axis of frames. A chart without any value is left out.
struct SequencePlot {
  std::string title, facts;
  std::vector<int> frames;  ///< numbers, ascending
  std::vector<SequenceChart> charts;
  std::optional<int> worst;  ///< number of a frame that is marked
};

/// PNG, written atomically. Throws Error naming `path` if it cannot be written, and for a curve that has not a value for each frame.
void write_sequence_plot(const std::filesystem::path& path, const SequencePlot& plot);

}  // namespace gloam
