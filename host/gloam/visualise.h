// Pictures for people, drawn with OpenCV.
#pragma once

#include <filesystem>
#include <string>

#include "gloam/frame.h"
#include "gloam/metrics.h"

namespace gloam {

/// The picture of `gloam compare`: test, truth, signed difference in a diverging colour map with a scale bar, and the
/// histogram of the differences, titled, with the figures written under it. PNG, written atomically.
struct DifferencePicture {
  std::string test_name, truth_name;  ///< file names for the titles
  float range = 0;  ///< difference at the ends of the colour map; 0: the smallest of 0.05, 0.1, 0.2, 0.5, 1 that covers
                    ///< 99 % of the pixels
};
void write_difference_picture(const std::filesystem::path& path, const Plane& test, const Plane& truth,
                              const Mask& foreground, const Metrics& metrics, const DifferencePicture& options);

/// One plane as an 8-bit PNG: grey for one component (0..1), normals as 0.5 + 0.5 n, others clamped to 0..1 through
/// sRGB.
void write_picture(const std::filesystem::path& path, const Plane& plane);

}  // namespace gloam
