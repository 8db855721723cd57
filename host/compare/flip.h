// FLIP: how visible the differences between two images are to somebody who looks from one to the other (Andersson, Nilsson,
// Akenine-Moeller, Oskarsson, Astroem, Fairchild 2020, "FLIP: A Difference Evaluator for Alternating Images").
#pragma once

#include <opencv2/core.hpp>

namespace gloam {

/// Pixels per degree of somebody 0.7 m before a screen of 3840 pixels on 0.7 m, as in the paper.
inline constexpr double flip_pixels_per_degree = 3840 * 3.14159265358979323846 / 180;

/// Of two images of three channels (CV_64FC3: red, green, blue), linear, 0 to 1 (what lies outside is brought there): one value
/// per pixel (CV_64F), 0 = the same, 1 = as far from each other as green from blue.
/// Equations as in the paper: contrast sensitivity filters in YCxCz, HyAB distance of Hunt-adjusted L*a*b*, edges and points by
/// Gaussian derivatives, and color to the power of 1 - features.
cv::Mat flip_map(const cv::Mat& test, const cv::Mat& truth, double pixels_per_degree = flip_pixels_per_degree);

/// Pixels around one that its value depends on.
int flip_reach(double pixels_per_degree = flip_pixels_per_degree);

}  // namespace gloam
