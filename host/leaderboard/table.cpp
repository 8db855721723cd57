#include "leaderboard/table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "base/lists.h"
#include "gloam/error.h"
#include "page/submitted.h"

namespace gloam::leaderboard {
namespace {

using report::Measurements;
using report::Scene;

/// What makes rows those of one entry.
using EntryKey = std::tuple<bool, std::string, std::string, std::string, std::string, std::string>;

EntryKey key_of(const Entry& e) { return {e.is_submitted, e.technique, e.preset, e.variant, e.device, e.driver}; }

Entry entry_of(const Row& row, const Measurements& m) {
  Entry entry;
  entry.technique = row.technique;
  entry.preset = row.preset;
  entry.variant = row.variant;
  entry.reads = row.reads;
  entry.is_submitted = !row.submitted.is_null();
  entry.device = entry.is_submitted ? report::facts_of(row.submitted).device : m.device;
  entry.driver = entry.is_submitted ? "" : m.driver;
  return entry;
}

/// Fills one effect's items and entries from file after file.
class Filling {
 public:
  Filling(EffectTable& table, const Results& results) : table_(table), results_(results) {}

  void add(size_t file) {
    const Measurements& m = results_.files[file].measurements;
    for (const Scene& scene : m.scenes) {
      if (scene.effect == table_.effect) add(scene, file);
    }
    for (const auto* rows : {&m.rows, &m.submitted}) {
      for (const Row& row : *rows) {
        if (row.effect == table_.effect) add(row, m, file);
      }
    }
  }

 private:
  std::string path(size_t file) const { return results_.files[file].file.string(); }

  void add(const Scene& scene, size_t file) {
    const auto [known, is_new] = item_of_.emplace(scene.name, table_.items.size());
    if (is_new)
      table_.items.push_back({scene.title, scene.kind, scene.own_class, scene.width, scene.height, scene.radius,
                              scene.truth_noise, scene.white, file, scene.truth_image});
    Item& item = table_.items[known->second];
    check_same(item.width, scene.width, "width", item, file);
    check_same(item.height, scene.height, "height", item, file);
    check_same(item.radius, scene.radius, "radius", item, file);
    if (item.truth_image.empty() && !scene.truth_image.empty())
      std::tie(item.file, item.truth_image) = std::pair(file, scene.truth_image);
    if (item.kind.empty()) item.kind = scene.kind;
  }

  void check_same(const Number& before, const Number& now, const char* what, const Item& item, size_t file) const {
    if (!before || !now || std::abs(*before - *now) <= 1e-4 * std::abs(*now)) return;
    throw Error("{}: '{}' has the {} {:g}, and {:g} in {}: not the same frame; leave one of the two files out",
                path(file), item.name, what, *now, *before, path(item.file));
  }

  void add(const Row& row, const Measurements& m, size_t file) {
    const Entry made = entry_of(row, m);
    const auto [known, is_new] = entry_of_.emplace(key_of(made), table_.entries.size());
    if (is_new) table_.entries.push_back(made);
    const size_t item = item_of_.at(row.scene);
    const auto [before, is_first] = file_of_.emplace(std::pair(known->second, item), file);
    if (!is_first && before->second == file) return;  // measured twice in one run: the first counts, as in the report
    if (!is_first)
      throw Error("{}: {} on '{}'{} is also in {}; leave one of the two files out", path(file),
                  fmt::format("{}{}{}", row.technique, row.preset.empty() ? "" : " " + row.preset,
                              row.variant.empty() ? "" : ", " + row.variant),
                  table_.items[item].name, made.device.empty() ? "" : " on " + made.device, path(before->second));
    table_.entries[known->second].rows.emplace_back(item, &row);
  }

  EffectTable& table_;
  const Results& results_;
  std::map<std::string, size_t> item_of_;
  std::map<EntryKey, size_t> entry_of_;
  std::map<std::pair<size_t, size_t>, size_t> file_of_;
};

// --- Means

/// Items of a choice on which any entry has each figure.
std::array<std::set<size_t>, figure_count> measured_items(const EffectTable& table, const std::set<size_t>& items) {
  std::array<std::set<size_t>, figure_count> measured;
  for (const Entry& entry : table.entries) {
    for (const auto& [item, row] : entry.rows) {
      if (!items.contains(item)) continue;
      const Figures figures = figures_of(*row);
      for (size_t f = 0; f < figure_count; ++f) {
        if (figures[f]) measured[f].insert(item);
      }
    }
  }
  // A fit is compared with what it fits; stated times with nothing of gloam's.
  measured[fit_error] = measured[stated_ms] = measured[whole_ratio] = measured[error];
  measured[fit_ssim] = measured[ssim];
  measured[fit_flip] = measured[flip];
  return measured;
}

Choice choice_over(const EffectTable& table, const std::string& what, const std::string& name,
                   const std::set<size_t>& items) {
  const auto measured = measured_items(table, items);
  Choice choice{what, name, {measured[error].begin(), measured[error].end()}, {}};
  for (size_t e = 0; e < table.entries.size(); ++e) {
    TableRow made{e, 0, {}};
    std::array<size_t, figure_count> counts{};
    Figures sums;
    for (const auto& [item, row] : table.entries[e].rows) {
      const Figures figures = figures_of(*row);
      for (size_t f = 0; f < figure_count; ++f) {
        if (!figures[f] || !measured[f].contains(item)) continue;
        sums[f] = sums[f].value_or(0) + *figures[f];
        ++counts[f];
      }
    }
    made.items = counts[error];
    for (size_t f = 0; f < figure_count; ++f) {
      if (counts[f] > 0 && counts[f] == measured[f].size()) made.means[f] = *sums[f] / double(counts[f]);
    }
    if (made.items > 0) choice.rows.push_back(made);
  }
  return choice;
}

/// All items, then each kind and each class of single frames where there are several. Pairs of eyes and displays would leave most
/// methods of a class without means, since other techniques compute them.
std::vector<Choice> choices_of(const EffectTable& table) {
  std::set<size_t> all;
  std::vector<std::string> kinds, classes;
  for (size_t i = 0; i < table.items.size(); ++i) {
    all.insert(i);
    if (!table.items[i].kind.empty()) add_new(kinds, table.items[i].kind);
  }
  const auto is_single = [&](const Item& item) { return kinds.size() < 2 || item.kind == "frame"; };
  for (const Item& item : table.items) {
    if (!item.item_class.empty() && is_single(item)) add_new(classes, item.item_class);
  }
  std::vector<Choice> choices{choice_over(table, "all", "", all)};
  const auto add_each = [&](const char* what, const std::vector<std::string>& names, std::string Item::*field,
                            const auto& counts) {
    for (const std::string& name : names) {
      std::set<size_t> items;
      for (const size_t i : all) {
        if (table.items[i].*field == name && counts(table.items[i])) items.insert(i);
      }
      if (Choice choice = choice_over(table, what, name, items); !choice.items.empty() && names.size() > 1)
        choices.push_back(std::move(choice));
    }
  };
  add_each("kind", kinds, &Item::kind, [](const Item&) { return true; });
  add_each("class", classes, &Item::item_class, is_single);
  return choices;
}

void add_stability(EffectTable& table, const Results& results) {
  std::map<std::pair<std::string, std::string>, std::string> file_of;
  for (const Stability& each : results.stability) {
    for (const auto& [technique, held] : each.techniques) {
      const auto [before, is_new] = file_of.emplace(std::pair(each.device, technique), each.file);
      if (!is_new)
        throw Error("{}: hard cases of {} on {} are also in {}; leave one of the two files out", each.file, technique,
                    each.device, before->second);
      for (Entry& entry : table.entries) {
        if (!entry.is_submitted && entry.technique == technique && entry.device == each.device) entry.stability = held;
      }
    }
  }
}

}  // namespace

const std::array<const char*, figure_count>& figure_names() {
  static const std::array<const char*, figure_count> names{"error",    "bias",     "ssim",      "flip",
                                                           "ratio",    "flicker",  "eyes",      "fit_error",
                                                           "fit_ssim", "fit_flip", "stated_ms", "whole_ratio"};
  return names;
}

Figures figures_of(const Row& row) {
  Figures figures;
  figures[error] = row.rmse_to_truth;
  figures[bias] = row.bias;
  figures[ssim] = row.ssim;
  figures[flip] = row.flip;
  figures[flicker] = row.flicker;
  figures[eyes] = row.inconsistency;
  if (row.submitted.is_null()) {
    figures[ratio] = row.ratio_to_hbao_plus;
    return figures;
  }
  const report::SubmittedFacts facts = report::facts_of(row.submitted);
  figures[fit_error] = facts.fit_rmse;
  figures[fit_ssim] = facts.fit_ssim;
  figures[fit_flip] = facts.fit_flip;
  figures[stated_ms] = facts.stated_ms;
  figures[whole_ratio] = facts.whole_ratio;
  return figures;
}

std::vector<EffectTable> tables_of(const Board& board, const Results& results) {
  std::vector<std::string> effects;
  for (const size_t file : board.files) {
    const Measurements& m = results.files[file].measurements;
    for (const auto* rows : {&m.rows, &m.submitted}) {
      for (const Row& row : *rows) add_new(effects, row.effect);
    }
  }
  std::stable_partition(effects.begin(), effects.end(), [](const std::string& effect) { return effect == "ao"; });
  std::vector<EffectTable> tables;
  for (const std::string& effect : effects) {
    EffectTable table{effect, {}, {}, {}};
    Filling filling(table, results);
    for (const size_t file : board.files) filling.add(file);
    add_stability(table, results);
    table.choices = choices_of(table);
    tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace gloam::leaderboard
