// What a technique must not do: read a bare plane as occluded, or look otherwise at another resolution.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gloam/device.h"
#include "gloam/error.h"
#include "gloam/frame.h"
#include "gloam/technique.h"

namespace gloam::bench {

/// What changes from a frame of every second pixel to the frame itself.
struct ScaleFacts {
  std::string technique, scene;
  std::string from, to;      ///< sizes: "480x270", "960x540"
  double mean_change = 0;    ///< mean ambient occlusion with more pixels minus that with fewer; above 0: brighter
  double mean_absolute = 0;  ///< the same pixel by pixel
};

/// Every second pixel of every second row, beginning with the first; the camera's image of a pixel's centre stays the
/// same point in space. Empty where a side is one pixel long.
Frame every_second_pixel(const Frame& frame);

/// Told of a technique that cannot be measured, and why; the others go on.
using OnFailure = std::function<void(const Technique& technique, const Error& why)>;

/// The frame, every second and every fourth pixel of it, each technique with default settings and its filter. Compared are
/// the pixels that both sizes have: the same points in space.
std::vector<ScaleFacts> measure_scales(const std::vector<const Technique*>& techniques, const Frame& frame,
                                       const std::string& scene, double radius, Device& device,
                                       const OnFailure& on_failure);

/// The least that a technique reads on planes that nothing occludes.
struct PlaneFacts {
  std::string technique, plane;    ///< "ao" or "ao_raw"
  double least = 1, mean = 1;      ///< of all pixels of all planes
  std::string camera;              ///< where the least is: "perspective", "off-axis" or "orthographic"
  double tilt = 0, direction = 0;  ///< degrees away from the eye, and towards which side of the image
  int x = 0, y = 0;
};

/// Planes tilted by 0 to 85 degrees towards the side, the corner and the top of the image, through three cameras, with
/// default settings and a radius of a quarter of the distance; unfiltered and filtered.
std::vector<PlaneFacts> measure_planes(const std::vector<const Technique*>& techniques, int width, int height,
                                       Device& device, const OnFailure& on_failure);

}  // namespace gloam::bench
