// A property that every technique of the registry has. Adding a technique adds its tests; nothing here names one.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gloam/technique.h"
#include "support/frames.h"
#include "support/techniques.h"

namespace gloam::test {

class HardCase : public testing::TestWithParam<std::string> {
 protected:
  const Technique& technique() const { return find_technique(GetParam()); }

  /// Prints "hard case 2  hbao+  worst 1e-7  bound 1e-5  (what)", records it, and fails where the worst is beyond the bound.
  void report(int row, const std::string& what, double worst, double bound);
};

/// The reason of a line "hard case 3: reason" in the README.md of the technique's folder; empty where there is none. With a
/// `part`, of a line "hard case 13, fast: reason".
std::string opt_out(const Technique& technique, int row, const std::string& part = "");

// What takes time here is the compiler: OpenCL on a CPU compiles each kernel anew for each combination of settings, lanes,
// mathematics and size of image, which takes a hundred times as long as computing a small image. What is compiled is kept
// on disk and serves all rows that use it. So the rows share few sizes and few samples where they hold for any.

/// The defaults, and each other value of each choice and switch by itself, with few samples.
std::vector<Settings> variants(const Technique& technique, Frame& frame);

/// Both kinds of mathematics, each with both of `usual_lanes`.
std::vector<RunOptions> all_ways();
/// Both kinds of mathematics and both numbers of lanes in two runs, where many settings or sizes are tried.
std::vector<RunOptions> two_ways();

/// 80x60, through a perspective and an orthographic camera.
std::vector<Shot> usual_shots();
/// 93x61: no multiple of any number of lanes.
std::vector<Shot> odd_shots();

/// "directions = 4, jitter = off"
std::string text_of(const Settings& settings);

Settings operator+(Settings a, const Settings& b);

/// Largest distance of the planes that lie in 0..1 from what they hold where nothing is near (1 for AO).
double worst_distance_from_open(const Plan& plan, const Frame& outputs);

}  // namespace gloam::test

#define SKIP_WHERE_OPTED_OUT(row)                                                                    \
  if (const std::string reason = opt_out(technique(), row); !reason.empty()) {                       \
    std::printf("hard case %d  %s  opted out: %s\n", row, technique().name.c_str(), reason.c_str()); \
    GTEST_SKIP() << "opted out: " << reason;                                                         \
  }
