#include "report/markdown_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "gloam/error.h"

namespace gloam::report {
namespace {

constexpr size_t columns = 120;

/// "0.127" -> ".127"
std::string without_zero(const std::string& digits) { return digits.starts_with("0.") ? digits.substr(1) : digits; }

/// Whether a line may begin with this word: some words would make it a list, a heading, a quotation or a table.
bool may_begin_a_line(const std::string& word) {
  if (std::isdigit((unsigned char)word.front())) return word.find_first_of(".)") == std::string::npos;
  return std::string("+-*#>|=~").find(word.front()) == std::string::npos;
}

/// Words in lines; all lines but the first are indented by `indent`.
std::string wrapped(const std::string& text, const std::string& first, const std::string& indent) {
  std::istringstream words(text);
  std::string out, line = first;
  bool is_empty = true;
  for (std::string word; words >> word;) {
    if (!is_empty && line.size() + 1 + word.size() > columns && may_begin_a_line(word)) {
      out += line + "\n";
      line = indent;
      is_empty = true;
    }
    line += (is_empty ? "" : " ") + word;
    is_empty = false;
  }
  return out + line + "\n";
}

std::string line_of(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line + "\n";
}

}  // namespace

std::string error_text(const Number& error) {
  if (!error) return "-";
  const std::string digits = fmt::format("{:.3f}", *error);
  if (digits == "0.000" && *error > 0) return "<.001";
  return without_zero(digits);
}

std::string bias_text(const Number& bias) {
  if (!bias) return "-";
  const std::string digits = without_zero(fmt::format("{:.3f}", std::abs(*bias)));
  return (*bias < 0 && digits != ".000" ? "-" : "+") + digits;
}

std::string error_and_bias(const Number& error, const Number& bias) {
  return error && bias ? fmt::format("{} ({})", error_text(error), bias_text(bias)) : error_text(error);
}

std::string ratio_text(const Number& ratio) {
  if (!ratio) return "-";
  if (*ratio == 0) return "0";
  // Rounding may add a digit (9.96 is 10), so the exponent is taken from the rounded number.
  const double rounded = std::strtod(fmt::format("{:.1e}", *ratio).c_str(), nullptr);
  const int exponent = int(std::floor(std::log10(std::abs(rounded)) + 1e-9));
  return fmt::format("{:.{}f}", rounded, std::max(0, 1 - exponent));
}

double as_printed(const std::string& figure) { return std::strtod(figure.c_str(), nullptr); }

std::string plain_text(const std::string& text) {
  std::string out;
  for (const char c : printable(text)) {
    if (std::string("\\`*_[]<>|#").find(c) != std::string::npos) out += '\\';
    out += c;
  }
  return out;
}

std::string code(const std::string& text) {
  std::string out = printable(text);
  std::replace(out.begin(), out.end(), '`', '\'');
  std::replace(out.begin(), out.end(), '|', '/');  // ends a cell even here
  return "`" + out + "`";
}

std::string link_target(const std::string& path) {
  std::string out;
  for (const char c : path) {
    const bool plain = std::isalnum((unsigned char)c) || std::string("/._-~+").find(c) != std::string::npos;
    out += plain ? std::string(1, c) : fmt::format("%{:02X}", (unsigned char)c);
  }
  return out;
}

std::string paragraph(const std::string& text) { return wrapped(text, "", "") + "\n"; }

std::string list_item(const std::string& text) { return wrapped(text, "- ", "  "); }

std::string Table::text() const {
  std::vector<std::string> rules;
  for (size_t i = 0; i < heading_.size(); ++i)
    rules.push_back(alignment_[std::min(i, alignment_.size() - 1)] == 'l' ? "---" : "---:");
  std::string text = line_of(heading_) + line_of(rules);
  for (const std::vector<std::string>& row : rows_) text += line_of(row);
  return text + "\n";
}

}  // namespace gloam::report
