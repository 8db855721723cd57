// Figures of frames and images that several benchmarks take.
#pragma once

#include <vector>

#include "gloam/frame.h"
#include "gloam/metrics.h"

namespace gloam::bench {

/// One plane per view, in the order of the frame's views.
using Image = std::vector<Plane>;

/// Foreground of each view, by depth.
std::vector<Mask> foreground(const Frame& frame);

/// Root of the mean squared difference over the foreground of all views.
double rmse(const Image& test, const Image& truth, const std::vector<Mask>& foreground);

/// Mean of test - truth over the foreground of all views: above 0, the test is too bright.
double bias(const Image& test, const Image& truth, const std::vector<Mask>& foreground);

/// Mean absolute difference over all pixels.
double mean_difference(const Channel& a, const Channel& b);

/// The greatest absolute difference of all pixels.
double greatest_difference(const Channel& a, const Channel& b);

/// The median depth of a view's surfaces, scene units; 0 where there are none.
double median_depth(const View& view);

/// The radius on the screen, in pixels, at the median depth of the first view's surfaces; 0 where there are none.
double median_reach(const Frame& frame, double radius);

}  // namespace gloam::bench
