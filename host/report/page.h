// The report: measurements and pictures in one self-contained HTML file.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "results/front.h"
#include "results/measurements.h"

namespace gloam::report {

struct PageOptions {
  int picture_width = 480;                         ///< wider pictures are reduced to it by averaging; 0: as stored
  std::function<void(int done, int of)> progress;  ///< may be empty
};

struct Page {
  std::string html;
  int pictures = 0;                ///< embedded
  std::vector<std::string> notes;  ///< missing pictures, and why
};

/// Makes the page. Pictures that cannot be read are left out, with a note.
Page make_page(const Measurements& measurements, const std::filesystem::path& folder, const PageOptions& options);

}  // namespace gloam::report
