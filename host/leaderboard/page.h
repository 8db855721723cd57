// The leaderboard: one self-contained HTML file, and its tables as JSON.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "leaderboard/results.h"

namespace gloam::leaderboard {

enum class ShownPictures { all, plain, none };  ///< plain: without variants

struct PageOptions {
  int picture_width = 480;  ///< wider pictures are reduced to it by averaging; 0: as stored
  ShownPictures shown = ShownPictures::plain;
  std::function<void(int done, int of)> progress;  ///< may be empty
};

struct Page {
  std::string html;
  report::Json document;  ///< the tables, for programs
  int pictures = 0;       ///< embedded
  size_t methods = 0, items = 0;
  std::vector<std::string> notes;
};

/// Makes the page. Throws Error as `tables_of` does, and for files without a row.
Page make_page(const Results& results, const PageOptions& options);

}  // namespace gloam::leaderboard
