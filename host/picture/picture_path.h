// Names of pictures.
#pragma once

#include <filesystem>
#include <string>

namespace gloam {

/// picture.png, or picture.left.png for one of several views.
std::filesystem::path picture_path(const std::string& path, const std::string& view, bool several);

}  // namespace gloam
