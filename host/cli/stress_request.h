// What gloam stress is asked to examine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/options.h"
#include "stress/case.h"

namespace gloam::cli {

struct StressCommand {
  std::string technique, cases, trial, frames, seed, device, against = "all", jobs, patience = "600", out, markdown;
  std::vector<std::string> from;
  bool quick = false, is_child = false;
  JsonFlag json;
};

/// What is examined, as the flags have it.
struct StressRequest {
  std::vector<std::string> techniques;
  std::vector<int> cases;
  std::optional<int> trial;
  int frames = 0;
  unsigned seed = 1;
  stress::Extent extent = stress::Extent::full;
};

/// Throws UsageError where the flags do not go together.
StressRequest request_of(const StressCommand& flags);

}  // namespace gloam::cli
