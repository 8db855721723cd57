#include "shared/sampling/ambient_occlusion.h"

// Of the polynomial in evidence.cl.
#define EVIDENCE_TERMS 12

#define EVIDENCE_PARAMS(P)                                                                          \
  REACH_PARAMS(P)                                                                                   \
  P(int, directions, 1, 1, 64, "", "slices searched per pixel")                                     \
  P(float, bias, 0.01f, 0, 1, "", "slope above the tangent below which an occluder does not count") \
  P(int, steps, 9, 1, 64, "", "samples on each side of a slice")                                    \
  P(int, term, 0, 0, 12, "", "0: all terms with their coefficients; else this one alone, which `bench_fit` fits")

PARAMS(EvidenceParams, EVIDENCE_PARAMS)
