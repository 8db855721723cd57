// Techniques with one fault each, to test the hard cases: a fault that they miss here, they would miss anywhere.
//
// in : depth    view-space z, scene units, +inf = background
//      normal   unit or zero, view space
// out: ao       1 open .. 0 closed
// -D FAULT: its number in technique.cpp
#include "shared/frame/camera.h"

// in : depth, normal
// out: ao
kernel void faults(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real z = load(depth, here);
  const mask background = is_background(z);
  real open = (real)(1);
#if FAULT == 1  // has an epsilon of its own, in scene units
  open = choose(background, open, (real)(1) - (real)(0.01f) / (z + (real)(0.02f)));
#elif FAULT == 2   // ignores background
  open = z / (z + (real)(1));
#elif FAULT == 3   // depends on the width of a row of lanes
  open = choose(background, open, (real)(1) - (real)(0.001f * LANES));
#elif FAULT == 4   // reads beyond the border of the image
  open = choose(load(depth, here + 1) < z, (real)(0), open);
#elif FAULT == 5   // shadows itself
  open = choose(background, open, fabs(load(normal_z, here)));
#elif FAULT == 6   // samples only to the left, and not beyond the border
  const real left = load(depth, here - 1);
  open = choose(to_mask(FIRST_X + IOTA > 0) & (left < z), left / z, open);
#elif FAULT == 7   // reads where there is no data
  open = ((global const float*)8)[ROW_Y];
#elif FAULT == 8   // does not end
  volatile int more = 1;
  while (more) open += (real)(1);
#elif FAULT == 9   // treats every camera as one of 80 columns over 60 degrees
  const real next = load(depth, here + 1), x = to_real(FIRST_X + IOTA) - (real)(39.5f);
  const real aside = ((x + 1) * next - x * z) / (real)(69.282f);
  const real height = load(normal_x, here) * aside - load(normal_z, here) * (next - z);
  open = choose(background | is_background(next) | (height < (real)(0.01f) * z), open, (real)(0));
#elif FAULT == 10  // squares a value that may be large
  open = choose(background, open, z * z / ((real)(1) + z * z));
#elif FAULT == 11  // treats nearer surfaces as light
  open = choose(load(depth, here + 1) < z * (real)(0.9f), open, (real)(0.5f));
#endif
  store(open, ao, here);
}
