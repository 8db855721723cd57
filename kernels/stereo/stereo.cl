// Passes for two eyes as techniques of their own (Shi, Billeter, Eisemann 2022): which pixels both eyes see (section 3.1), and the
// filter over both eyes (section 3.3; shared/stereo/filter.h).
//
// in : depth, other_depth  view-space z of either eye, scene units, +inf = background
// out: seen_by_both        1 where both eyes see the surface, else 0
#include "shared/stereo/visibility.h"

#ifdef COLUMNS
#include "shared/stereo/filter.h"
#else
// in : depth, other_depth
// out: seen_by_both
kernel void stereo_seen_by_both(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const mask is_seen = seen_by_both_eyes(frame, neighbour, params.back_check, load(depth, here), other_depth);
  store(choose(is_seen, (real)(1), (real)(0)), seen_by_both, here);
}
#endif
