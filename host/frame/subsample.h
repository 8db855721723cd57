// A small frame of few of a frame's pixels.
#pragma once

#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

/// Every `scale`-th pixel of every `scale`-th row, beginning with the first, of these planes; a plane that a view lacks is left out. Pixel
/// (x, y) is the frame's pixel (x, y) * scale, and cameras fit that, as with `Pass::scale`.
Frame every_nth_pixel(const Frame& frame, int scale, const std::vector<std::string>& planes);

}  // namespace gloam
