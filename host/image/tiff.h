// TIFF, by libtiff.
#pragma once

#include <string>

#include "image/image_values.h"

namespace gloam {

/// Whole numbers of 8, 16 and 32 bits, floats of 16, 32 and 64; strips or tiles; the first image of a file. Throws Error, one line beginning
/// with `name`.
ImageValues image_of_tiff(const std::string& bytes, const std::string& name, long long most_pixels);

}  // namespace gloam
