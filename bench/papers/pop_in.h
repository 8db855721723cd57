// How much AO jumps when a camera goes past something.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/papers/study.h"

namespace gloam::bench {

/// A camera goes past the pillar in 60 steps: what is seen of the rib behind it comes and goes, and with it the AO of the
/// wall. States the largest and the mean change of AO, after its filter, from step to step at fixed points of the wall.
void pop_in(Study& study, const std::vector<std::pair<std::string, Asked>>& techniques);

}  // namespace gloam::bench
