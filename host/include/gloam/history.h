// What a run left behind for the frame before, for techniques that accumulate over a sequence.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gloam/exr.h"

namespace gloam {

/// A file that `gloam run` wrote, with `reflection` and `depth` of every view, and mostly `frames`.
class History {
 public:
  /// Throws what `FrameFile` throws, and Error for a file that lacks one of the two planes.
  explicit History(const std::filesystem::path& path);

  /// What it adds to a frame: `history`, `history_depth` and `history_frames`.
  static const std::vector<std::string>& planes();
  /// What of the file these are made of: `reflection`, `depth`, `frames`.
  static const std::vector<std::string>& planes_of_file();

  const FrameFile& file() const { return file_; }

  /// Adds those of its planes that are asked for to every view of a frame: from the view of the same name, or from the only
  /// one to the only one where one of them has no name; and the view's `camera_before`. Where the file does not say of how many
  /// frames it is made, it is one.
  /// Throws Error for an image of another window and a view that the file lacks.
  void add_to(Frame& frame, const std::vector<std::string>& planes);

  /// Of the run's random numbers; none where the file does not say.
  std::optional<int> seed() const;

 private:
  FrameFile file_;
};

}  // namespace gloam
