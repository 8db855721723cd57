// Flags for techniques, their parameters, the device and the precision.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/typed.h"
#include "gloam/plan.h"
#include "gloam/run.h"

namespace gloam::cli {

/// Techniques and their parameters.
struct TechniqueFlags {
  std::vector<std::string> settings;
  std::string preset, then, with, adaptive, only, elsewhere;
  int resolution = 1;
  bool temporal = false;
  /// `with_mask`: adds --only, --elsewhere and --temporal as well.
  void add_to(CLI::App& app, bool with_mask = true);
  PlanRequest request(const std::vector<std::string>& outputs) const;
};

inline const Choices<Math> math_words = {{"precise", Math::precise}, {"fast", Math::fast}};
inline const Choices<Real> real_words = {{"float", Real::float32}, {"double", Real::float64}};

/// The device, and how it computes.
struct RunFlags {
  std::string device;
  int lanes = 0, repeat = 1;
  bool no_tuning = false;
  Math math = Math::fast;
  Real real = Real::float32;
  std::optional<int> seed;
  void add_to(CLI::App& app);
  RunOptions run_options() const;
};

}  // namespace gloam::cli
