// Flags that say which technique runs, with which parameters, where, and how.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "gloam/plan.h"
#include "gloam/run.h"

namespace gloam::cli {

/// Which techniques, and with which parameters.
struct TechniqueFlags {
  std::vector<std::string> settings;
  std::string preset, then, with, resolution = "full", adaptive, only, elsewhere;
  /// `with_mask`: --only and --elsewhere too.
  void add_to(CLI::App& app, bool with_mask = true);
  PlanRequest request(const std::vector<std::string>& outputs) const;
};

/// Where and how to compute.
struct RunFlags {
  std::string device, lanes = "auto", math = "fast", real = "float", seed, repeat = "1";
  void add_to(CLI::App& app);
  RunOptions run_options() const;
};

}  // namespace gloam::cli
