// The result of a run on the frame before, for techniques that accumulate over a sequence.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gloam/exr.h"

namespace gloam {

/// The planes that a history adds to a frame: `history` (of a reflection), `history_ao` (of raw AO) or `history_indirect` (of raw
/// indirect light), `history_depth` and `history_frames`.
const std::vector<std::string>& history_planes();
bool is_of_history(const std::string& plane);
/// Whether one of the planes is of a history.
bool has_history(const std::vector<std::string>& planes);

/// Adds those of its planes that are asked for, and `camera_before`, to every view of a frame: from the view of the same name of the
/// frame before, or, if a name is missing, from the only view to the only view. A frame without `frames` counts as one frame.
/// Where the frame before has some of the views, those that it lacks know nothing, as do pixels outside its window. `name`: of the frame
/// before, for messages. Throws Error for an image of another size, and if it has none of the views.
void add_history(Frame& frame, Frame before, const std::vector<std::string>& planes, const std::string& name);

/// Adds the same planes to a frame that begins a sequence: they know nothing.
void add_no_history(Frame& frame, const std::vector<std::string>& planes);

/// Whether a frame with a history can tell where its surfaces were: by a plane `motion`, or by two poses of the camera.
bool knows_where_surfaces_were(const Frame& frame);

/// Whether a result shows what the frame before showed: 5 % or more of its surfaces are means over more than one frame. Less is chance.
bool goes_on_from_before(const Frame& result);

/// The planes of a result from which a history is made, of those that it has: `reflection`, `ao_raw`, `indirect_raw`, `depth`,
/// `frames`.
const std::vector<std::string>& planes_for_history();

/// A file written by `gloam run`, with `depth` and `ao_raw`, `indirect_raw` or `reflection` of every view, and mostly `frames`.
class History {
 public:
  /// Throws as `FrameFile` does, and Error for a file without a result to go on from, or without depth.
  explicit History(const std::filesystem::path& path);

  /// Those of `history_planes` that it can add.
  std::vector<std::string> planes() const;
  /// The planes of the file that these are made from.
  std::vector<std::string> planes_of_file() const;

  const FrameFile& file() const { return file_; }

  /// As `add_history`.
  void add_to(Frame& frame, const std::vector<std::string>& planes);

  /// Seed of the run's random numbers; none if the file does not state it.
  std::optional<int> seed() const;

 private:
  FrameFile file_;
};

}  // namespace gloam
