// The best setting for a shot: what accuracy costs in time and in calm.
#pragma once

#include <string>
#include <vector>

#include "measure/contest.h"
#include "measure/sequence.h"

namespace gloam::bench {

/// Sorts settings that were measured on a shot, the best first, and says why that is the best. Throws Error that names the nearest miss if none
/// is within the bound.
std::string rank(std::vector<SequenceRow>& rows, const PickOptions& options);

}  // namespace gloam::bench
