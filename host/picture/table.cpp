#include "picture/table.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace gloam {
namespace {

constexpr int gap = 24, space = 7;  ///< between columns; above and below the text of a row
const TextStyle heading_style{10, faint};

int column_width(const Table& table, size_t column) {
  int width = natural_width({{table.columns[column].heading, heading_style}});
  for (const std::vector<Table::Cell>& row : table.rows) width = std::max(width, natural_width(row[column]));
  return width;
}

std::vector<int> widths_of(const Table& table, int width) {
  std::vector<int> widths;
  int rest = width - gap * (int(table.columns.size()) - 1);
  for (size_t i = 0; i < table.columns.size(); ++i) {
    widths.push_back(std::min(table.columns[i].widest, column_width(table, i)));
    rest -= widths.back();
  }
  for (size_t i = 0; i < table.columns.size(); ++i)
    if (table.columns[i].widest == 0) widths[i] = std::max(1, rest);
  return widths;
}

std::vector<Table::Cell> headings_of(const Table& table) {
  std::vector<Table::Cell> cells;
  for (const TableColumn& column : table.columns) cells.push_back({{column.heading, heading_style}});
  return cells;
}

void add_row(PlacedTable& out, const Table& table, const std::vector<Table::Cell>& cells,
             const std::vector<int>& widths) {
  int x = 0, tallest = 0;
  for (size_t i = 0; i < cells.size(); ++i) {
    out.blocks.push_back(block_of(cells[i], widths[i], table.columns[i].align));
    out.corners.emplace_back(x, out.height + space);
    tallest = std::max(tallest, out.blocks.back().height);
    x += widths[i] + gap;
  }
  out.height += tallest + 2 * space;
  out.rules.push_back(out.height);
}

}  // namespace

PlacedTable placed(const Table& table, int width) {
  PlacedTable out;
  out.width = width;
  const std::vector<int> widths = widths_of(table, width);
  add_row(out, table, headings_of(table), widths);
  for (const std::vector<Table::Cell>& row : table.rows) add_row(out, table, row, widths);
  out.height += 1;  // the last rule
  return out;
}

void put_table(cv::Mat& canvas, const PlacedTable& table, cv::Point corner) {
  for (size_t i = 0; i < table.blocks.size(); ++i) put_block(canvas, table.blocks[i], corner + table.corners[i]);
  for (const int y : table.rules) {
    const cv::Point left = corner + cv::Point(0, y);
    cv::line(canvas, left, left + cv::Point(table.width - 1, 0), rule, 1);
  }
}

}  // namespace gloam
