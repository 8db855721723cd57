// Picture files as textures: PNG, JPEG, TGA, BMP, PSD, GIF, HDR, PNM.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "gloam/scene/scene.h"

namespace gloam {

/// Throws Error with only the reason ("unknown image type"); the caller adds the picture's name.
Texture decode_image(const std::string& name, const uint8_t* bytes, size_t size);
/// As above, from a file.
Texture read_image(const std::filesystem::path& path);

}  // namespace gloam
