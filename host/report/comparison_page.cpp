#include "report/comparison_page.h"

#include <cmath>
#include <map>

#include "base/json_text.h"
#include "base/lists.h"
#include "gloam/error.h"
#include "report/markdown_text.h"

namespace gloam::report {
namespace {

using Cells = std::vector<std::vector<std::string>>;

std::string percent(double share) { return fmt::format("{:+.1f} %", 100 * share); }

std::string change_text(const std::optional<RelativeChange>& change) {
  if (!change) return "-";
  return fmt::format("{} ({:+.1f} to {:+.1f})", percent(change->value), 100 * change->low, 100 * change->high);
}

std::string error_change(const ComparedRow& row) {
  if (!row.rmse_from || !row.rmse_to) return "-";
  if (row.error == ErrorVerdict::same) return fmt::format("{:.4f}", *row.rmse_to);
  return fmt::format("{:.4f} to {:.4f}", *row.rmse_from, *row.rmse_to);
}

std::string scene_of(const RowName& name) { return name.size.empty() ? name.scene : name.scene + " " + name.size; }

bool differs(const ComparedRow& row) {
  return row.time == TimeVerdict::faster || row.time == TimeVerdict::slower || row.error == ErrorVerdict::nearer ||
         row.error == ErrorVerdict::farther;
}

std::string ratios_text(const ComparedRow& row) {
  if (!row.ratio_from || !row.ratio_to) return "-";
  return fmt::format("{:.3g} to {:.3g}", *row.ratio_from, *row.ratio_to);
}

std::string origin_text(const Source& source) {
  const Measurements& m = source.measurements;
  const auto or_unknown = [](const std::string& text) { return text.empty() ? "unknown" : text; };
  return fmt::format("{}: commit {}, {}, {} ({}), {}", source.name, or_unknown(m.commit), or_unknown(m.date),
                     or_unknown(m.cpu), or_unknown(m.device),
                     m.rows.size() == 1 ? std::string("1 row") : fmt::format("{} rows", m.rows.size()));
}

/// The first rows, and how many others there are.
std::string some_of(const std::vector<RowName>& names) {
  constexpr size_t most = 5;
  std::vector<std::string> told;
  for (const RowName& name : names) {
    if (told.size() < most || names.size() == most + 1) told.push_back(words(name));
  }
  if (told.size() < names.size()) told.push_back(fmt::format("{} others (--json has all)", names.size() - told.size()));
  return enumerate(told);
}

/// How many rows of a scene have which verdict on time; and which on errors.
struct Counts {
  std::map<TimeVerdict, size_t> times;
  std::map<ErrorVerdict, size_t> errors;
};

template <typename Verdict>
std::string counted(const std::map<Verdict, size_t>& counts) {
  std::vector<std::string> parts;
  for (const auto& [verdict, count] : counts) parts.push_back(fmt::format("{} {}", count, name_of(verdict)));
  return enumerate(parts);
}

Json change_document(const std::optional<RelativeChange>& change) {
  if (!change) return nullptr;
  return {{"value", change->value}, {"interval", {change->low, change->high}}};
}

Json document_of(const RowName& name) {
  return {{"technique", name.technique}, {"preset", name.preset}, {"variant", name.variant},
          {"scene", name.scene},         {"effect", name.effect}, {"size", name.size}};
}

Json document_of(const ComparedRow& row) {
  Json document = document_of(row.name);
  document.update({{"time", name_of(row.time)},
                   {"ratio", {or_null(row.ratio_from), or_null(row.ratio_to)}},
                   {"change", change_document(row.change)},
                   {"ms", {row.from.ms, row.to.ms}},
                   {"bound", {or_null(row.from.bound), or_null(row.to.bound)}},
                   {"error", name_of(row.error)},
                   {"rmse", {or_null(row.rmse_from), or_null(row.rmse_to)}}});
  return document;
}

Json origin_document(const Source& source) {
  const Measurements& m = source.measurements;
  return {{"file", source.name}, {"commit", m.commit}, {"gloam", m.gloam},    {"date", m.date},
          {"device", m.device},  {"driver", m.driver}, {"command", m.command}};
}

Json list_of(const std::vector<RowName>& names) {
  Json list = Json::array();
  for (const RowName& name : names) list.push_back(document_of(name));
  return list;
}

void add(std::string& page, const Cells& cells, const std::string& alignment) {
  if (cells.size() < 2) return;
  Table table(cells.front(), alignment);
  for (size_t i = 1; i < cells.size(); ++i) {
    std::vector<std::string> escaped;
    for (const std::string& cell : cells[i]) escaped.push_back(plain_text(cell));
    table.add(std::move(escaped));
  }
  page += table.text();
}

}  // namespace

std::vector<std::string> heading_of(const Comparison& c, const Source& first, const Source& second) {
  std::vector<std::string> lines = {origin_text(first), origin_text(second)};
  if (c.reference.empty()) {
    lines.push_back("times: not compared");
  } else {
    lines.push_back(
        fmt::format("times: ratios within rounds to {}, of {}; of the rows called faster or slower {:g} % are "
                    "expected to be wrong",
                    c.reference, c.by_cpu ? "what the cores spent" : "milliseconds", 100 * c.options.rate));
  }
  lines.push_back(fmt::format("errors: RMSE to the truth; up to {:g} % apart is the same{}", 100 * c.tolerance.relative,
                              c.tolerance.one_device ? "" : ", on two devices"));
  return lines;
}

Cells table_of_techniques(const Comparison& c) {
  Cells table = {{"technique", "time", "rows", "change (95 %)"}};
  for (const ComparedTechnique& t : c.techniques)
    table.push_back({t.technique, name_of(t.time), std::to_string(t.rows), change_text(t.change)});
  return table;
}

Cells table_of_rows(const Comparison& c, bool only_those_that_differ) {
  Cells table = {{"scene", "technique", "preset", "variant", "time", "error", "ratio", "change (95 %)", "RMSE"}};
  for (const ComparedRow& row : c.rows) {
    if (only_those_that_differ && !differs(row)) continue;
    const RowName& n = row.name;
    table.push_back({scene_of(n), n.technique, n.preset, n.variant, name_of(row.time), name_of(row.error),
                     ratios_text(row), change_text(row.change), error_change(row)});
  }
  return table;
}

Cells table_of_devices(const Comparison& c, const Source& first, const Source& second) {
  if (c.tolerance.one_device) return {};
  const bool same_name = first.measurements.device == second.measurements.device;
  const auto ms_on = [&](const Source& source) {
    return "ms " + (same_name ? "in " + source.name : "on " + source.measurements.device);
  };
  const std::string limit = "limited by";
  Cells table = {
      {"scene", "technique", "preset", "variant", limit, limit, ms_on(first), ms_on(second), "times as long"}};
  for (const ComparedRow& row : c.rows) {
    if (!row.is_same_work) continue;
    const auto or_dash = [](const std::string& text) { return text.empty() ? "-" : text; };
    table.push_back({scene_of(row.name), row.name.technique, row.name.preset, row.name.variant, or_dash(row.from.bound),
                     or_dash(row.to.bound), fmt::format("{:.4g}", row.from.ms), fmt::format("{:.4g}", row.to.ms),
                     row.from.ms > 0 ? fmt::format("{:.3g}", row.to.ms / row.from.ms) : "-"});
  }
  return table;
}

std::vector<std::string> counts_of(const Comparison& c, const Source& first, const Source& second) {
  std::map<std::string, Counts> by_scene;
  std::vector<std::string> scenes, lines;
  for (const ComparedRow& row : c.rows) {
    add_new(scenes, row.name.scene);
    ++by_scene[row.name.scene].times[row.time];
    ++by_scene[row.name.scene].errors[row.error];
  }
  for (const std::string& scene : scenes) {
    std::string line =
        fmt::format("{}: time {}; error {}", scene, counted(by_scene[scene].times), counted(by_scene[scene].errors));
    for (const auto& [name, width] : c.widths) {
      if (name == scene) line += fmt::format("; changes are known to {:.1f} % (the median row)", 100 * width);
    }
    lines.push_back(line);
  }
  for (const auto& [names, source] : {std::pair(&c.only_in_first, &first), std::pair(&c.only_in_second, &second)}) {
    if (!names->empty()) lines.push_back(fmt::format("only in {}: {}", source->name, some_of(*names)));
  }
  return lines;
}

std::string page_of(const Comparison& c, const Source& first, const Source& second, const std::string& command) {
  std::string page = "# Two runs compared\n\nMade by `" + command + "`.\n\n";
  for (const std::string& line : heading_of(c, first, second)) page += list_item(plain_text(line));
  for (const std::string& note : c.notes) page += list_item(plain_text(note));
  for (const std::string& line : counts_of(c, first, second)) page += list_item(plain_text(line));
  page += "\n## Techniques\n\n";
  add(page, table_of_techniques(c), "llr");
  if (const Cells devices = table_of_devices(c, first, second); !devices.empty()) {
    page += "## Devices\n\n";
    add(page, devices, "llllllrrr");
  }
  page += "## Rows\n\n";
  add(page, table_of_rows(c, false), "llllllr");
  while (page.size() > 1 && page.substr(page.size() - 2) == "\n\n") page.pop_back();
  return page;
}

Json document_of(const Comparison& c, const Source& first, const Source& second) {
  Json rows = Json::array(), techniques = Json::array(), widths = Json::object();
  for (const ComparedRow& row : c.rows) rows.push_back(document_of(row));
  for (const ComparedTechnique& t : c.techniques)
    techniques.push_back({{"technique", t.technique},
                          {"rows", t.rows},
                          {"time", name_of(t.time)},
                          {"change", change_document(t.change)}});
  for (const auto& [scene, width] : c.widths) widths[scene] = width;
  return {{"first", origin_document(first)},
          {"second", origin_document(second)},
          {"reference", or_null(c.reference)},
          {"times_of", c.by_cpu ? "cpu_ms" : "ms"},
          {"reference_change", or_null(c.reference_change)},
          {"others_change", or_null(c.others_change)},
          {"half_widths", widths},
          {"rate", c.options.rate},
          {"margin", c.options.margin},
          {"error_tolerance", c.tolerance.relative},
          {"techniques", techniques},
          {"rows", rows},
          {"only_in_first", list_of(c.only_in_first)},
          {"only_in_second", list_of(c.only_in_second)}};
}

}  // namespace gloam::report
