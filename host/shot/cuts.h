// Cuts in a shot: frames before which the camera jumps.
#pragma once

#include <optional>
#include <vector>

#include "gloam/camera.h"
#include "sequence/sequence_files.h"

namespace gloam {

/// A frame's camera.
struct FramePose {
  int frame = 0;
  std::optional<Pose> pose;  ///< none: unknown
};

/// Numbers of the frames that begin after a cut: the camera moves or turns 5 times as far per frame as it usually does just before and just after,
/// and by more than `radius` scene units or 20 degrees. What leads to or from an unknown pose is none. `poses`: in the order of the frames.
std::vector<int> cuts_in(const std::vector<FramePose>& poses, double radius);

/// The cameras of a shot's first view, from headers and camera files; nothing is decoded. A frame that cannot be opened has none, and frames that
/// are held are left out.
std::vector<FramePose> poses_of(const SequenceFiles& shot);

}  // namespace gloam
