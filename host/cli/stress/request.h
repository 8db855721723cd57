// The request of gloam stress.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/flags/options.h"
#include "stress/case.h"

namespace gloam::cli {

struct StressCommand : DeviceFlags {
  std::string technique, cases, against = "all", out, markdown;
  std::optional<int> trial, frames, seed, jobs;
  double patience = 600;  ///< seconds
  std::vector<std::string> from;
  bool quick = false, is_child = false, print = false;
  int chunks = 0;                     ///< 0: not divided
  std::vector<std::string> repeated;  ///< words for a chunk
  JsonFlag json;
};

/// What to examine, according to the flags.
struct StressRequest {
  std::vector<std::string> techniques;
  std::vector<int> cases;
  std::optional<int> trial;
  int frames = 0;
  unsigned seed = 1;
  stress::Extent extent = stress::Extent::full;
};

/// The techniques in "all", or "hbao+,gtao", each once. Throws UsageError.
std::vector<std::string> parse_techniques(const std::string& text);

/// The numbers of hard cases in "3" or "1,7", each once; all if the text is empty. Throws UsageError.
std::vector<int> parse_cases(const std::string& text, const std::string& flag);

/// Throws UsageError if flags do not go together.
StressRequest request_of(const StressCommand& flags);

}  // namespace gloam::cli
