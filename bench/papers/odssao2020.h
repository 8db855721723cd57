#pragma once

#include "papers/paper.h"

namespace gloam::bench {

/// Its table and section 5 with the paper's figures beside ours, and what its mask misses.
Paper odssao2020();

}  // namespace gloam::bench
