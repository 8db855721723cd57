// A slice as one eye sees it. Include it after the type Side of one side of a slice.
#ifndef GLOAM_SLICE_VIEW_H
#define GLOAM_SLICE_VIEW_H

#include "shared/sampling/slice_steps.h"

// Each eye measures its samples in a slice of its own, drawn from the same even angle about its own line to the point. Moved into
// the other eye's slice they would lie beside it, and the eyes would agree less.
typedef struct {
  Slice slice;
  real importance;  // inverse density * weight
  Side right, left;
} View;

#endif
