// Times measured again in processes of their own, and joined: two processes of one build differ.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "results/measurements.h"

namespace gloam::bench {

struct MoreProcesses {
  int processes = 2;                  ///< with this one
  std::vector<std::string> repeated;  ///< words of the command without what is measured
  std::filesystem::path folder;       ///< of the result, which is there
  int rounds = 9;
  std::function<void(const std::string& what, double share_done)> progress;
};

/// Measures the rows of folder/bench.json in further processes, and joins their rounds to `results`. Ratios, times and intervals are then of all
/// rounds; `Row::processes` says how many are of each. Throws Error if one fails.
void measure_in_more_processes(const MoreProcesses& more, report::Measurements& results);

}  // namespace gloam::bench
