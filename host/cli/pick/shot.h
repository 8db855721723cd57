// gloam pick on a shot: what accuracy costs in time and in calm.
#pragma once

#include <functional>
#include <string>

#include "choose/pick.h"
#include "cli/bench/sequence.h"

namespace gloam::cli {

/// Measures all presets of the techniques on the frames, each alone and over time, and prints the most accurate (or the calmest) within
/// the budget, or the cheapest within the error. `run_line`: the command for a setting. Throws Error that names the nearest miss if
/// nothing is within the bound.
void pick_on_shot(const SequenceBenchFlags& flags, const bench::PickOptions& options, const bench::SceneOptions& scene,
                  const std::vector<bench::Skipped>& skipped, Device& device, const JsonFlag& json,
                  const std::function<std::string(const bench::Variation&)>& run_line);

}  // namespace gloam::cli
