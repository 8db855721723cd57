// Doronin, Kara, Barsi, Martini 2017: screen-space ambient occlusion for light-field displays.
#pragma once

#include "papers/paper.h"

namespace gloam::bench {

Paper doronin2017();

}  // namespace gloam::bench
