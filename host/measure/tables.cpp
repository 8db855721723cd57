#include "measure/tables.h"

#include <algorithm>
#include <cmath>

#include "results/front.h"

namespace gloam::bench {
namespace {

/// With more variants than this, not all of a preset's variants are listed.
constexpr size_t most_variants = 3;

std::string cell(const std::optional<double>& value, const char* format = "{:.4f}") {
  return value && std::isfinite(*value) ? fmt::format(fmt::runtime(format), *value) : "-";
}

/// A row, and its standing among the rows of its scene.
struct Entry {
  const Row* row;
  double ms = 0, time = 0;  ///< time: the sort key
  bool on_front = false;
};

/// As in the report, time is the ratio, since ratios drift less; ms if a row has none.
void set_times(std::vector<Entry>& entries) {
  const bool with_ratio =
      std::all_of(entries.begin(), entries.end(), [](const Entry& e) { return e.row->to_hbao_plus.has_value(); });
  for (Entry& e : entries) e.time = with_ratio ? *e.row->to_hbao_plus : e.ms;
}

void mark_front(std::vector<Entry>& entries) {
  std::vector<report::Cost> costs;
  for (const Entry& e : entries) costs.push_back({e.time, e.row->errors.rmse.value_or(NAN)});
  for (const size_t i : report::pareto_front(costs)) entries[i].on_front = true;
}

bool same_preset(const Entry& a, const Entry& b) {
  return a.row->variation.technique == b.row->variation.technique && a.row->variation.preset == b.row->variation.preset;
}

bool is_variant(const Entry& e) { return !e.row->variation.variant.empty(); }

std::vector<std::string> cells_of(const Entry& e) {
  const Row& row = *e.row;
  const Ladder& l = row.ladder;
  const Variation& v = row.variation;
  return {e.on_front ? "*" : "",
          is_variant(e) ? "" : v.technique->name,
          is_variant(e) ? "  " + v.variant : v.name(),
          fmt::format("{:.2f}", e.ms),
          cell(row.to_hbao_plus, "{:.2f}"),
          cell(row.to_own_floor, "{:.2f}"),
          cell(row.errors.rmse),
          cell(row.errors.bias, "{:+.4f}"),
          cell(l.t0w),
          cell(l.t1),
          cell(l.t2),
          cell(l.t12),
          cell(l.t3),
          cell(l.t4_bias),
          cell(l.t4_noise),
          cell(l.t5, "{:.0e}")};
}

/// "gtao medium: 12 more variants, 3.10 to 9.80 ms, RMSE 0.1500 to 0.1700".
std::string folded(const std::vector<Entry>& variants) {
  const auto by_time = [](const Entry& a, const Entry& b) { return a.ms < b.ms; };
  const auto by_error = [](const Entry& a, const Entry& b) { return a.row->errors.rmse < b.row->errors.rmse; };
  const auto [fast, slow] = std::minmax_element(variants.begin(), variants.end(), by_time);
  const auto [good, bad] = std::minmax_element(variants.begin(), variants.end(), by_error);
  const Variation& v = variants.front().row->variation;
  const std::string errors =
      good->row->errors.rmse ? fmt::format(", RMSE {:.4f} to {:.4f}", *good->row->errors.rmse, *bad->row->errors.rmse)
                             : "";
  return fmt::format("{} {}: {} more {}, {:.2f} to {:.2f} ms{}", v.technique->name, v.name(), variants.size(),
                     variants.size() == 1 ? "variant" : "variants", fast->ms, slow->ms, errors);
}

/// Adds all of a few variants of a preset; of many, those on the front.
void add_variants(const std::vector<Entry>& variants, Table& table) {
  std::vector<Entry> others;
  for (const Entry& e : variants) {
    if (variants.size() <= most_variants || e.on_front)
      table.rows.push_back(cells_of(e));
    else
      others.push_back(e);
  }
  if (!others.empty()) table.below.push_back(folded(others));
}

/// "courtyard", or "courtyard: indirect".
std::string title_of(const report::Scene& scene) {
  return scene.effect == "ao" ? scene.name : scene.name + ": " + scene.effect;
}

/// What there is without a technique takes no time.
std::vector<std::string> base_cells(const report::Scene& scene, size_t columns) {
  std::vector<std::string> cells(columns, "-");
  cells[0] = cells[2] = "";
  cells[1] = scene.base.name;
  cells[6] = cell(scene.base.rmse);
  cells[7] = cell(scene.base.bias, "{:+.4f}");
  return cells;
}

std::vector<Entry> entries_of(const Measurement& measurement, const report::Scene& scene) {
  std::vector<Entry> entries;
  for (const auto& row : measurement.rows) {
    if (row->scene == scene.name && row->effect == scene.effect) entries.push_back({row.get(), median(row->ms)});
  }
  set_times(entries);
  mark_front(entries);
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.time < b.time; });
  return entries;
}

}  // namespace

Table table_of_scene(const Measurement& measurement, const report::Scene& scene) {
  Table table{title_of(scene), {}, 3, {}};
  table.rows = {{"", "technique", "preset", "ms", "/hbao+", "/floor", "RMSE", "bias", "t0w model", "t1 screen",
                 "t2 hidden", "t12 both", "t3 noise", "t4 bias", "t4 noise", "t5"}};
  const std::vector<Entry> entries = entries_of(measurement, scene);
  std::vector<Entry> heads;
  for (const Entry& e : entries) {
    if (!is_variant(e)) heads.push_back(e);
  }
  for (const Entry& head : heads) {
    table.rows.push_back(cells_of(head));
    std::vector<Entry> variants;
    for (const Entry& e : entries) {
      if (is_variant(e) && same_preset(e, head)) variants.push_back(e);
    }
    add_variants(variants, table);
  }
  if (scene.base.rmse) table.rows.push_back(base_cells(scene, table.rows.front().size()));
  return table;
}

Table table_of_baselines(const Measurement& measurement, const report::Scene& scene) {
  Table table{title_of(scene) + ": what else computes the same, in ms", {}, 3, {}};
  table.rows = {{"technique", "preset", "part", "gloam", "naive", "ratio", "mean difference", "maximum", "copy floor"}};
  for (const Entry& e : entries_of(measurement, scene)) {
    const Row& row = *e.row;
    const Variation& v = row.variation;
    for (const AgainstNaive& part : row.against_naive) {
      table.rows.push_back({v.technique->name, v.variant.empty() ? v.name() : v.name() + ", " + v.variant, part.part,
                            fmt::format("{:.2f}", part.ms.median), fmt::format("{:.2f}", part.naive_ms.median),
                            fmt::format("{:.3f}", part.ratio), cell(part.mean_difference, "{:.1e}"),
                            cell(part.max_difference, "{:.1e}"), cell(row.copy_floor_ms, "{:.2f}")});
    }
    if (row.to_native)
      table.below.push_back(fmt::format("{} {}, the estimate: {:.2f} of the native loop's time", v.technique->name,
                                        v.name(), *row.to_native));
  }
  return table;
}

Table table_of_growth(const Measurement& measurement) {
  Table table{"Growth, without the filter: time is in proportion to x to the power of", {}, 2, {}};
  table.rows = {{"technique", "x", "exponent", "x from", "to", "ms from", "to"}};
  for (const Growth& growth : measurement.growth) {
    const GrowthPoint &first = growth.points.front(), &last = growth.points.back();
    table.rows.push_back({growth.technique, growth.over, cell(growth.exponent, "{:.2f}"),
                          fmt::format("{:.0f}", first.x), fmt::format("{:.0f}", last.x),
                          fmt::format("{:.2f}", first.ms), fmt::format("{:.2f}", last.ms)});
  }
  return table;
}

}  // namespace gloam::bench
