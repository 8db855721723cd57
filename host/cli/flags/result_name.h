// The name of a result that the user gave none.
#pragma once

#include <string>

#include "cli/flags/frame_flags.h"

namespace gloam::cli {

/// Attribute of a result that lies beside its frame since nobody named it: the frame, as `frame_seen_from` the result.
inline constexpr const char* named_by_gloam = "gloamNamed";

/// frame_ao.exr beside frame.exr, for the result `what` of `command`. Throws UsageError for what has no such place, and Error if a file of
/// that name would be lost.
std::string name_beside(const FrameArguments& frame, const std::string& command, const std::string& what);

}  // namespace gloam::cli
