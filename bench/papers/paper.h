// Reproduction of a paper's measurements: its tables with its ratios beside ours, its figures as pictures.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gloam/device.h"
#include "results/measurements.h"

namespace gloam::bench {

/// Unit of a difference between two eyes, a mean over pixels (gloam/stereo_consistency.h).
inline constexpr const char* inconsistency_unit = "mean inconsistency times 100 000";

/// A figure other than a time: an error, a share. Many come from images of the paper that have no numbers.
struct PaperFact {
  std::string figure, row, column;
  double value = 0;
  std::string unit;  ///< "RMSE", "share" ...
};

struct PaperPicture {
  std::string figure, caption, file;  ///< file: below the folder
};

/// The result of a reproduction.
struct PaperResult {
  std::vector<report::PaperFigure> times;  ///< with the median of the rounds, and the paper's own time on its device
  std::vector<PaperFact> facts;
  std::vector<PaperPicture> pictures;
  std::vector<std::string> notes;  ///< stand-ins, and differences from the paper
};

struct PaperOptions {
  std::filesystem::path folder;  ///< existing folder for pictures
  int width = 1920, height = 1080;
  int rounds = 9;
  int rays = 256;  ///< rays per pixel of traced truths
  /// Called for lengthy steps; may be empty.
  std::function<void(const std::string& what, double share_done)> progress;
};

struct Paper {
  std::string name;   ///< as users type it: "vermeer2021"
  std::string title;  ///< authors and year
  int rays;           ///< default rays per pixel
  std::function<PaperResult(Device&, const PaperOptions&)> reproduce;
  int width = 1920, height = 1080;  ///< default size
};

/// All papers that can be measured again.
const std::vector<Paper>& papers();

/// The result as a page: tables, facts, pictures.
std::string page_of(const Paper& paper, const PaperResult& result, const PaperOptions& options,
                    const DeviceInfo& device);

}  // namespace gloam::bench
