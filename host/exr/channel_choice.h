// The channels that the user chooses for a plane: --plane PLANE=CHANNELS.
#pragma once

#include <string>
#include <vector>

#include "exr/channel_layers.h"
#include "gloam/planes.h"

namespace gloam::channel_names {

/// The word in place of channels that hides a plane of the file.
inline constexpr const char* left_out = "none";

/// Throws UsageError if no plane has the name.
void check_plane_name(const std::string& plane);

/// The channels that the user named for a plane, in one view; empty if the view has no such channel.
/// Throws Error for a layer, or a number of channels, that does not fit the plane.
std::vector<const FileChannel*> chosen(const std::vector<Layer>& layers, const std::vector<Entry>& entries,
                                       const PlaneKind& kind, const std::string& view, const std::string& text);

/// Throws Error for names that no view has, and says which of them is unknown.
[[noreturn]] void no_such_channel(const std::vector<Entry>& entries, const std::string& plane, const std::string& text);

}  // namespace gloam::channel_names
