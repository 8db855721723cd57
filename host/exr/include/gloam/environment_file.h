// Light from far away, read from a file.
#pragma once

#include <filesystem>

#include "gloam/environment_map.h"

namespace gloam {

/// Reads the colour (R, G, B) of an EXR file. Throws Error for a file without colour, for one that is no lat-long map (neither twice
/// as wide as high nor said to be one by its attribute `envmap`), and as the map itself does.
EnvironmentMap read_environment(const std::filesystem::path& path, EnvironmentAxes axes = EnvironmentAxes::openexr,
                                double turn_degrees = 0);

}  // namespace gloam
