// Jumps of AO while a camera moves past an object.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "papers/study.h"

namespace gloam::bench {

/// A camera moves past the pillar in 60 steps: visible parts of the rib behind it come and go, and with them the AO of the wall.
/// States the largest and the mean change of filtered AO from step to step, at fixed points of the wall.
void pop_in(Study& study, const std::vector<std::pair<std::string, Asked>>& techniques);

}  // namespace gloam::bench
