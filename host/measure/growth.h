// Growth of a technique's time with its amount of work.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gloam/device.h"
#include "gloam/frame.h"
#include "gloam/technique.h"
#include "results/measurements.h"

namespace gloam::bench {

using report::Growth;
using report::GrowthPoint;

/// The exponent p of ms = c * x^p, by least squares over the logarithms. None for fewer than two different x, or if a value is
/// not above 0.
std::optional<double> exponent(const std::vector<GrowthPoint>& points);

struct GrowthOptions {
  double radius = 0.5;  ///< scene units
  int rounds = 5;       ///< interleaved over the points
};

/// A frame in another size: pixels repeated or left out, the cameras adapted.
Frame resized(const Frame& frame, int width, int height);

/// The frame with its first view repeated.
Frame with_views(const Frame& frame, int views);

/// The frame with only the first `layers` of its peeled layers.
Frame with_layers(const Frame& frame, int layers);

/// Times of a technique with its default settings and without its filter, over
/// - pixels: a quarter to four times the frame's (the radius on the screen grows with the image's width),
/// - samples: the technique's presets; x is `Technique::samples`, else the product of the whole numbers that they set,
/// - radius: a quarter to four times; x is in pixels at the median depth,
/// - layers: if it, or the maker of its stochastic depth, reads peeled layers: 1, 2, 4 ... of those in the frame,
/// - views: 1, 2 and 4, unless it needs a fixed number.
/// Anything a technique does not have is left out, and so is what has no exponent. Throws as `gloam::run` does.
std::vector<Growth> measure_growth(const Technique& technique, const Frame& frame, Device& device,
                                   const GrowthOptions& options);

}  // namespace gloam::bench
