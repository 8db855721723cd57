// Frames and settings drawn at random, each from its seed and number alone, and the smallest that still shows a fault.
#pragma once

#include <functional>
#include <string>

#include "stress/probe.h"

namespace gloam::stress {

/// A frame, settings, and a way to run them.
struct Draw {
  Frame frame;
  Settings settings;
  RunOptions options;
  std::string text() const;  ///< "33x1, perspective, radius = inf, lanes 1, fast"
};

/// The frame that a number stands for: any of the sizes, cameras and planes that the technique may meet, with values from a
/// room's to what no file should hold, and settings from all of their range. Counts that shape loops are the cheapest preset's,
/// and choices change one at a time, since each combination is compiled anew; in a quick look seldom.
Draw draw(const Technique& technique, const Device& device, Extent extent, uint32_t seed, uint32_t number);

/// A draw that still `fails`, and from which nothing more can be left out: settings, columns and rows, planes, pixels.
Draw shrunk(Draw failing, const std::function<bool(const Draw&)>& fails);

Draw clone(const Draw& draw);

}  // namespace gloam::stress
