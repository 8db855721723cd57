// Searches both sides of a slice. Include it after the types Search, with a Receiver `receiver`, and Side, with a SliceSample
// `sample`, and the function
//   void look(Frame, Params, DepthLayers, Search, int here, integer place, mask in_frame, mask is_shared, Side*)
// which takes all that layers show at an index from `here`.
#ifndef GLOAM_SLICE_SEARCH_H
#define GLOAM_SLICE_SEARCH_H

#include "shared/sampling/slice_steps.h"

static inline __attribute__((always_inline)) void search_slice(Frame frame, Params params, DepthLayers layers,
                                                               Search search, Slice slice, int within, Side* right,
                                                               Side* left) {
  const Receiver r = search.receiver;
  for (int k = 0; k < STEPS; ++k) {
    samples_of_step(frame, params.bias, r, slice, within, k, &right->sample, &left->sample);
    look(frame, params, layers, search, r.here, right->sample.place, right->sample.in_frame, (mask)(0), right);
    look(frame, params, layers, search, r.here, left->sample.place, left->sample.in_frame, (mask)(0), left);
  }
}

#endif
