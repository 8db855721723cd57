// Fused multiply-adds and nothing else, in as many independent sums as hide their latency. Compiled after shared/lanes/load.h.
// -D FMA_STEPS: multiply-adds of each sum
#define STEP(sum) sum = fma(sum, factor, added);
#define SIX(a, b, c, d, e, f) STEP(a) STEP(b) STEP(c) STEP(d) STEP(e) STEP(f)

kernel void fma_peak(Frame frame, float scale, float offset, PLANE_OUT result) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  // Known only at run time, so that nothing is computed while compiling; sums stay finite, as scale is below 1.
  const real factor = (real)(scale), added = (real)(offset);
  real a = added, b = a + 1, c = a + 2, d = a + 3, e = a + 4, f = a + 5;
  real g = a + 6, h = a + 7, i = a + 8, j = a + 9, k = a + 10, l = a + 11;
  for (int step = 0; step < FMA_STEPS; ++step) {
    SIX(a, b, c, d, e, f)
    SIX(g, h, i, j, k, l)
  }
  store(a + b + c + d + e + f + g + h + i + j + k + l, result, here);
}
