// Two checks: a bare plane must read open, and the look must not depend on the resolution.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gloam/device.h"
#include "gloam/error.h"
#include "gloam/frame.h"
#include "gloam/technique.h"

namespace gloam::bench {

/// Changes between a frame of every second pixel and the frame itself.
struct ScaleFacts {
  std::string technique, scene;
  std::string from, to;      ///< sizes: "480x270", "960x540"
  double mean_change = 0;    ///< mean ambient occlusion with more pixels minus that with fewer; above 0: brighter
  double mean_absolute = 0;  ///< mean of the absolute differences of pixels
};

/// Every second pixel of every second row, beginning with the first. The camera is adapted, so that a pixel's centre stays the
/// same point in space. Empty if a side is one pixel long.
Frame every_second_pixel(const Frame& frame);

/// Called for a technique that cannot be measured; the others go on.
using OnFailure = std::function<void(const Technique& technique, const Error& why)>;

/// Measures the frame, every second and every fourth pixel of it, for each technique with default settings and its filter. The
/// pixels compared are those that both sizes have: the same points in space.
std::vector<ScaleFacts> measure_scales(const std::vector<const Technique*>& techniques, const Frame& frame,
                                       const std::string& scene, double radius, Device& device,
                                       const OnFailure& on_failure);

/// The least value of a technique on planes that nothing occludes.
struct PlaneFacts {
  std::string technique, plane;    ///< "ao" or "ao_raw"
  double least = 1, mean = 1;      ///< over all pixels of all planes
  std::string camera;              ///< camera of the least value: "perspective", "off-axis" or "orthographic"
  double tilt = 0, direction = 0;  ///< degrees: tilt away from the eye, and direction of the tilt in the image
  int x = 0, y = 0;
};

/// Planes tilted by 0 to 85 degrees towards the side, the corner and the top of the image, through three cameras, with
/// default settings and a radius of a quarter of the distance; unfiltered and filtered.
std::vector<PlaneFacts> measure_planes(const std::vector<const Technique*>& techniques, int width, int height,
                                       Device& device, const OnFailure& on_failure);

}  // namespace gloam::bench
