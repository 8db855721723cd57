// Figures and pieces of Markdown as the generated page has them.
#pragma once

#include <string>
#include <vector>

#include "report/measurements.h"

namespace gloam::report {

// --- Figures. An empty number is "-".

/// Three decimals without a zero in front: ".127"; "<.001" for what would be shown as 0 and is none.
std::string error_text(const Number& error);
/// The same with a sign: "+.014".
std::string bias_text(const Number& bias);
/// ".127 (+.014)"; without the parentheses where there is no bias.
std::string error_and_bias(const Number& error, const Number& bias);
/// Two significant digits: "0.41", "1.0", "12", "0.052".
std::string ratio_text(const Number& ratio);
/// The number that a figure says; 0 for "<.001".
double as_printed(const std::string& figure);

// --- Text

/// Text from a file as Markdown shows it: nothing in it is markup, and it stays in its cell of a table.
std::string plain_text(const std::string& text);
/// The same in the font of code.
std::string code(const std::string& text);
/// A path in a link.
std::string link_target(const std::string& path);

/// Wrapped at 120 columns, never so that a line begins like a list or a heading; an empty line follows.
std::string paragraph(const std::string& text);
/// "- ..." with the lines below set in.
std::string list_item(const std::string& text);

/// A table. The cells are Markdown. `alignment`: 'l' or 'r' for each column; the last holds for those that follow.
class Table {
 public:
  Table(std::vector<std::string> heading, std::string alignment)
      : heading_(std::move(heading)), alignment_(std::move(alignment)) {}
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  bool empty() const { return rows_.empty(); }
  /// An empty line follows.
  std::string text() const;

 private:
  std::vector<std::string> heading_;
  std::string alignment_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace gloam::report
