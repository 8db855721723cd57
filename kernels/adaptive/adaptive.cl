// Adaptive sampling: tiles in which the AO of a base pass varies, as in ASSAO (McLaren 2016) and CACAO (AMD 2020). Smooth tiles
// need few samples.
//
// important_tiles  `frame`: the tiles; `other`: the base pass
//   in : ao         of the base pass, 1 = open .. 0 = closed; 1 on background
//   out: important  1 where AO varies by least_range or more within a tile and one pixel of the base pass around it; else 0
// -D PIXELS (of the base pass, per tile and axis)
#include "shared/lanes/load.h"

// in : ao
// out: important
kernel void important_tiles(ARGUMENTS) {
  const integer first = (FIRST_X + IOTA) * PIXELS;
  real brightest = 0, darkest = 1;
  for (int dy = -1; dy <= PIXELS; ++dy) {
    const int row = index_of(other, 0, clamp(ROW_Y * PIXELS + dy, 0, other.height - 1));
    for (int dx = -1; dx <= PIXELS; ++dx) {
      const integer column = max(min(first + dx, (integer)(other.width - 1)), (integer)(0));
      const real found = gather(ao, row + column);
      brightest = larger(brightest, found);
      darkest = smaller(darkest, found);
    }
  }
  store(choose(brightest - darkest >= params.least_range, (real)(1), (real)(0)), important,
        index_of(frame, FIRST_X, ROW_Y));
}
