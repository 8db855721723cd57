// What is measured first where the time is limited.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <vector>

#include "base/elapsed.h"
#include "measure/plans.h"

namespace gloam::bench {

/// A limit on the time of a measurement. Copies share neither clock time nor extensions: a part of a limit ends by itself.
class TimeLimit {
 public:
  using Clock = std::function<double()>;  ///< seconds since any moment

  TimeLimit() = default;  ///< none
  explicit TimeLimit(double seconds, Clock clock = {});

  bool is_set() const { return bool(clock_); }
  /// Seconds; infinite without a limit, below 0 once it is over.
  double left() const;
  bool is_over() const { return left() <= 0; }
  /// Whether something that takes this long is done in time.
  bool allows(double seconds) const { return seconds <= left(); }
  /// A limit of a share of what is left.
  TimeLimit part(double share) const;
  /// Adds what took time and does not count.
  void extend(double seconds) { end_ += seconds; }

 private:
  Clock clock_;
  double end_ = 0;
};

/// How long a thing takes that is done again and again: as long as the longest so far, and a quarter more.
class Expected {
 public:
  explicit Expected(double seconds) : seconds_(seconds) {}
  /// Does the work if it is expected to end in time; says whether it has.
  template <typename Work>
  bool done_within(const TimeLimit& limit, const Work& work) {
    if (!limit.allows(1.25 * seconds_)) return false;
    const auto start = std::chrono::steady_clock::now();
    work();
    seconds_ = has_begun_ ? std::max(seconds_, seconds_since(start)) : seconds_since(start);
    has_begun_ = true;
    return true;
  }

 private:
  double seconds_;
  bool has_begun_ = false;
};

/// A setting after one run.
struct FirstLook {
  double ms = 0;
  std::optional<double> error;  ///< none without a truth
};

/// A setting whose time may still turn out to be on the front after one run: no other is as near to the truth in less than this share
/// of its time.
constexpr double near_front_share = 0.75;

/// How many times the time of the fastest setting that is as near to the truth a setting takes, at least 1. Errors are exact, times are
/// those of one run. 1 without errors.
std::vector<double> distances_to_front(const std::vector<FirstLook>& looks);

/// Indices of the settings in the order in which they are looked at first: one preset of each technique, `preset` if there is one.
std::vector<size_t> first_looks(const std::vector<Variation>& variations, const std::string& preset);

/// Indices of all others, those of techniques near the front first, lower resolutions before further presets, other precisions last.
/// `distance_of`: of the technique of a variation, by what was looked at.
std::vector<size_t> later_looks(const std::vector<Variation>& variations, const std::vector<size_t>& first,
                                const std::function<double(const Variation&)>& distance_of);

/// "1m 30s", "42 s".
std::string time_words(double seconds);

}  // namespace gloam::bench
