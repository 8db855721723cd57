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
  std::string camera_from;        ///< "header", "json", "fit", "flag"; empty: there is none
  std::optional<double> radius;   ///< scene units; none where no surface is visible
};

/// "Ambient occlusion can be computed: from depth and normals, ..." with the command that does; or why not.
std::string verdict_on(const FrameFile& file, const FoundOnFrame& found);

/// The techniques that can run, a line for each kind.
std::string runs_in_words(const std::vector<std::string>& runs);

}  // namespace gloam::cli
