// What a choice of settings is for: a time, or an error.
#pragma once

#include <optional>
#include <string>

namespace gloam {

/// One of both is given, or none: then nothing is chosen by measurement.
struct Goal {
  std::optional<double> ms;     ///< device time: the most accurate within it is chosen
  std::optional<double> error;  ///< bound on an error: the fastest within it is chosen
  std::string per_second = {};  ///< the time as frames per second, where it was given so: "60fps"; for messages
  explicit operator bool() const { return ms || error; }
};

/// The goal of a time in words: "20ms", "0.02s", or frames per second, of which a frame takes 1000 / 60 ms: "60fps". Throws UsageError that names
/// what it was given for, `flag`.
Goal time_goal(const std::string& text, const std::string& flag = "budget");

}  // namespace gloam
