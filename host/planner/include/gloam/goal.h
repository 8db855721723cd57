// What a choice of settings is for: a time, or an error.
#pragma once

#include <optional>
#include <string>

namespace gloam {

/// One of both is given, or none: then nothing is chosen by measurement.
struct Goal {
  std::optional<double> ms;     ///< device time: the most accurate within it is chosen
  std::optional<double> error;  ///< bound on an error: the fastest within it is chosen
  explicit operator bool() const { return ms || error; }
};

}  // namespace gloam
