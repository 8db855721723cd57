// Pictures that gloam bench stored, and sheets of them.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace gloam::report {

/// A picture below the folder, as grey and alpha (CV_8UC2). Throws Error naming it.
cv::Mat stored_picture(const std::filesystem::path& folder, const std::string& name);

/// One picture of a sheet.
struct Tile {
  std::string name, figures;  ///< two lines above it
  cv::Mat grey_alpha;         ///< CV_8UC2; what is transparent is drawn as background
};

/// Tiles in rows of three under a title and a line that explains, as 8-bit grey PNG of `most_bytes` at most: tiles are
/// 320 pixels wide or, where that takes more, narrower.
std::string sheet_png(const std::string& title, const std::string& about, const std::vector<Tile>& tiles,
                      size_t most_bytes);

}  // namespace gloam::report
