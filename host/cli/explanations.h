// What gloam auto has found, for its picture.
#pragma once

#include <string>
#include <vector>

#include "cli/auto_frame.h"
#include "gloam/explanation.h"

namespace gloam::cli {

/// "everywhere", "34 %", "-"
std::string where(const EffectChoice& choice);

/// The effects and their refinements, on one view. Points to planes of `outcomes`.
std::vector<Explanation> explanations_of(const std::vector<Outcome>& outcomes, const std::string& view);

/// The line below the table: the time of all effects.
std::string totals_of(const std::vector<Outcome>& outcomes);

}  // namespace gloam::cli
