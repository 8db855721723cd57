// The files that gloam run writes of a frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/run/command.h"
#include "cli/run/steps.h"
#include "cli/shot/shot.h"

namespace gloam::cli {

/// Paths for one frame; empty where one is not asked for.
struct FrameOutputs {
  std::string out, into, composite;
  bool composite_in_copy = false;  ///< --composite names the file of --into
  bool has_composite() const { return composite_in_copy || !composite.empty(); }
  /// With their flags, for `check_paths`.
  std::vector<NamedPath> named() const { return {{"-o", out}, {"--into", into}, {"--composite", composite}}; }
  /// Those asked for.
  std::vector<std::string> paths() const;
};

FrameOutputs outputs_of(const RunCommand& flags);

/// Throws UsageError if nothing is asked for, for names that are not of EXR files, for a copy of two files, and for flags of a file
/// that is not written.
void check(const FrameOutputs& outputs, const RunCommand& flags);

/// How a frame's files are written.
struct OutputSettings {
  WriteOptions out, copy;
  std::vector<std::string> copied;  ///< planes that a copy gets
  std::string composited;           ///< the plane of a composite; empty if there is none
  Compositing compositing;
  bool has_cameras = true;
};

/// `half`: AO of OUT.exr as half. `plan`: of the frame. Throws UsageError for a composite of planes that are not laid over colour.
OutputSettings output_settings(const RunCommand& flags, bool half, const PlanRequest& request, const Plan& plan);

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

/// Writes the files. Afterwards the result has only the planes of the copy, if one is asked for. Returns notes.
std::vector<std::string> write_outputs(const FrameOutputs& outputs, OutputSources& sources, Frame& result,
                                       const OutputSettings& settings);

/// The files of a shot's frames.
class ShotOutputs {
 public:
  /// Throws UsageError for names that are not patterns.
  ShotOutputs(const FrameOutputs& named, const std::string& shot);

  FrameOutputs of(int frame) const;
  /// Those asked for, with their flags.
  const NamedPatterns& patterns() const { return patterns_; }

 private:
  NamedPatterns patterns_;
  bool composite_in_copy_ = false;
};

}  // namespace gloam::cli
