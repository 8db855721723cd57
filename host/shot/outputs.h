// The files that are written of a frame: its result, a copy of its file with the result, a composite.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gloam/composite.h"
#include "gloam/frame_pattern.h"
#include "shot/planned_frame.h"

namespace gloam {

/// Paths for one frame; empty where one is not asked for.
struct FrameOutputs {
  std::string out, into, composite;
  bool composite_in_copy = false;  ///< the composite goes into the copy
  bool has_composite() const { return composite_in_copy || !composite.empty(); }
};

/// The same for the frames of a shot.
struct ShotOutputs {
  std::optional<FramePattern> out, into, composite;
  bool composite_in_copy = false;
  bool has_composite() const { return composite_in_copy || composite; }
  FrameOutputs of(int frame) const;
};

/// How a frame's files are written.
struct OutputSettings {
  WriteOptions out, copy;
  std::vector<std::string> copied;  ///< planes that a copy gets
  std::string composited;           ///< the plane of a composite; empty if there is none
  Compositing compositing;
  bool has_cameras = true;
  bool names_frame = false;  ///< OUT.exr; only where the frame was read without flags that change its depth
};

/// The planes asked for, else what a shot's file holds: the first output, with the extras.
std::vector<std::string> planes_of_file(const PlanRequest& request, const Plan& plan);

/// What a frame's files are made of besides its result.
struct OutputSources {
  std::string file;  ///< that the frame was read from; of two, the first
  /// For a composite.
  Frame colour;
  std::vector<std::string> half_planes;
  int part = 0;
  std::string holds;               ///< what colour holds, as the file states it; empty: it does not
  std::vector<std::string> notes;  ///< on values that are no light
};

/// Reads the colour, if a composite is asked for.
OutputSources read_sources(PlannedFrame& planned);

/// The frame's file as a path from the folder of `out`.
std::string frame_seen_from(const std::string& frame, const std::string& out);
/// Leaves the name and the size of the frame's file in a result that is written to `out` (`gloamFrame`, `gloamFrameBytes`): `compare` asks the
/// frame for the background.
void name_frame(Frame& result, const std::string& frame, const std::string& out);

/// Writes the files. Afterwards the result has only the planes of the copy, if one is asked for. Returns notes.
std::vector<std::string> write_outputs(const FrameOutputs& outputs, OutputSources& sources, Frame& result,
                                       const OutputSettings& settings);

}  // namespace gloam
