// gloam reference on the frames of a shot.
#pragma once

#include "cli/reference/job.h"

namespace gloam::cli {

/// From so large a share of unlike pixels (`Reference::unlike_share`) on, a note says so.
inline constexpr double most_unlike = 0.005;

/// One truth per frame. A scene that stays the same is prepared once. An error of one frame is told, and the others go on.
void reference_on_shot(const ReferenceCommand& flags, const ReferenceJob& job);

/// The traced plane of each view as a picture; does nothing for an empty name.
void write_pictures(const std::string& picture, const ReferenceJob& job, const TracedFrame& traced);

}  // namespace gloam::cli
