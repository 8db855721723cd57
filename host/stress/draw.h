// Random frames and settings, each determined by seed and number, and the reduction of a failing one.
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

/// The frame with this number: any size, camera and planes that the technique may get, with values from a room's to any that a
/// file may hold, and settings from their whole range. Parameters that are loop counts are the cheapest preset's, and choices
/// change one at a time, since each combination is compiled separately; a quick run knows two besides.
Draw draw(const Technique& technique, const Device& device, Extent extent, uint32_t seed, uint32_t number);

/// Reduces a draw that `fails`: leaves out settings, columns and rows, planes and pixels while it still fails.
Draw shrunk(Draw failing, const std::function<bool(const Draw&)>& fails);

Draw clone(const Draw& draw);

}  // namespace gloam::stress
