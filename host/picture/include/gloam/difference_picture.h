// The picture of `gloam compare`: a plane, its truth and the difference of both.
#pragma once

#include <filesystem>
#include <string>

#include "gloam/frame.h"
#include "gloam/metrics.h"

namespace gloam {

/// Picture of test, truth, signed difference in a diverging colour map with a scale bar, and the histogram of the differences, with
/// titles, and the figures written under it. PNG, written atomically.
struct DifferencePicture {
  std::string test_name, truth_name;  ///< file names for the titles
  float range = 0;  ///< difference at the ends of the colour map; 0: the smallest of 0.05, 0.1, 0.2, 0.5, 1 that covers
                    ///< 99 % of the pixels
  double exposure = 0;  ///< for radiance: factor on test and truth as shown; 0: values are shown as they are
};
void write_difference_picture(const std::filesystem::path& path, const Plane& test, const Plane& truth,
                              const Mask& foreground, const Metrics& metrics, const DifferencePicture& options);

/// The `range` of one picture, where none is given: for one scale over several pictures, the largest of theirs. Throws Error as the
/// picture does.
double difference_range(const Plane& test, const Plane& truth, const Mask& foreground);

}  // namespace gloam
