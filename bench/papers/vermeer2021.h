// "Stochastic-Depth Ambient Occlusion" (Vermeer, Scandolo, Eisemann 2021), tables 1 to 3 and figures 3 to 9.
#pragma once

#include "papers/paper.h"

namespace gloam::bench {

Paper vermeer2021();

}  // namespace gloam::bench
