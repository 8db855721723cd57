// "Stereo-consistent screen-space ambient occlusion" (Shi, Billeter, Eisemann 2022), tables 1 and 2 and figures 5, 7, 9
// and 10.
#pragma once

#include "papers/paper.h"

namespace gloam::bench {

Paper shi2022();

}  // namespace gloam::bench
