// Pictures of floats in formats that take few lines to read. OpenCV reads them too, by a library that takes 85 ms to
// load, where a command starts in 14.
#pragma once

#include <string>

#include "image/image_values.h"

namespace gloam {

/// Portable float map: one component ("Pf") or three ("PF"), rows from the bottom up (http://www.pauldebevec.com/Research/HDR/PFM/). Throws
/// Error, one line beginning with `name`.
ImageValues image_of_pfm(const std::string& bytes, const std::string& name, long long most_pixels);

/// Radiance's pictures of shared exponents, plain or run-length encoded, rows from the top (Ward, "Real Pixels", Graphics Gems II, 1991).
/// Throws Error, one line beginning with `name`.
ImageValues image_of_hdr(const std::string& bytes, const std::string& name, long long most_pixels);

}  // namespace gloam
