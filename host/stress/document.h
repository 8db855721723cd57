// Results of hard cases as JSON: what `gloam stress --json` writes, and what its own processes tell each other.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "stress/case.h"

namespace gloam::stress {

using Json = nlohmann::ordered_json;

/// Infinite numbers are null, which JSON has for them.
Json document_of(const CaseResult& result);
CaseResult case_result_of(const Json& document);

/// Everything that was examined in one run, and with what.
struct StressRun {
  std::string device, driver;
  std::vector<std::string> others;  ///< devices that it was compared with
  Extent extent = Extent::full;
  unsigned seed = 1;
  int frames = 0;  ///< random ones asked for; 0: as many as the extent has
  std::vector<CaseResult> results;
  std::vector<std::string> left;  ///< techniques that are still to come
};

/// `{"device", ..., "cases": [{"technique", "case", "worst", "bound", "held", "replay", ...}], "failed"}`: one entry of `cases`
/// for each finding. `replay` is the command that makes its trial again. `left` are the techniques that had not had their turn
/// when it was written: none, but for a run that was interrupted.
Json document_of(const StressRun& run, const std::string& device_flag);

/// Findings beyond their bounds, and cases that broke off.
int failures(const StressRun& run);

/// The command that makes one trial again. `device_flag`: as it was given, empty where it was not.
std::string replay_command(const StressRun& run, const std::string& technique, int number, int trial,
                           const std::string& device_flag);

}  // namespace gloam::stress
