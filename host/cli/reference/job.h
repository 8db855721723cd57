// What gloam reference traces: the same for a frame alone and for each frame of a shot.
#pragma once

#include <optional>

#include "cli/reference/command.h"
#include "gloam/frame_files.h"
#include "gloam/radius.h"
#include "gloam/scene/reference.h"
#include "scene/scene_of_frame.h"

namespace gloam::cli {

/// A frame as it was read, its truth, and the radius if there is one.
struct TracedFrame {
  Frame frame;
  Reference truth;
  std::optional<Radius> radius;
};

/// Reads a frame of one file and traces its truth. The radius of `options` becomes the frame's. Throws Error for a frame without
/// depth or more memory than there is.
TracedFrame trace_frame(const ReferenceCommand& flags, const ReferenceJob& job, FrameFiles& file, SceneOfFrame& scene,
                        ReferenceOptions options);

/// From so large a share of unlike pixels (`Reference::unlike_share`) on, a note says so.
inline constexpr double most_unlike = 0.005;

/// One truth per frame. A scene that stays the same is prepared once. An error of one frame is told, and the others go on.
void reference_on_shot(const ReferenceCommand& flags, const ReferenceJob& job);

/// The traced plane of each view as a picture; does nothing for an empty name.
void write_pictures(const std::string& picture, const ReferenceJob& job, const TracedFrame& traced);

}  // namespace gloam::cli
