// Results of hard cases as JSON: for `gloam stress --json`, and between its own processes.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "stress/case.h"

namespace gloam::stress {

using Json = nlohmann::ordered_json;

/// A number; infinity for null, as which JSON has it.
inline double number_of(const Json& value) { return value.is_null() ? INFINITY : value.get<double>(); }

/// Infinite numbers become null: JSON has no infinity.
Json document_of(const CaseResult& result);
CaseResult case_result_of(const Json& document);

/// All results of one run, and its conditions.
struct StressRun {
  std::string device, driver;
  std::vector<std::string> others;  ///< devices that results were compared with
  Extent extent = Extent::full;
  unsigned seed = 1;
  int frames = 0;  ///< random frames asked for; 0: as many as the extent has
  std::vector<CaseResult> results;
  std::vector<std::string> left;  ///< techniques not yet examined
};

/// `{"device", ..., "cases": [{"technique", "case", "worst", "bound", "held", "replay", ...}], "failed"}`: one entry of `cases`
/// per finding. `replay` is the command that repeats its trial. `left` lists the techniques not yet examined: none, unless the
/// run was interrupted.
Json document_of(const StressRun& run, const std::string& device_flag);

/// Number of findings beyond their bounds and of cases that ended early.
int failures(const StressRun& run);

/// The command that repeats one trial. `device_flag`: as given by the user; may be empty.
std::string replay_command(const StressRun& run, const std::string& technique, int number, int trial,
                           const std::string& device_flag);

}  // namespace gloam::stress
