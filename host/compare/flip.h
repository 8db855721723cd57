// FLIP: how visible the differences between two images are to an observer who alternates between them (Andersson, Nilsson,
// Akenine-Moeller, Oskarsson, Astroem, Fairchild 2020, "FLIP: A Difference Evaluator for Alternating Images").
#pragma once

#include <opencv2/core.hpp>

namespace gloam {

/// Pixels per degree for an observer 0.7 m from a screen with 3840 pixels on 0.7 m, as in the paper.
inline constexpr double flip_pixels_per_degree = 3840 * 3.14159265358979323846 / 180;

/// FLIP of two linear images of three channels (CV_64FC3: red, green, blue; clamped to 0..1): one value per pixel (CV_64F), 0 =
/// equal, 1 = as different as green and blue. Equations as in the paper: contrast sensitivity filters in YCxCz, HyAB distance of
/// Hunt-adjusted L*a*b*, edges and points by Gaussian derivatives, and color to the power of 1 - features.
cv::Mat flip_map(const cv::Mat& test, const cv::Mat& truth, double pixels_per_degree = flip_pixels_per_degree);

/// The same for two linear images of one channel (CV_32F, 0..1) as greys: their colours are all 0, and all filters are separable.
cv::Mat grey_flip_map(const cv::Mat& test, const cv::Mat& truth, double pixels_per_degree = flip_pixels_per_degree);

/// Radius of the neighbourhood that a pixel's value depends on, pixels.
int flip_reach(double pixels_per_degree = flip_pixels_per_degree);

}  // namespace gloam
