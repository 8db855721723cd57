// The roofline: what a pass computes and reads by count, and what the device can do at most.
#pragma once

#include <optional>
#include <string>

#include "results/measurements.h"

namespace gloam::bench {

using report::PassCount;

/// Empty for a pass, a preset or a technique that was not counted.
std::optional<PassCount> count_of(const std::string& technique, const std::string& preset, const std::string& pass);

}  // namespace gloam::bench
