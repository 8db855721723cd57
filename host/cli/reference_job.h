// What gloam reference traces, from the command line: the same for a frame alone and for each frame of a shot.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/reference_command.h"
#include "cli/scene_of_frame.h"
#include "gloam/frame_files.h"
#include "gloam/radius.h"
#include "gloam/scene/reference.h"

namespace gloam::cli {

/// What differs from frame to frame.
struct TracingOfFrame {
  uint32_t seed = 0;
  std::string checkpoint;
  std::function<void(double share_done)> progress;
};

struct ReferenceJob {
  std::string plane;
  std::vector<std::string> reads;
  Json settings;        ///< for --json
  std::string heading;  ///< "falloff none"
  bool has_radius = false, needs_finite_radius = false;
  std::function<Reference(const Tracer&, const Frame&, double radius, const TracingOfFrame&)> trace;
};

/// "ao" and "reflection".
const std::vector<std::string>& reference_kinds();

/// Throws UsageError for flags that the kind of truth has no use for. Takes the settings of techniques out of those of the scene.
ReferenceJob job_of(ReferenceCommand& flags);

/// A frame as it was read, its truth, and the radius if there is one.
struct TracedFrame {
  Frame frame;
  Reference truth;
  std::optional<Radius> radius;
};

/// Reads a frame of one file and traces its truth. Throws Error for a frame without depth or more memory than there is.
TracedFrame trace_frame(const ReferenceCommand& flags, const ReferenceJob& job, FrameFiles& file, SceneOfFrame& scene,
                        const TracingOfFrame& tracing);

}  // namespace gloam::cli
