#include "report/levels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "base/statistics.h"
#include "report/student.h"

namespace gloam::report {
namespace {

/// From the median absolute deviation to the standard deviation, and from the standard error of a mean to that of a median, both of
/// normal noise.
constexpr double per_deviation = 1.4826, of_median = 1.2533;

/// No two runs of a build are nearer than this, however alike their rounds are.
constexpr double least_error = 0.003;

/// Few processes may agree by chance: beside their degrees of freedom the variance of the group's calmer rows counts for so many (Smyth
/// 2004). Calmer: a quarter of the rows are calmer still.
constexpr double freedom_of_usual = 1, share_of_calmer = 0.25;

/// Where errors are right, this share of unchanged rows, or of unchanged members, lies within so many of them.
constexpr double share_within = 0.95, errors_of_share = 1.96;
constexpr double members_within = 0.9, errors_of_members = 1.645;
/// Fewer others do not tell whether errors are right.
constexpr size_t fewest_others = 12, fewest_members = 4;
/// What errors are then multiplied by: for runs of one process each, and of several (docs/benchmarking.md).
constexpr double widened_of_one = 3.5, widened_of_several = 1.5;

/// The value that a share of the values is at most; between two of them in proportion.
double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double at = share * double(values.size() - 1);
  const size_t below = size_t(at), above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - double(below)) * (values[above] - values[below]);
}

double in_errors(const Change& c) { return std::fabs(c.value) / c.error; }

double variance_of_median(const std::vector<double>& logarithms, double middle) {
  std::vector<double> away;
  for (const double each : logarithms) away.push_back(std::fabs(each - middle));
  const double error = of_median * per_deviation * median(away) / std::sqrt(double(logarithms.size()));
  return error * error;
}

/// Degrees of freedom of the spread of a row's processes.
int freedom_of(const Change& c) { return c.from.processes + c.to.processes - 2; }

/// The variance of one process's median: by the processes, or by the rounds where these say more.
double variance_of_process(const Change& c) {
  const double by_rounds =
      (c.from.by_rounds * c.from.processes + c.to.by_rounds * c.to.processes) / (c.from.processes + c.to.processes);
  return freedom_of(c) == 0 ? by_rounds : std::max(by_rounds, (c.from.squares + c.to.squares) / freedom_of(c));
}

/// Rows that the machine disturbs alike have one variance, so that scenes add to what is known of it.
struct OfKind {
  double sum = 0, freedom = 0;
  int rows = 0;
};

/// How much wider errors have to be for the other members' rows of the group to lie within them as often as they should.
double widening_of(const std::vector<Change>& changes, const Change& change, const std::set<std::string>& changed) {
  std::vector<double> others;
  std::set<std::string> members;
  for (const Change& other : changes) {
    if (other.group != change.group || other.member == change.member || changed.count(other.member) > 0) continue;
    others.push_back(in_errors(other));
    members.insert(other.member);
  }
  if (others.size() < fewest_others || members.size() < fewest_members)
    return freedom_of(change) == 0 ? widened_of_one : widened_of_several;
  return std::max(1.0, quantile(std::move(others), share_within) / errors_of_share);
}

double probability(const Change& change) { return two_sided(in_errors(change), change.freedom); }

/// The changes of `all` at these places, the least probable first; how many of them differ.
size_t first_differing(const std::vector<Change>& all, std::vector<size_t>& places, double rate) {
  std::map<size_t, double> p;
  for (const size_t i : places) p[i] = probability(all[i]);
  std::sort(places.begin(), places.end(), [&](size_t a, size_t b) { return p[a] < p[b]; });
  size_t differing = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    if (p[places[i]] <= rate * double(i + 1) / double(places.size())) differing = i + 1;
  }
  return differing;
}

}  // namespace

Level level_of(const std::vector<double>& ratios, const std::vector<double>& processes) {
  std::vector<double> medians;
  Level level;
  size_t first = 0;
  for (const double count : processes.empty() ? std::vector<double>{double(ratios.size())} : processes) {
    const size_t end = std::min(first + size_t(std::max(count, 0.0)), ratios.size());
    std::vector<double> logarithms;
    for (size_t i = first; i < end; ++i) {
      if (ratios[i] > 0) logarithms.push_back(std::log(ratios[i]));
    }
    if (logarithms.size() < fewest_rounds_of_level) return {};
    medians.push_back(median(logarithms));
    level.by_rounds += variance_of_median(logarithms, medians.back());
    first = end;
  }
  level.processes = int(medians.size());
  level.by_rounds /= level.processes;
  level.mean = std::accumulate(medians.begin(), medians.end(), 0.0) / level.processes;
  for (const double each : medians) level.squares += (each - level.mean) * (each - level.mean);
  return level;
}

void add_errors(std::vector<Change>& changes, const std::set<std::string>& changed) {
  std::map<std::string, OfKind> kinds;
  for (const Change& c : changes) {
    OfKind& kind = kinds[c.kind];
    kind.sum += variance_of_process(c);
    kind.freedom += std::max(1, freedom_of(c));
    ++kind.rows;
  }
  const auto variance_of_kind = [&](const Change& c) { return kinds[c.kind].sum / kinds[c.kind].rows; };
  std::map<std::string, std::vector<double>> of_group;
  for (const Change& c : changes) of_group[c.group].push_back(variance_of_kind(c));
  for (Change& c : changes) {
    const double freedom = kinds[c.kind].freedom, usual = quantile(of_group[c.group], share_of_calmer);
    const double of_one = (freedom * variance_of_kind(c) + freedom_of_usual * usual) / (freedom + freedom_of_usual);
    c.value = c.to.mean - c.from.mean;
    c.error = std::max(least_error, std::sqrt(of_one * (1.0 / c.from.processes + 1.0 / c.to.processes)));
    c.freedom = freedom + freedom_of_usual;
  }
  std::map<std::pair<std::string, std::string>, double> widening;
  for (const Change& c : changes) {
    if (widening.count({c.group, c.member}) == 0) widening[{c.group, c.member}] = widening_of(changes, c, changed);
  }
  for (Change& c : changes) c.error *= widening[{c.group, c.member}];
}

double half_width(const Change& change) { return change.error * two_sided_limit(0.05, change.freedom); }

void find_differing(std::vector<Change>& changes, double rate) {
  std::vector<size_t> all(changes.size());
  std::iota(all.begin(), all.end(), size_t(0));
  const size_t differing = first_differing(changes, all, rate);
  for (size_t i = 0; i < differing; ++i) changes[all[i]].differs = true;
}

std::vector<Change> means_of_members(const std::vector<Change>& changes, const std::set<std::string>& changed) {
  std::vector<Change> means;
  std::map<std::string, std::vector<const Change*>> rows;
  for (const Change& c : changes) {
    if (rows[c.member].empty()) means.push_back({.member = c.member});
    rows[c.member].push_back(&c);
  }
  for (Change& mean : means) {
    double weights = 0;
    mean.freedom = rows[mean.member].front()->freedom;
    for (const Change* row : rows[mean.member]) {
      const double weight = 1 / (row->error * row->error);
      mean.value += weight * row->value;
      weights += weight;
      mean.freedom = std::min(mean.freedom, row->freedom);
    }
    mean.value /= weights;
    mean.error = 1 / std::sqrt(weights);
  }
  // Rows of a member are disturbed together, so that their mean is less sure than so many independent ones: the others' means tell.
  std::vector<double> widening(means.size());
  for (size_t i = 0; i < means.size(); ++i) {
    std::vector<double> others;
    for (size_t k = 0; k < means.size(); ++k) {
      if (k != i && changed.count(means[k].member) == 0) others.push_back(in_errors(means[k]));
    }
    // Where no others tell, all rows count as one.
    widening[i] = others.size() < fewest_members
                      ? std::sqrt(double(rows[means[i].member].size()))
                      : std::max(1.0, quantile(std::move(others), members_within) / errors_of_members);
  }
  for (size_t i = 0; i < means.size(); ++i) means[i].error *= widening[i];
  return means;
}

std::vector<Change> find_members(std::vector<Change>& changes, double rate) {
  constexpr int most_passes = 4;
  std::set<std::string> changed;
  std::vector<Change> means;
  for (int pass = 0; pass < most_passes; ++pass) {
    add_errors(changes, changed);
    means = means_of_members(changes, changed);
    find_differing(means, rate);
    const size_t known = changed.size();
    for (const Change& mean : means) {
      if (mean.differs) changed.insert(mean.member);
    }
    if (changed.size() == known) break;
  }
  return means;
}

void find_differing_of_members(std::vector<Change>& changes, const std::vector<Change>& means, double rate) {
  const double found =
      double(std::count_if(means.begin(), means.end(), [](const Change& mean) { return mean.differs; }));
  for (const Change& mean : means) {
    if (!mean.differs) continue;
    std::vector<size_t> rows;
    for (size_t i = 0; i < changes.size(); ++i) {
      if (changes[i].member == mean.member) rows.push_back(i);
    }
    const size_t differing = first_differing(changes, rows, rate * found / double(means.size()));
    for (size_t i = 0; i < differing; ++i) changes[rows[i]].differs = true;
  }
}

}  // namespace gloam::report
