#include "stress/page.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "base/lists.h"
#include "gloam/error.h"

namespace gloam::stress {
namespace {

/// One entry of "cases".
struct Row {
  std::string technique, what, conditions, place;
  int number = 0, trial = 0;
  double worst = 0, bound = 0;
  bool held = true;
};

/// Escapes text for a table.
std::string cell(std::string text) {
  std::string out;
  for (const char c : text) out += c == '|' ? "\\|" : c == '\n' ? " " : std::string(1, c);
  return out;
}

std::string place_in_words(const Json& place) {
  if (place.is_null()) return "";
  const std::string view = place.at("view"), plane = place.at("plane");
  return fmt::format("{}{} ({}, {}): {}", view.empty() ? "" : view + ".", plane, place.at("x").get<int>(),
                     place.at("y").get<int>(), place.at("holds").get<std::string>());
}

std::vector<Row> rows_of(const Json& document) {
  std::vector<Row> rows;
  for (const Json& entry : document.at("cases")) {
    rows.push_back({entry.at("technique"), entry.at("what"), entry.at("conditions"), place_in_words(entry.at("place")),
                    entry.at("case"), entry.at("trial"), number_of(entry.at("worst")), number_of(entry.at("bound")),
                    entry.at("held")});
  }
  return rows;
}

std::string shown(double value) { return std::isfinite(value) ? fmt::format("{:.2g}", value) : "inf"; }
std::string bound_of(const Row& row) { return std::isfinite(row.bound) ? shown(row.bound) : "stated"; }

/// Ratio of a figure to its bound; above 1 it fails.
double taken(const Row& row) {
  if (row.bound == 0) return row.worst == 0 ? 0 : INFINITY;
  return row.worst / row.bound;
}

std::vector<std::string> techniques_of(const std::vector<Row>& rows) {
  std::set<std::string> names;
  for (const Row& row : rows) names.insert(row.technique);
  return {names.begin(), names.end()};
}

std::string listed(const std::set<std::string>& names) {
  std::vector<std::string> quoted;
  for (const std::string& name : names) quoted.push_back("`" + name + "`");
  return quoted.empty() ? "none" : fmt::format("{}", fmt::join(quoted, ", "));
}

/// Flag that a command needs besides the case and the trial: a quick run has other trials.
std::string quick_flag(const Json& document) { return document.at("extent") == "quick" ? "--quick " : ""; }

std::string introduction(const Json& document) {
  const std::vector<Row> rows = rows_of(document);
  const auto failed = document.at("failed").get<int>();
  std::string against;
  const auto left = document.at("left").get<std::set<std::string>>();
  for (const Json& other : document.at("against")) against += (against.empty() ? "" : "; ") + other.get<std::string>();
  return fmt::format(
      "# Stability\n\n"
      "What hard cases do to each technique. Written by `gloam stress`; do not edit. `script/stability` makes it "
      "anew.\n\n"
      "`gloam stress TECHNIQUE` examines one on any device, and `{}--case N --trial N -o FOLDER` makes one trial "
      "again and writes its frames: those are the numbers in the tables.\n\n"
      "- {} techniques, {} cases, {} figures; {} beyond {} bound.\n"
      "- Device: {} ({}). Compared with: {}.\n"
      "- Extent {}, {}seed {}.\n{}\n",
      quick_flag(document), techniques_of(rows).size(), cases().size(), rows.size(), failed,
      failed == 1 ? "its" : "their", document.at("device").get<std::string>(), document.at("driver").get<std::string>(),
      against.empty() ? "nothing" : against, document.at("extent").get<std::string>(),
      document.at("frames").get<int>()
          ? fmt::format("{} random frames for each technique, ", document.at("frames").get<int>())
          : "",
      document.at("seed").get<unsigned>(),
      left.empty() ? "" : fmt::format("- The run was broken off. Not examined: {}.\n", listed(left)));
}

std::string table_of_cases(const Json& document) {
  std::string text = "## Cases\n\n| case | | what holds | techniques | opted out |\n|---|---|---|---|---|\n";
  const std::vector<Row> rows = rows_of(document);
  for (const Case& one : cases()) {
    std::set<std::string> asked, out;
    for (const Row& row : rows) {
      if (row.number == one.number) asked.insert(row.technique);
    }
    for (const Json& entry : document.at("opted_out")) {
      if (entry.at("case") == one.number) out.insert(entry.at("technique").get<std::string>());
    }
    text += fmt::format("| [{}](#case-{}) | {} | {} | {} | {} |\n", one.number, one.number, one.name, one.property,
                        asked.size(), out.size());
  }
  return text + "\n";
}

/// A column of the table of comparisons: figures whose names contain these words. `where`: heading of the column with the
/// position of the largest; empty: no such column.
struct Comparison {
  const char* name;
  std::vector<std::string> words;
  const char* where;
};

const std::vector<Comparison>& comparisons() {
  static const std::vector<Comparison> all = {
      {"float / double, mean", {"float against double", "mean"}, ""},
      {"largest", {"float against double", "largest"}, "float / double"},
      {"fast / precise, mean", {"fast against precise", "mean"}, ""},
      {"largest", {"fast against precise", "largest"}, "fast / precise"},
      {"lanes / one, precise", {"precise: difference to one lane"}, ""},
      {"lanes / one, fast", {"fast: ", "difference to one lane"}, "lanes / one"},
      {"other CPU, precise", {"precise: difference to another device"}, ""},
      {"other CPU, fast", {"fast: ", "difference to another device"}, "other CPU"},
      {"half depth, mean", {"half, ", "mean"}, ""},
      {"largest", {"half, ", "largest"}, "half depth"},
      {"16 bit depth, mean", {"linear 16 bit", "mean"}, ""},
      {"largest", {"linear 16 bit", "largest"}, "16 bit depth"},
      {"reversed Z, largest", {"reversed-Z", "largest"}, "reversed Z"}};
  return all;
}

bool holds_all(const std::string& text, const std::vector<std::string>& words) {
  return std::all_of(words.begin(), words.end(),
                     [&](const std::string& word) { return text.find(word) != std::string::npos; });
}

std::string table_head(const std::string& columns) {
  std::string text = fmt::format("| {} |\n|", columns);
  for (const char c : columns) text += c == '|' ? "---|" : "";
  return text + "---|\n";
}

/// A row per technique; `cell_of` gives the text of a column.
std::string table_by_technique(const std::vector<std::string>& techniques, const std::vector<std::string>& columns,
                               const std::function<std::string(const std::string& technique, size_t column)>& cell_of) {
  std::string text = table_head(fmt::format("technique | {}", fmt::join(columns, " | ")));
  for (const std::string& technique : techniques) {
    text += fmt::format("| `{}` |", technique);
    for (size_t i = 0; i < columns.size(); ++i) text += fmt::format(" {} |", cell_of(technique, i));
    text += "\n";
  }
  return text + "\n";
}

/// Null if the technique has no such figure.
const Row* largest(const std::vector<Row>& rows, const std::string& technique, const Comparison& comparison) {
  const Row* worst = nullptr;
  for (const Row& row : rows) {
    const bool is_fast_double = row.what.starts_with("fast float against double");  // this figure is the sum of both
    if (row.technique != technique || is_fast_double || !holds_all(row.what, comparison.words)) continue;
    if (!worst || row.worst > worst->worst) worst = &row;
  }
  return worst;
}

std::string table_of_comparisons(const std::vector<Row>& rows) {
  std::vector<std::string> columns;
  for (const Comparison& c : comparisons()) columns.push_back(c.name);
  return "## What precision costs\n\nThe larger of the figures with exact normals and with normals made from depth, "
         "over all planes that the technique makes. 0: the same bits. -: not asked, or opted out.\n\n" +
         table_by_technique(techniques_of(rows), columns, [&](const std::string& technique, size_t i) {
           const Row* row = largest(rows, technique, comparisons()[i]);
           return row ? shown(row->worst) : "-";
         });
}

/// "14/3: ao_raw (77, 46)"
std::string where(const Row* row) {
  if (!row) return "-";
  if (row->worst == 0) return "0";
  return fmt::format("{}/{}: {}", row->number, row->trial, cell(row->place.substr(0, row->place.find(": "))));
}

std::string table_of_places(const Json& document) {
  const std::vector<Row> rows = rows_of(document);
  std::vector<Comparison> placed;
  std::vector<std::string> columns;
  for (const Comparison& c : comparisons()) {
    if (*c.where) placed.push_back(c), columns.push_back(c.where);
  }
  return fmt::format(
             "### Where\n\nCase and trial of the largest figure above, and its pixel. 14/3 stands for `gloam stress "
             "TECHNIQUE {}--case 14 --trial 3 -o FOLDER`.\n\n",
             quick_flag(document)) +
         table_by_technique(techniques_of(rows), columns, [&](const std::string& technique, size_t i) {
           return where(largest(rows, technique, placed[i]));
         });
}

std::string table_row(const Row& row) {
  return fmt::format("| `{}` | {}{} | {} | {} | {} | {} | {} |\n", row.technique, shown(row.worst),
                     row.held ? "" : " **beyond**", bound_of(row), cell(row.what), cell(row.conditions),
                     cell(row.place), row.trial);
}

/// The figure of each technique that is nearest to its bound.
std::string nearest_to_bounds(const std::vector<Row>& rows) {
  std::map<std::string, const Row*> nearest;
  for (const Row& row : rows) {
    if (!std::isfinite(row.bound)) continue;
    const Row*& known = nearest[row.technique];
    if (!known || taken(row) > taken(*known)) known = &row;
  }
  std::set<std::string> zero;
  std::string table;
  for (const auto& [technique, row] : nearest) {
    if (row->worst == 0)
      zero.insert(technique);
    else
      table += table_row(*row);
  }
  if (!table.empty()) table = table_head("technique | worst | bound | of | on | worst pixel | trial") + table + "\n";
  if (!zero.empty()) table += fmt::format("All that has a bound is 0 in every trial: {}.\n\n", listed(zero));
  return table;
}

/// Figures without a bound, a column each, with the trial. `gloam stress --json` has the pixel where each is worst.
std::string stated_figures(std::vector<Row> rows) {
  std::erase_if(rows, [](const Row& row) { return std::isfinite(row.bound); });
  if (rows.empty()) return "";
  std::vector<std::string> columns, names;
  for (const Row& row : rows) add_new(columns, row.what);
  for (const std::string& column : columns) names.push_back(cell(column));
  return "Stated, without a bound, and in brackets the trial:\n\n" +
         table_by_technique(techniques_of(rows), names, [&](const std::string& technique, size_t i) -> std::string {
           const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) {
             return r.technique == technique && r.what == columns[i];
           });
           if (row == rows.end()) return "-";
           return row->worst == 0 ? "0" : fmt::format("{} ({})", shown(row->worst), row->trial);
         });
}

std::string section_of_case(const Case& one, const Json& document) {
  std::vector<Row> rows = rows_of(document);
  std::erase_if(rows, [&](const Row& row) { return row.number != one.number; });
  return fmt::format("### Case {}\n\n{}: {}\n\n", one.number, one.name, one.property) + nearest_to_bounds(rows) +
         stated_figures(rows);
}

std::string table_of_reasons(const std::string& title, const std::string& explanation, const Json& entries) {
  std::string text = fmt::format("## {}\n\n{}\n\n", title, explanation);
  // A reason shared by many techniques is one row.
  std::map<std::pair<int, std::string>, std::set<std::string>> reasons;
  for (const Json& entry : entries)
    reasons[{entry.at("case").get<int>(), entry.at("why").get<std::string>()}].insert(
        entry.at("technique").get<std::string>());
  text += "| case | why | techniques |\n|---|---|---|\n";
  for (const auto& [reason, techniques] : reasons)
    text += fmt::format("| {} | {} | {} |\n", reason.first, cell(reason.second), listed(techniques));
  return text + "\n";
}

std::string section_of_device(const Json& document) {
  const std::vector<Row> rows = rows_of(document);
  std::string text =
      fmt::format("## On {}\n\n{}. {} figures, {} beyond their bounds; extent {}.\n\n",
                  document.at("device").get<std::string>(), document.at("driver").get<std::string>(), rows.size(),
                  document.at("failed").get<int>(), document.at("extent").get<std::string>());
  text += "| technique | case | of | worst | bound | on | worst pixel | trial |\n|---|---|---|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    const bool is_of_devices = row.number == 13 && row.what.find("device") != std::string::npos;
    if (row.held && !is_of_devices) continue;
    text += fmt::format("| `{}` | {} | {} | {}{} | {} | {} | {} | {} |\n", row.technique, row.number, cell(row.what),
                        shown(row.worst), row.held ? "" : " **beyond**", bound_of(row), cell(row.conditions),
                        cell(row.place), row.trial);
  }
  return text + "\n";
}

}  // namespace

std::string stability_page(const std::vector<Json>& documents) {
  try {
    const Json& first = documents.at(0);
    std::string page =
        introduction(first) + table_of_cases(first) + table_of_comparisons(rows_of(first)) + table_of_places(first);
    page += "## Worst values\n\nOf each technique the figure that takes most of its bound, and all that have none.\n\n";
    for (const Case& one : cases()) page += section_of_case(one, first);
    page += table_of_reasons("Opted out", "Cases that a technique is not held to, and the reason on its page.",
                             first.at("opted_out"));
    page += table_of_reasons("Opted out in part", "Held to the case, except for this part of it.",
                             first.at("opted_out_in_part"));
    page += table_of_reasons("Not asked", "Cases, or parts of them, that do not apply to a technique.",
                             first.at("passed_over"));
    for (size_t i = 1; i < documents.size(); ++i) page += section_of_device(documents[i]);
    while (page.ends_with("\n\n")) page.pop_back();
    return page;
  } catch (const Json::exception& error) {
    throw Error("the results of gloam stress cannot be read ({}); gloam stress all --json FILE writes some",
                error.what());
  }
}

}  // namespace gloam::stress
