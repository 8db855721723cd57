// Pictures stored by gloam bench, and sheets of them.
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
  std::string name, figures;  ///< two lines above the picture
  cv::Mat grey_alpha;         ///< CV_8UC2; transparent pixels are drawn as background
};

/// Tiles in rows of three under a title and a line of explanation, as 8-bit grey PNG of at most `most_bytes`: tiles are 320
/// pixels wide, or narrower if the limit requires it.
std::string sheet_png(const std::string& title, const std::string& about, const std::vector<Tile>& tiles,
                      size_t most_bytes);

}  // namespace gloam::report
