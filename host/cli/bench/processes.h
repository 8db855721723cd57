// gloam bench --processes N: times measured again in processes of their own, and joined.
#pragma once

#include <string>
#include <vector>

#include "cli/flags/options.h"

namespace gloam::cli {

/// Adds the rounds of another process's result to those of a result. Ratios, times and intervals are then of all rounds; `processes` of
/// each row says how many are of each.
void join_rounds(Json& document, const Json& other);

struct MoreProcesses {
  int processes = 2;                  ///< with this one
  std::vector<std::string> repeated;  ///< words of the command without what is measured
  std::filesystem::path folder;       ///< of the result, which is there
  int rounds = 9;
};

/// Measures the rows of folder/bench.json in further processes, and joins their rounds to `document`. Throws Error if one fails.
void measure_in_more_processes(const MoreProcesses& more, Json& document);

/// Flags that a further process has in its own form, or not.
const std::set<std::string>& not_of_further_processes();

}  // namespace gloam::cli
