// "Stereo-consistent Screen Space Reflection" (Wu, Xu, Wang 2024), tables 2 and 3, the comparison at equal samples, the ablations
// and the failure cases.
#pragma once

#include "papers/paper.h"

namespace gloam::bench {

Paper wu2024();

}  // namespace gloam::bench
