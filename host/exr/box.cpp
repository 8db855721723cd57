#include "exr/box.h"

#include <algorithm>

namespace gloam {

Box box_of(const Imath::Box2i& box) { return {box.min.x, box.min.y, int64_t(box.max.x) + 1, int64_t(box.max.y) + 1}; }

Box box_of(const Window& window) { return {window.x0, window.y0, window.x1, window.y1}; }

Box united(const Box& a, const Box& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

Window window_of(const Box& box) { return {int(box.x0), int(box.y0), int(box.x1), int(box.y1)}; }

}  // namespace gloam
