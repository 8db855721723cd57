// The panels of the picture of `gloam auto`: a view, and where an effect is called for.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "gloam/explanation.h"

namespace gloam {

/// What the panels of a view share.
struct PanelGround {
  cv::Mat colours;      ///< the view's colour, or its surfaces lit from the eye; CV_8UC3
  cv::Mat pale;         ///< the same in pale grey; CV_8UC1
  cv::Mat no_surface;   ///< 255 on background; CV_8UC1
  bool is_lit = false;  ///< lit from the eye, as the view has no colour
};

/// The view needs depth.
PanelGround ground_of(const View& view);

/// The tint on white, from the least strength (0) to the full one (1).
cv::Scalar tint_on_paper(double strength);

/// The end of the scale of all changes: 98 % of the values above 0 are at most this. 0 if no effect has any.
double largest_change(const std::vector<Explanation>& effects);

/// The pale image, tinted on surfaces where the effect is called for: by the change there on a scale from 0 to `largest`, or in full
/// if the effect has none. CV_8UC3.
cv::Mat tinted(const PanelGround& ground, const Explanation& effect, double largest);

}  // namespace gloam
