// Planes of one component or of a colour, for kernels that treat all components alike: SOURCE_PLANES(source) gathers the plane
// `source`, or source_r, source_g and source_b.
// -D COMPONENTS: 1 (the default) or 3
#ifndef GLOAM_COMPONENTS_H
#define GLOAM_COMPONENTS_H

#include "shared/lanes/load.h"
#include "shared/lanes/math.h"

#ifndef COMPONENTS
#define COMPONENTS 1
#endif

typedef struct {
  global const float* planes[COMPONENTS];
} Sources;

typedef struct {
  global float* planes[COMPONENTS];
} Results;

#if COMPONENTS == 1
#define SOURCE_PLANES(name) \
  {                         \
    { name }                \
  }
#else
#define SOURCE_PLANES(name)          \
  {                                  \
    { name##_r, name##_g, name##_b } \
  }
#endif
#define RESULT_PLANES(name) SOURCE_PLANES(name)

// The result of background: open, or no light.
#if COMPONENTS == 1
#define NO_RESULT ((real)(1))
#else
#define NO_RESULT ((real)(0))
#endif

// Light is kept to what sums can hold.
static inline real source_at(Sources sources, int component, int i) {
  const real value = load(sources.planes[component], i);
#if COMPONENTS == 1
  return value;
#else
  return kept_radiance(value);
#endif
}

// The weighted mean of a component. One component is a share: open or visible, at most 1.
static inline real mean_of(real sum, real weights) {
#if COMPONENTS == 1
  return mean_up_to_one(sum, weights);
#else
  return quotient(sum, weights);
#endif
}

// The same value for all components.
static inline void store_all(real value, Results results, int here) {
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c) store(value, results.planes[c], here);
}

#endif
