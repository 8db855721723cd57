// Flags for techniques, their parameters, the device and the precision.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "flags/typed.h"
#include "gloam/plan.h"
#include "gloam/run.h"
#include "gloam/variants.h"
#include "run/run_words.h"

namespace gloam::cli {

/// Which variant of the techniques that are named.
struct VariantFlags : VariantChoice {
  void add_to(CLI::App& app);
  bool any() const { return layers || both_eyes; }
};

/// Techniques and their parameters.
struct TechniqueFlags {
  std::vector<std::string> settings;
  std::string preset, filter, with, adaptive, only, elsewhere;
  int resolution = 1;
  bool temporal = false;
  VariantFlags variant;
  /// `with_mask`: adds --only, --elsewhere, --temporal, --layers and --eyes as well.
  void add_to(CLI::App& app, bool with_mask = true);
  PlanRequest request(const std::vector<std::string>& outputs) const;
};

/// The device that computes.
struct DeviceFlags {
  std::string device;
  bool no_tuning = false;
  void add_to(CLI::App& app, const std::string& group = "Options");
  Device open() const;
  /// The flags again, with a space before each, for a command line that is told.
  std::string as_text() const;
};

/// The device, and how it computes.
struct RunFlags : DeviceFlags {
  int lanes = 0, repeat = 1;
  Math math = Math::fast;
  Real real = Real::float32;
  std::optional<int> seed;
  void add_to(CLI::App& app);
  RunOptions run_options() const;
};

}  // namespace gloam::cli
