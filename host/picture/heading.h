// The heading above the tiles of a picture: title, facts, and the scale of the depths.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "picture/scale.h"
#include "picture/wordings.h"

namespace gloam {

/// The heading above the tiles of a sheet.
struct Heading {
  std::string title;
  Wordings facts;                 ///< a line below the title
  const Range* depths = nullptr;  ///< "depth 1.2 [bar] 14" below that, where depths are drawn
  double unit = 1;                ///< scales it
  int margin = 24;                ///< pixels, on either side
};

/// Height down to the captions of the tiles, pixels.
int heading_height(double unit, bool has_depths);

void draw_heading(cv::Mat& canvas, const Heading& heading);

}  // namespace gloam
