// The result of a run on the frame before, for techniques that accumulate over a sequence.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gloam/exr.h"

namespace gloam {

/// A file written by `gloam run`, with `reflection` and `depth` of every view, and mostly `frames`.
class History {
 public:
  /// Throws as `FrameFile` does, and Error for a file that lacks one of the two planes.
  explicit History(const std::filesystem::path& path);

  /// The planes that it adds to a frame: `history`, `history_depth` and `history_frames`.
  static const std::vector<std::string>& planes();
  /// The planes of the file that these are made from: `reflection`, `depth`, `frames`.
  static const std::vector<std::string>& planes_of_file();

  const FrameFile& file() const { return file_; }

  /// Adds those of its planes that are asked for, and `camera_before`, to every view of a frame: from the view of the same name,
  /// or, if a name is missing, from the only view to the only view. A file without `frames` counts as one frame. Throws Error for
  /// an image of another window and for a view that the file lacks.
  void add_to(Frame& frame, const std::vector<std::string>& planes);

  /// Seed of the run's random numbers; none if the file does not state it.
  std::optional<int> seed() const;

 private:
  FrameFile file_;
};

}  // namespace gloam
