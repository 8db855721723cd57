// Flags that say which technique runs, with which parameters, where, and how.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/typed.h"
#include "gloam/plan.h"
#include "gloam/run.h"

namespace gloam::cli {

/// Which techniques, and with which parameters.
struct TechniqueFlags {
  std::vector<std::string> settings;
  std::string preset, then, with, adaptive, only, elsewhere;
  int resolution = 1;
  /// `with_mask`: --only and --elsewhere too.
  void add_to(CLI::App& app, bool with_mask = true);
  PlanRequest request(const std::vector<std::string>& outputs) const;
};

inline const Choices<Math> math_words = {{"precise", Math::precise}, {"fast", Math::fast}};
inline const Choices<Real> real_words = {{"float", Real::float32}, {"double", Real::float64}};

/// Where and how to compute.
struct RunFlags {
  std::string device;
  int lanes = 0, repeat = 1;
  Math math = Math::fast;
  Real real = Real::float32;
  std::optional<int> seed;
  void add_to(CLI::App& app);
  RunOptions run_options() const;
};

}  // namespace gloam::cli
