// The roofline: what a pass computes and reads by count, and what the device can do at most.
#pragma once

#include <optional>
#include <string>

namespace gloam::bench {

/// What a pass does for each pixel of a frame, counted once on small frames (script/update-operation-counts).
struct PassCount {
  double operations = 0;  ///< on floats; a fused multiply-add is two
  double loads = 0;       ///< of one value from a plane
  double bytes_loaded = 0, bytes_stored = 0;
};

/// Empty for a pass, a preset or a technique that was not counted.
std::optional<PassCount> count_of(const std::string& technique, const std::string& preset, const std::string& pass);

/// What the device reached on one frame, in the rounds of its race.
struct Peaks {
  std::optional<double> copy_gb_per_s;   ///< one plane read, one written
  std::optional<double> gather_g_per_s;  ///< 10^9 values read at the addresses of HBAO+'s samples
  std::optional<double> fma_gflops;      ///< 10^9 operations on floats by fused multiply-adds, two each
};

}  // namespace gloam::bench
