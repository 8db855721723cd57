// What gloam auto has found, for its picture.
#pragma once

#include <string>
#include <vector>

#include "gloam/auto.h"
#include "gloam/explanation.h"

namespace gloam::cli {

/// The effects and their refinements, on one view. Points to planes of `outcomes`.
std::vector<Explanation> explanations_of(const std::vector<Outcome>& outcomes, const std::string& view);

}  // namespace gloam::cli
