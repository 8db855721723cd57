// Pictures of the measured images, for the report.
#pragma once

#include <filesystem>
#include <string>

#include "gloam/frame.h"

namespace gloam::bench {

/// A name that is safe in files and addresses: letters, digits, '.', '_' and '-' stay, '+' becomes "plus", any run of other
/// characters one '-'.
std::string file_name(const std::string& name);

/// The mean of a plane's components as an 8-bit PNG of grey and alpha, background transparent: `white` is drawn as white. Throws Error
/// naming `path`.
void write_grey(const std::filesystem::path& path, const Plane& plane, const Channel& depth, double white);

/// The value to draw as white: 1 for shares; of light what 99 of 100 surfaces are below, so that a lamp does not make the rest black.
double white_of(const Plane& plane, const Channel& depth);

}  // namespace gloam::bench
