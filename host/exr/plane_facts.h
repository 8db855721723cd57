// Figures on the values of planes.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "gloam/exr.h"

namespace gloam {

/// Range and mean of a plane over the foreground (over everything without depth), and the number of values that are not finite.
struct PlaneFacts {
  PlaneSource source;
  double min = std::numeric_limits<double>::infinity(), max = -min, mean = 0;
  long long nonfinite = 0, counted = 0;
};

/// Facts of all planes of a frame that was read with them.
std::vector<PlaneFacts> facts_of(const FrameFile& file, const Frame& frame);

/// As `facts_of`, for a frame that was surveyed with all planes: decodes them a few rows at a time.
std::vector<PlaneFacts> facts_by_rows(FrameFile& file, const Frame& frame);

/// Channels that belong to no plane, without gloam's own copies of results (Y); where several parts have one of a name, as --plane takes it: PART:CHANNEL.
std::vector<std::string> unread_channels(const FrameFile& file);

}  // namespace gloam
