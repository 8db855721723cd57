// Figures of frames and images that several benchmarks use.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gloam/frame.h"
#include "gloam/metrics.h"

namespace gloam::bench {

/// One plane for each view that it was made for, by the view's name: a technique for two views may make it for one.
using Image = std::map<std::string, Plane>;
using Foreground = std::map<std::string, Mask>;

/// The foreground of each view, by depth, without a margin, which no picture shows; `first_view_only`: of the first.
Foreground foreground(const Frame& frame, bool first_view_only = false);

/// Moves a plane out of every view that has it.
Image image_of(Frame frame, const std::string& plane);

/// Root of the mean squared difference, of all components, over the foreground of views that both images have.
double rmse(const Image& test, const Image& truth, const Foreground& foreground);

/// Mean of test - truth, of all components, over the foreground of views that both images have; above 0: the test is too bright.
double bias(const Image& test, const Image& truth, const Foreground& foreground);

/// An image of one value, as large as another.
Image even_image(const Image& like, float value);

/// Mean absolute difference over all pixels.
double mean_difference(const Channel& a, const Channel& b);

/// The greatest absolute difference of all pixels.
double greatest_difference(const Channel& a, const Channel& b);

/// The median depth of a view's surfaces, scene units; 0 if there are none.
double median_depth(const View& view);

/// The radius on the screen, in pixels, at the median depth of the first view's surfaces; 0 if there are none.
double median_reach(const Frame& frame, double radius);

}  // namespace gloam::bench
