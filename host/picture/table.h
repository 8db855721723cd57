// Tables on pictures: wrapped cells under headings.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "picture/text_block.h"

namespace gloam {

struct TableColumn {
  std::string heading;
  Align align = Align::left;
  int widest = 0;  ///< longer texts are wrapped, pixels; 0: as wide as the other columns leave room for
};

struct Table {
  using Cell = std::vector<Paragraph>;
  std::vector<TableColumn> columns;  ///< one of them with `widest` 0
  std::vector<std::vector<Cell>> rows;
};

/// A table laid out to a width.
struct PlacedTable {
  std::vector<TextBlock> blocks;
  std::vector<cv::Point> corners;  ///< of the blocks, from the table's left top corner
  std::vector<int> rules;          ///< heights of the lines between rows
  int width = 0, height = 0;
};

/// Columns are as wide as their texts, at most `widest`; the one without a limit takes the rest of `width`.
PlacedTable placed(const Table& table, int width);

void put_table(cv::Mat& canvas, const PlacedTable& table, cv::Point corner);

}  // namespace gloam
