// The names of channels, layers and parts as text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gloam::channel_names {

std::vector<std::string> split(const std::string& text, char separator);

/// The inverse of `split` at '.'.
std::string join(const std::vector<std::string>& pieces);

/// Letters and digits in lower case, without the prefix that renderers put before every pass:
/// "FinalImageMovieRenderQueue_WorldDepth" and "World Depth" are both "worlddepth".
std::string canonical(std::string_view layer);

/// "depth_left", "left.depth" -> "depth".
std::string without_view(const std::string& name, const std::string& view);

}  // namespace gloam::channel_names
