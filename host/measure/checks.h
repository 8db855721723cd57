// Two checks: a bare plane must read open, and the look must not depend on the resolution.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gloam/device.h"
#include "gloam/error.h"
#include "gloam/frame.h"
#include "gloam/technique.h"
#include "results/measurements.h"

namespace gloam::bench {

using report::PlaneReading;
using report::ScaleChange;

/// Every second pixel of every second row, beginning with the first. The camera is adapted, so that a pixel's centre stays the
/// same point in space. Empty if a side is one pixel long.
Frame every_second_pixel(const Frame& frame);

/// Called for a technique that cannot be measured; the others go on.
using OnFailure = std::function<void(const Technique& technique, const Error& why)>;

/// Measures the frame, every second and every fourth pixel of it, for each technique with default settings and its filter. The
/// pixels compared are those that both sizes have: the same points in space.
std::vector<ScaleChange> measure_scales(const std::vector<const Technique*>& techniques, const Frame& frame,
                                        const std::string& scene, double radius, Device& device,
                                        const OnFailure& on_failure);

/// Planes tilted by 0 to 85 degrees towards the side, the corner and the top of the image, through three cameras, with
/// default settings and a radius of a quarter of the distance; unfiltered and filtered.
std::vector<PlaneReading> measure_planes(const std::vector<const Technique*>& techniques, int width, int height,
                                         Device& device, const OnFailure& on_failure);

}  // namespace gloam::bench
