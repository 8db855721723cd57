// The first sentence of `gloam info`: whether ambient occlusion can be computed of a frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/flags/options.h"
#include "gloam/radius.h"

namespace gloam::cli {

/// What `gloam info` has found out.
struct FoundOnFrame {
  std::vector<std::string> runs;  ///< techniques that can run
  std::string lacks;              ///< what the default technique of ambient occlusion lacks, in words
  std::string flags;              ///< those that say how the frame is read, as text
  std::string camera_from;        ///< "header", "json", "fit", "flag", "matrix", "default"; empty: there is none
  std::optional<double> radius;   ///< scene units; none where no surface is visible
};

/// "Ambient occlusion can be computed: from depth and normals, ..." with the command that does; or why not.
std::string verdict_on(const FrameFile& file, const FoundOnFrame& found);

/// What `gloam info` has found out of a frame of a shot.
struct FoundOnShotFrame {
  int frame = 0;
  std::string sources;  ///< what ambient occlusion would be computed from, in words; empty: it cannot be
  std::string lacks;    ///< what the frame lacks for it, in words
  std::string camera;   ///< "by the camera in its header"
};

/// The same for a shot. `command`: the one that computes it, in words.
std::string verdict_on_shot(const std::vector<FoundOnShotFrame>& frames, const std::string& command);

/// What a frame of a shot has and lacks for ambient occlusion.
FoundOnShotFrame found_on(int frame, const FrameFile& file, const std::string& camera_from);

/// The techniques that can run, a line for each kind.
std::string runs_in_words(const std::vector<std::string>& runs);

}  // namespace gloam::cli
