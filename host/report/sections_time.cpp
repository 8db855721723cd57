// Where the time goes, and how it compares with other programs that compute the same.
#include "report/sections_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "base/lists.h"
#include "base/statistics.h"
#include "gloam/error.h"
#include "report/markdown_text.h"

namespace gloam::report {
namespace {

/// Above this many times its own gathers, the page tells where the rest of the time goes.
constexpr double far_above = 1.5;
constexpr size_t most_shares = 3;

/// The section once per device: times of different devices have no common median.
template <typename Body>
std::string per_device(const Material& material, const Body& body) {
  std::vector<std::string> devices;
  for (const Source& source : material.sources) add_new(devices, source.measurements.device);
  std::string text;
  for (const std::string& device : devices) {
    std::vector<Row> rows;
    for (const Row& row : material.all.rows) {
      if (material.sources[row.source].measurements.device == device) rows.push_back(row);
    }
    const std::string part = body(rows);
    if (!part.empty() && devices.size() > 1) text += fmt::format("### On {}\n\n", plain_text(device));
    text += part;
  }
  return text;
}

/// The share of each part; the passes of a filter ("gaussian/horizontal", "gaussian/vertical") count as one.
std::map<std::string, double> shares_of(const Row& row) {
  std::map<std::string, double> shares;
  for (const Share& share : row.spent_on) shares[share.what.substr(0, share.what.find('/'))] += share.share;
  return shares;
}

/// "arithmetic of the estimate 45 %, gathers 37 %": medians over the rows, the largest first.
std::string largest_shares(const std::vector<Row>& rows) {
  std::map<std::string, std::vector<double>> shares;
  for (const Row& row : rows) {
    for (const auto& [what, share] : shares_of(row)) shares[what].push_back(share);
  }
  std::vector<std::pair<double, std::string>> sorted;
  for (const auto& [what, values] : shares) sorted.emplace_back(-median(values), what);
  std::sort(sorted.begin(), sorted.end());
  std::string text;
  for (size_t i = 0; i < std::min(sorted.size(), most_shares); ++i)
    text += fmt::format("{}{} {:.0f} %", i ? ", " : "", plain_text(sorted[i].second), -100 * sorted[i].first);
  return text;
}

std::string remark_on(double ratio, const std::vector<Row>& rows) {
  if (ratio < 1) return "no floor: its gathers alone take longer";
  return ratio > far_above ? largest_shares(rows) : "";
}

std::string floor_table(const std::vector<Row>& rows) {
  Table table({"setting", "time over its own gathers", "most of it is spent on"}, "lrl");
  for (const std::string& technique : techniques_of(rows)) {
    const std::vector<Row> of_technique = default_rows(rows, technique);
    std::vector<double> ratios;
    for (const Row& row : of_technique) {
      if (row.ratio_to_own_floor) ratios.push_back(*row.ratio_to_own_floor);
    }
    if (ratios.empty()) continue;
    const double ratio = median(ratios);
    table.add({setting_text(technique, of_technique.front().preset), ratio_text(ratio),
               remark_on(as_printed(ratio_text(ratio)), of_technique)});
  }
  return table.empty() ? "" : table.text();
}

// --- Other ways to compute it

/// "0.052", or "0.052 (0.048 to 0.055)" over several scenes.
std::string spread(const std::vector<double>& ratios) {
  if (ratios.empty()) return "-";
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  const std::string middle = ratio_text(median(ratios)), low = ratio_text(*least), high = ratio_text(*most);
  return low == high ? middle : fmt::format("{} ({} to {})", middle, low, high);
}

constexpr const char* estimate = "estimate";
constexpr const char* native = "native loop, estimate";
std::string naive(const std::string& part) { return "naive kernel, " + part; }

/// Column -> ratios over the scenes, for one setting.
using Ratios = std::map<std::string, std::vector<double>>;

void add_ratios(const Row& row, Ratios& ratios) {
  for (const AgainstNaive& part : row.naive) ratios[naive(part.part)].push_back(part.ratio);
  if (row.naive.empty() && row.ratio_to_naive) ratios[naive(estimate)].push_back(*row.ratio_to_naive);
  if (row.ratio_to_native) ratios[native].push_back(*row.ratio_to_native);
}

std::string others_table(const std::vector<Row>& rows) {
  std::vector<std::string> settings, columns;
  std::map<std::string, Ratios> found;
  for (const Row& row : rows) {
    Ratios ratios;
    add_ratios(row, ratios);
    if (ratios.empty()) continue;
    const std::string setting = setting_text(row.technique, row.preset, row.variant);
    add_new(settings, setting);
    for (const AgainstNaive& part : row.naive) add_new(columns, naive(part.part));
    for (const auto& [column, values] : ratios) {
      add_new(columns, column);
      found[setting][column].insert(found[setting][column].end(), values.begin(), values.end());
    }
  }
  if (settings.empty()) return "";
  std::vector<std::string> heading{"setting"};
  for (const std::string& column : columns) heading.push_back(plain_text(column));
  Table table(heading, "lr");
  for (const std::string& setting : settings) {
    std::vector<std::string> cells{setting};
    for (const std::string& column : columns) cells.push_back(spread(found[setting][column]));
    table.add(cells);
  }
  return table.text();
}

}  // namespace

std::string floor_section(const Material& material) {
  const std::string tables = per_device(material, floor_table);
  if (tables.empty()) return "";
  return "## Time beside the floor\n\n" +
         paragraph(fmt::format("The whole plan's time over that of its own gathers: the same passes where samples only "
                               "add up what they read, without a filter. 1 would be a technique that reads and does "
                               "nothing else. Medians over the scenes; above {:g} times the table says what most of "
                               "the time is spent on, in shares of the whole.",
                               far_above)) +
         tables;
}

std::string others_section(const Material& material) {
  const std::string tables = per_device(material, others_table);
  if (tables.empty()) return "";
  return "## Beside other ways to compute it\n\n" +
         paragraph(
             "The time over that of programs that compute the same: naive kernels are a plain port with one pixel "
             "per work-item, the native loop is C++ with vectors by hand. Below 1 gloam is faster. Median over the "
             "scenes (least to most).") +
         tables;
}

}  // namespace gloam::report
