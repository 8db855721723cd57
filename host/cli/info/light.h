// What gloam info tells of a frame's light and masks.
#pragma once

#include <string>
#include <vector>

#include "exr/cryptomatte.h"
#include "gloam/exr.h"

namespace gloam::cli {

/// A line on the planes of light that a composite leaves as they are, and one on the light that it darkens alone; none without such planes.
std::vector<std::string> light_in_words(const FrameFile& file);

/// A line for each.
std::vector<std::string> lines_on(const std::vector<Cryptomatte>& cryptomattes);
std::vector<std::string> names_of(const std::vector<Cryptomatte>& cryptomattes);
std::vector<std::string> without_channels_of(const std::vector<Cryptomatte>& cryptomattes,
                                             std::vector<std::string> channels);

}  // namespace gloam::cli
