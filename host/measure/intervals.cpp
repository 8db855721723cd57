#include "measure/intervals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/statistics.h"

namespace gloam::bench {
namespace {

/// The rank of each round, from 0; rounds of equal time share the mean of their ranks.
std::vector<double> ranks_of(const std::vector<double>& rounds) {
  std::vector<size_t> order(rounds.size());
  std::iota(order.begin(), order.end(), size_t(0));
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return rounds[a] < rounds[b]; });
  std::vector<double> ranks(rounds.size());
  for (size_t first = 0, end = 0; first < order.size(); first = end) {
    for (end = first + 1; end < order.size() && rounds[order[end]] == rounds[order[first]];) ++end;
    for (size_t i = first; i < end; ++i) ranks[order[i]] = double(first + end - 1) / 2;
  }
  return ranks;
}

/// The probability that the median of independent rounds lies between the d-th least and the d-th greatest.
double coverage(size_t rounds, size_t d) {
  const double n = double(rounds);
  double below = 0;  // of fewer than d rounds on one side
  for (size_t k = 0; k < d; ++k)
    below +=
        std::exp(std::lgamma(n + 1) - std::lgamma(double(k) + 1) - std::lgamma(n - double(k) + 1) - n * std::log(2.0));
  return 1 - 2 * below;
}

/// The rank, from 1, at which the interval begins; between two ranks for the confidence asked for. None: the range is too narrow.
std::optional<double> first_rank(size_t n, double at) {
  size_t d = 1;
  if (coverage(n, d) < at) return {};
  while (2 * (d + 1) <= n && coverage(n, d + 1) >= at) ++d;
  const double wide = coverage(n, d), narrow = coverage(n, d + 1);
  const double share = (wide - at) / (wide - narrow);
  return double(d) + double(n - d) * share / (double(d) + double(n - 2 * d) * share);
}

double at_rank(const std::vector<double>& sorted, double rank) {
  const size_t below = size_t(rank) - 1, above = std::min(below + 1, sorted.size() - 1);
  const double share = rank - std::floor(rank);
  return (1 - share) * sorted[below] + share * sorted[above];
}

}  // namespace

double correlation_time(const std::vector<double>& rounds) {
  const size_t n = rounds.size();
  std::vector<double> ranks = ranks_of(rounds);
  const double mean = (double(n) - 1) / 2;
  double variance = 0, time = 1;
  for (double& rank : ranks) {
    rank -= mean;
    variance += rank * rank;
  }
  if (variance == 0) return 1;
  const size_t furthest = std::max(size_t(1), size_t(std::lround(std::sqrt(double(n)))));
  for (size_t apart = 1; apart <= furthest && apart < n; ++apart) {
    double sum = 0;
    for (size_t i = apart; i < n; ++i) sum += ranks[i] * ranks[i - apart];
    // Independent rounds have an estimate of -1/n on average, because the mean is their own.
    const double correlation = sum / variance + 1 / double(n);
    time += 2 * (1 - double(apart) / double(furthest + 1)) * correlation;
  }
  return std::max(1.0, time);
}

std::optional<Interval> interval_of_median(const std::vector<double>& rounds, double at) {
  const size_t n = rounds.size();
  if (n == 0) return {};
  const std::optional<double> rank = first_rank(n, at);
  if (!rank) return {};
  const double middle = (double(n) + 1) / 2, low = middle - (middle - *rank) * std::sqrt(correlation_time(rounds));
  if (low < 1) return {};
  std::vector<double> sorted = rounds;
  std::sort(sorted.begin(), sorted.end());
  return Interval{at_rank(sorted, low), at_rank(sorted, double(n) + 1 - low)};
}

std::vector<double> ratios_of_rounds(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios(std::min(a.size(), b.size()));
  for (size_t i = 0; i < ratios.size(); ++i) ratios[i] = a[i] / b[i];
  return ratios;
}

std::optional<double> relative_half_width(const std::vector<double>& rounds) {
  const std::optional<Interval> interval = interval_of_median(rounds);
  if (!interval) return {};
  return (interval->high - interval->low) / 2 / std::fabs(median(rounds));
}

bool is_narrow_enough(const std::vector<double>& rounds, double wanted) {
  const std::optional<double> half = relative_half_width(rounds);
  return half && *half <= wanted;
}

}  // namespace gloam::bench
