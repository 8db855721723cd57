// Windows of EXR headers, in numbers that do not overflow.
#pragma once

#include <Imath/ImathBox.h>

#include <cstdint>

#include "gloam/frame.h"

namespace gloam {

/// A window in 64 bits, so that a damaged one cannot overflow. x1 and y1 are exclusive.
struct Box {
  int64_t x0, y0, x1, y1;
  bool empty() const { return x1 <= x0 || y1 <= y0; }
  bool larger_than(int64_t pixels) const {
    return x1 - x0 > pixels || y1 - y0 > pixels || (x1 - x0) * (y1 - y0) > pixels;
  }
};

Box box_of(const Imath::Box2i& box);
Box box_of(const Window& window);
Box united(const Box& a, const Box& b);
Window window_of(const Box& box);

}  // namespace gloam
