// Work on every row of an image, on all cores.
#pragma once

#include <cstddef>

#include "gloam/frame.h"

namespace gloam {

/// Calls `body(y)` for every row, on all cores unless the image is too small to be worth it. Threads take a few rows at a time, so that one
/// that waits for its core does not make the others wait for half the image.
template <typename Body>
void for_each_row(const Layout& layout, const Body& body) {
#pragma omp parallel for schedule(dynamic, 16) if (size_t(layout.width) * size_t(layout.height) > 65536)
  for (int y = 0; y < layout.height; ++y) body(y);
}

}  // namespace gloam
