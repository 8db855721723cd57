// Confidence intervals of medians over rounds (docs/benchmarking.md, Intervals).
#pragma once

#include <optional>
#include <vector>

namespace gloam::bench {

/// Bounds of a figure.
struct Interval {
  double low = 0, high = 0;
};

/// The share of intervals that hold the true median.
constexpr double confidence = 0.95;

/// Fewer rounds have no interval at this confidence: the median lies outside the range of five with probability 1/16.
constexpr size_t fewest_rounds = 6;

/// How many rounds tell as much as one of independent rounds, at least 1: the integrated autocorrelation time of the ranks, with
/// the weights of Bartlett (Newey, West 1987) up to the square root of the number of rounds. Ranks, so that one round in which the
/// machine was busy weighs no more than any other.
double correlation_time(const std::vector<double>& rounds);

/// The interval of the median between order statistics (Conover 1999), interpolated between two ranks (Hettmansperger, Sheather
/// 1986): it supposes no distribution. For rounds that follow one another in level it is wider by the root of `correlation_time`.
/// None for fewer rounds than `fewest_rounds`, or where the wider interval would end beyond the least and the greatest round.
std::optional<Interval> interval_of_median(const std::vector<double>& rounds, double at = confidence);

/// The ratios a / b of each round. If one has more rounds, those at its end are left out.
std::vector<double> ratios_of_rounds(const std::vector<double>& a, const std::vector<double>& b);

/// Half the width of the interval of the median, relative to the median. None where there is no interval.
std::optional<double> relative_half_width(const std::vector<double>& rounds);

/// Whether there is an interval whose half width is at most `wanted` of the median: 0.01 is 1 %.
bool is_narrow_enough(const std::vector<double>& rounds, double wanted);

}  // namespace gloam::bench
