#include "papers/paper.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/lists.h"
#include "measure/document.h"
#include "papers/doronin2017.h"
#include "papers/odssao2020.h"
#include "papers/shi2022.h"
#include "papers/vermeer2021.h"
#include "papers/wu2024.h"
#include "report/markdown_text.h"

namespace gloam::bench {
namespace {

/// Names of rows or columns in the order of their first entries.
template <typename Entry>
struct Grid {
  std::vector<std::string> rows, columns;
  explicit Grid(const std::vector<const Entry*>& entries) {
    for (const Entry* e : entries) {
      add_new(rows, e->row);
      add_new(columns, e->column);
    }
  }
};

/// Digits after the point for units that do not need four.
const std::map<std::string, int> digits_of_units = {{inconsistency_unit, 1}, {"pixels of 100 000", 1}, {"dB", 2},
                                                    {"triangles", 0},        {"milliseconds", 0},      {"ratio", 2}};

std::string text_of(const report::PaperFigure& t) {
  std::string text = fmt::format("{:.{}f} ms", *t.ms, *t.ms < 10 ? 2 : 1), paper;
  if (t.ratio) text += fmt::format(", {:.2f}", *t.ratio);
  if (t.paper_ms) paper += fmt::format("{:.2f} ms", *t.paper_ms);
  if (t.paper_ratio) paper += fmt::format(", {:.2f}", *t.paper_ratio);
  return paper.empty() ? text : fmt::format("{} ({})", text, paper);
}

std::string text_of(const PaperFact& f) {
  if (f.unit == "share") return fmt::format("{:.1f} %", 100 * f.value);
  const auto digits = digits_of_units.find(f.unit);
  return fmt::format("{:.{}f}", f.value, digits == digits_of_units.end() ? 4 : digits->second);
}

template <typename Entry>
std::string table_of(const std::vector<const Entry*>& entries) {
  const Grid<Entry> grid(entries);
  std::vector<std::string> heading = {""};
  heading.insert(heading.end(), grid.columns.begin(), grid.columns.end());
  report::Table table(std::move(heading), "lr");
  for (const std::string& row : grid.rows) {
    std::vector<std::string> cells = {row};
    for (const std::string& column : grid.columns) {
      const auto found = std::find_if(entries.begin(), entries.end(),
                                      [&](const Entry* e) { return e->row == row && e->column == column; });
      cells.push_back(found == entries.end() ? "" : text_of(**found));
    }
    table.add(std::move(cells));
  }
  return table.text();
}

/// All entries of a list under one heading.
template <typename Entry>
void add_tables(std::string& text, const std::vector<Entry>& entries, std::string Entry::*heading,
                const std::function<std::string(const Entry&)>& below) {
  std::vector<std::string> headings;
  for (const Entry& e : entries) add_new(headings, e.*heading);
  for (const std::string& name : headings) {
    std::vector<const Entry*> chosen;
    for (const Entry& e : entries) {
      if (e.*heading == name) chosen.push_back(&e);
    }
    text += fmt::format("\n## {}\n\n{}\n{}", name, below(*chosen.back()), table_of(chosen));
  }
}

}  // namespace

const std::vector<Paper>& papers() {
  static const std::vector<Paper> all = {vermeer2021(), shi2022(), odssao2020(), wu2024(), doronin2017()};
  return all;
}

std::string page_of(const Paper& paper, const PaperResult& result, const PaperOptions& options,
                    const DeviceInfo& device) {
  std::string text = fmt::format("# {}, measured again\n\n{} ({}), {} x {} pixels, {} rounds.\n", paper.title,
                                 cpu_model(), device.name, options.width, options.height, options.rounds);
  for (const std::string& note : result.notes) text += fmt::format("\n- {}", note);
  text += "\n";
  add_tables<report::PaperFigure>(text, result.times, &report::PaperFigure::table, [](const report::PaperFigure& t) {
    return fmt::format("Milliseconds, and the ratio to {}; in brackets the paper's own.\n", t.base);
  });
  add_tables<PaperFact>(text, result.facts, &PaperFact::figure,
                        [](const PaperFact& f) { return f.unit == "share" ? "" : f.unit + ".\n"; });
  for (const PaperPicture& p : result.pictures)
    text += fmt::format("\n## {}\n\n{}\n\n![{}]({})\n", p.figure, p.caption, p.figure, p.file);
  return text;
}

}  // namespace gloam::bench
