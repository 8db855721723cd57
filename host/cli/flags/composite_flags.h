// How a result is laid over the frame's colour.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <optional>
#include <string>

#include "gloam/composite.h"

namespace gloam::cli {

struct CompositeFlags {
  std::string path;  ///< empty: no composite
  double strength = 1;
  std::optional<std::array<double, 3>> tint;
  void add_to(CLI::App& app);
  Compositing how() const;
};

}  // namespace gloam::cli
