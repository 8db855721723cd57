// Formatting of figures and of Markdown for the generated page.
#pragma once

#include <string>
#include <vector>

#include "results/measurements.h"

namespace gloam::report {

// --- Figures. An empty number is "-".

/// Three decimals without a leading zero: ".127"; "<.001" for a number above 0 that would round to 0.
std::string error_text(const Number& error);
/// As `error_text`, with a sign: "+.014".
std::string bias_text(const Number& bias);
/// ".127 (+.014)"; without the parentheses if there is no bias.
std::string error_and_bias(const Number& error, const Number& bias);
/// Two significant digits: "0.41", "1.0", "12", "0.052".
std::string ratio_text(const Number& ratio);
/// The number that a printed figure stands for; 0 for "<.001".
double as_printed(const std::string& figure);

// --- Text

/// Text from a file, escaped: nothing in it is markup, and it stays within a table cell.
std::string plain_text(const std::string& text);
/// The same in code font.
std::string code(const std::string& text);
/// A path in a link.
std::string link_target(const std::string& path);

/// Wrapped at 120 columns, so that no line looks like a list or a heading; an empty line follows.
std::string paragraph(const std::string& text);
/// "- ..." with the following lines indented.
std::string list_item(const std::string& text);

/// A table. The cells are Markdown. `alignment`: 'l' or 'r' for each column; the last holds for those that follow.
class Table {
 public:
  Table(std::vector<std::string> heading, std::string alignment)
      : heading_(std::move(heading)), alignment_(std::move(alignment)) {}
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  bool empty() const { return rows_.empty(); }
  /// The table; an empty line follows.
  std::string text() const;

 private:
  std::vector<std::string> heading_;
  std::string alignment_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace gloam::report
