// The best setting for a shot: what accuracy costs in time and in calm.
#pragma once

#include <vector>

#include "measure/contest.h"
#include "measure/sequence.h"

namespace gloam::bench {

/// Sorts settings that were measured on a shot, the best first: those within the bound before others, and of these the nearest to it. Throws
/// Error that names the nearest miss if none is within the bound.
void rank(std::vector<SequenceRow>& rows, const PickOptions& options);

}  // namespace gloam::bench
