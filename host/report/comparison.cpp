#include "report/comparison.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/lists.h"
#include "base/statistics.h"
#include "gloam/error.h"
#include "report/conditions.h"
#include "report/levels.h"

namespace gloam::report {
namespace {

constexpr const char *hbao_plus = "hbao+ medium", *gather_floor = "the gather floor";
constexpr const char* technique_of_reference = "hbao+";

/// From this on, all other techniques together show that the reference changed, where the gather floor shows at least half of it.
constexpr double reference_moved = 0.03, most_of_spread = 5;

RowName row_name(const Row& row) {
  const std::string size = row.width && row.height ? fmt::format("{:.0f}x{:.0f}", *row.width, *row.height) : "";
  return {row.technique, row.preset, row.variant, row.scene, row.effect, size};
}

/// A row of both files.
struct Pair {
  const Row *from = nullptr, *to = nullptr;
};

using RowsByName = std::map<RowName, const Row*>;

RowsByName rows_by_name(const Source& source) {
  RowsByName rows;
  for (const Row& row : source.measurements.rows) {
    if (!rows.emplace(row_name(row), &row).second)
      throw Error("{}: holds {} twice; compare files of one run each", source.name, words(row_name(row)));
  }
  return rows;
}

std::vector<Pair> pairs_of(const Source& first, const Source& second, Comparison& result) {
  const RowsByName of_first = rows_by_name(first), of_second = rows_by_name(second);
  std::vector<Pair> pairs;
  for (const Row& row : first.measurements.rows) {
    const auto other = of_second.find(row_name(row));
    if (other != of_second.end())
      pairs.push_back({&row, other->second});
    else
      result.only_in_first.push_back(row_name(row));
  }
  for (const Row& row : second.measurements.rows) {
    if (of_first.count(row_name(row)) == 0) result.only_in_second.push_back(row_name(row));
  }
  return pairs;
}

/// The rounds that are compared.
using Rounds = std::vector<double> RoundRatios::*;

bool has_cpu(const std::vector<Pair>& pairs) {
  return !pairs.empty() && std::all_of(pairs.begin(), pairs.end(), [](const Pair& p) {
    return !p.from->hbao_plus_rounds.cpu.empty() && !p.to->hbao_plus_rounds.cpu.empty();
  });
}

/// The change of a row's ratio; none where a run has too few rounds of it.
std::optional<Change> change_of(const Pair& pair, RoundRatios Row::*to, Rounds of) {
  Change change;
  change.group = pair.from->scene;
  change.member = pair.from->technique;
  const Row& row = *pair.from;
  change.kind = fmt::format("{}/{}/{}/{}", row.technique, row.preset, row.variant, row.effect);
  change.from = level_of(pair.from->*to.*of, pair.from->processes);
  change.to = level_of(pair.to->*to.*of, pair.to->processes);
  if (change.from.processes == 0 || change.to.processes == 0) return {};
  return change;
}

/// Changes of pairs, by the pair's index.
struct Changes {
  std::vector<Change> changes;
  std::vector<size_t> pairs;
};

Changes changes_of(const std::vector<Pair>& pairs, RoundRatios Row::*to, Rounds of) {
  Changes found;
  for (size_t i = 0; i < pairs.size(); ++i) {
    const std::optional<Change> change = change_of(pairs[i], to, of);
    if (!change) continue;
    found.changes.push_back(*change);
    found.pairs.push_back(i);
  }
  add_errors(found.changes);
  return found;
}

/// How HBAO+ medium moved against the gather floor: the mean over scenes.
Number change_of_reference(const std::vector<Pair>& pairs, Rounds of) {
  std::map<std::string, std::vector<double>> by_scene;
  for (const Pair& pair : pairs) {
    const std::optional<Change> reference = change_of(pair, &Row::hbao_plus_rounds, of);
    const std::optional<Change> floor = change_of(pair, &Row::gather_floor_rounds, of);
    if (!reference || !floor) continue;
    by_scene[pair.from->scene].push_back(floor->to.mean - floor->from.mean - reference->to.mean + reference->from.mean);
  }
  if (by_scene.empty()) return {};
  double sum = 0;
  for (const auto& [scene, values] : by_scene) sum += median(values);
  return sum / double(by_scene.size());
}

/// How the other techniques moved together.
struct Others {
  double middle = 0, spread = 0;  ///< the median over techniques, and the median distance from it
};

/// Empty for few techniques, which say nothing of the reference.
std::optional<Others> others_of(const std::vector<Change>& changes) {
  constexpr size_t fewest = 4;
  std::vector<double> values;
  for (const Change& mean : means_of_members(changes)) {
    if (mean.member != technique_of_reference) values.push_back(mean.value);
  }
  if (values.size() < fewest) return {};
  Others others{median(values)};
  for (double& value : values) value = std::fabs(value - others.middle);
  others.spread = median(values);
  return others;
}

/// Whether all other techniques moved by the same, and HBAO+ the other way against the floor. A busy machine moves each by another
/// amount.
bool reference_changed(const std::optional<Others>& others, const Number& against_floor) {
  if (!others || !against_floor || std::fabs(others->middle) < reference_moved) return false;
  return others->spread < std::fabs(others->middle) / most_of_spread && *against_floor * others->middle < 0 &&
         std::fabs(*against_floor) > std::fabs(others->middle) / 2;
}

RelativeChange relative(const Change& change) {
  const double half = half_width(change);
  return {std::expm1(change.value), std::expm1(change.value - half), std::expm1(change.value + half)};
}

TimeVerdict verdict_on(const Change& change, double margin) {
  if (change.differs) return change.value < 0 ? TimeVerdict::faster : TimeVerdict::slower;
  const RelativeChange bounds = relative(change);
  return bounds.low >= -margin && bounds.high <= margin ? TimeVerdict::same : TimeVerdict::too_noisy;
}

/// Half the width of the usual interval of each scene.
void add_widths(const std::vector<Change>& changes, Comparison& result) {
  std::vector<std::string> scenes;
  for (const Change& change : changes) add_new(scenes, change.group);
  for (const std::string& scene : scenes) {
    std::vector<double> widths;
    for (const Change& change : changes) {
      if (change.group == scene) widths.push_back(half_width(change));
    }
    result.widths.emplace_back(scene, median(widths));
  }
}

void compare_times(const std::vector<Pair>& pairs, const Conditions& conditions, Comparison& result) {
  if (!conditions.have_rounds) return;
  std::vector<Pair> comparable;
  std::vector<size_t> rows;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (!result.rows[i].is_same_work) continue;
    comparable.push_back(pairs[i]);
    rows.push_back(i);
  }
  result.by_cpu = has_cpu(comparable);
  const Rounds of = result.by_cpu ? &RoundRatios::cpu : &RoundRatios::ms;
  RoundRatios Row::*to = &Row::hbao_plus_rounds;
  Changes found = changes_of(comparable, to, of);
  result.reference = hbao_plus;
  result.reference_change = change_of_reference(comparable, of);
  const std::optional<Others> others = others_of(found.changes);
  if (others) result.others_change = others->middle;
  if (reference_changed(others, result.reference_change)) {
    to = &Row::gather_floor_rounds;
    found = changes_of(comparable, to, of);
    result.reference = gather_floor;
  }
  const std::vector<Change> means = find_members(found.changes, result.options.rate_of_techniques);
  find_differing(found.changes, result.options.rate);
  find_differing_of_members(found.changes, means, result.options.rate_of_found);
  for (size_t i = 0; i < found.changes.size(); ++i) {
    ComparedRow& row = result.rows[rows[found.pairs[i]]];
    const Pair& pair = comparable[found.pairs[i]];
    row.change = relative(found.changes[i]);
    row.ratio_from = median_of(pair.from->*to.*of);
    row.ratio_to = median_of(pair.to->*to.*of);
    row.time = verdict_on(found.changes[i], result.options.margin);
  }
  add_widths(found.changes, result);
  for (const Change& mean : means) {
    const auto is_of = [&](const Change& change) { return change.member == mean.member; };
    result.techniques.push_back({mean.member, size_t(std::count_if(found.changes.begin(), found.changes.end(), is_of)),
                                 verdict_on(mean, result.options.margin), relative(mean)});
  }
}

void compare_errors(const std::vector<Pair>& pairs, const Conditions& conditions, Comparison& result) {
  for (size_t i = 0; i < pairs.size(); ++i) {
    const Pair& pair = pairs[i];
    ComparedRow& row = result.rows[i];
    row.rmse_from = pair.from->rmse_to_truth;
    row.rmse_to = pair.to->rmse_to_truth;
    if (!row.rmse_from || !row.rmse_to || contains(conditions.other_truth, pair.from->scene)) continue;
    const double change = *row.rmse_to - *row.rmse_from;
    if (std::fabs(change) <= result.tolerance.relative * *row.rmse_from)
      row.error = ErrorVerdict::same;
    else
      row.error = change < 0 ? ErrorVerdict::nearer : ErrorVerdict::farther;
  }
}

std::string percent_of(double logarithm) { return fmt::format("{:+.1f} %", 100 * std::expm1(logarithm)); }

void add_notes_on_reference(Comparison& c) {
  if (c.reference == gather_floor)
    c.notes.push_back(
        fmt::format("hbao+ medium itself changed: {} against the gather floor, and the other techniques together {} "
                    "against it; times are compared with the gather floor, which varies more",
                    percent_of(*c.reference_change), percent_of(*c.others_change)));
}

OnDevice on_device(const Row& row) {
  OnDevice result{row.ms.median, ""};
  const auto longest = std::max_element(row.passes.begin(), row.passes.end(),
                                        [](const Pass& a, const Pass& b) { return a.ms.median < b.ms.median; });
  if (longest != row.passes.end() && longest->bound) result.bound = longest->bound->by;
  return result;
}

}  // namespace

Number median_of(const std::vector<double>& values) { return values.empty() ? Number() : Number(median(values)); }

std::string words(const RowName& name) {
  const std::string variant = name.variant.empty() ? "" : ", " + name.variant;
  return fmt::format("{} {}{} on {}", name.technique, name.preset, variant, name.scene);
}

const char* name_of(TimeVerdict verdict) {
  switch (verdict) {
    case TimeVerdict::faster:
      return "faster";
    case TimeVerdict::slower:
      return "slower";
    case TimeVerdict::same:
      return "same";
    case TimeVerdict::too_noisy:
      return "too noisy to tell";
    default:
      return "not compared";
  }
}

const char* name_of(ErrorVerdict verdict) {
  switch (verdict) {
    case ErrorVerdict::nearer:
      return "nearer";
    case ErrorVerdict::farther:
      return "farther";
    case ErrorVerdict::same:
      return "same";
    default:
      return "not compared";
  }
}

Comparison compare(const Source& first, const Source& second, const CompareOptions& options) {
  Comparison result;
  result.options = options;
  const Conditions conditions = conditions_of(first, second);
  result.notes = conditions.notes;
  result.tolerance = {conditions.error_tolerance, conditions.one_device};
  const std::vector<Pair> pairs = pairs_of(first, second, result);
  if (pairs.empty())
    throw Error(
        "{} and {}: share no row; a row is a technique, preset and variant on a scene and its size: measure "
        "the same ones, as gloam bench --baseline {} does",
        first.name, second.name, first.name);
  for (const Pair& pair : pairs)
    result.rows.push_back({.name = row_name(*pair.from),
                           .from = on_device(*pair.from),
                           .to = on_device(*pair.to),
                           .is_same_work = !contains(conditions.other_radius, pair.from->scene)});
  compare_times(pairs, conditions, result);
  compare_errors(pairs, conditions, result);
  add_notes_on_reference(result);
  return result;
}

}  // namespace gloam::report
