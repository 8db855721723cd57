// What differs between two results, and what can still be compared.
#pragma once

#include <string>
#include <vector>

#include "results/joined.h"

namespace gloam::report {

struct Conditions {
  bool one_device = true;   ///< the same device and driver
  bool have_rounds = true;  ///< both files keep enough rounds
  double error_tolerance = 0;
  std::vector<std::string> other_radius, other_truth;  ///< scenes
  std::vector<std::string> notes;                      ///< one line each
};

/// Throws Error for results of different sets: frames of the same name differ.
Conditions conditions_of(const Source& first, const Source& second);

}  // namespace gloam::report
