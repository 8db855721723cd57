#include "results/bound.h"

#include <algorithm>

namespace gloam::report {

std::optional<Bound> bound_of(const Pass& pass, const Peaks& peaks, double pixels, int lanes) {
  if (!pass.per_pixel || pass.per_pixel->instructions <= 0 || pass.ms.median <= 0) return {};
  const PassCount& count = *pass.per_pixel;
  if (!peaks.fma_gflops || !peaks.copy_gb_per_s || (count.looks_around && !peaks.gather_g_per_s)) return {};
  const double at_peak = pixels * 1e-6 / pass.ms.median;  // of the pass's time, for one per pixel at 10^9 a second
  const double instructions = lanes == 1 ? count.instructions : count.float_instructions;
  Bound bound{"instructions", std::min(instructions / (*peaks.fma_gflops / 2) * at_peak, 1.0)};
  const auto compare = [&](const char* name, double share) {
    if (share > bound.share && share <= 1) bound = {name, share};
  };
  compare("copies", count.bytes_of_planes / *peaks.copy_gb_per_s * at_peak);
  // Rows of lanes are read in single instructions, which are counted as such.
  if (count.looks_around) compare("reads", count.loads / *peaks.gather_g_per_s * at_peak);
  return bound;
}

}  // namespace gloam::report
