#include "measure/schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace gloam::bench {
namespace {

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// How much later a setting is looked at, in doublings of the distance to the front. Lower resolutions are looked at soon: they take a part of
/// the time and run kernels that are compiled already, where each preset has kernels of its own.
double delay_of(const Variation& v) {
  if (v.variant.empty()) return 0.3;
  const bool is_lower = (v.resolution == 2 && v.variant == "half") || (v.resolution == 4 && v.variant == "quarter");
  if (is_lower) return 0;
  return v.math == Math::fast && v.real == Real::float32 && v.storage == Storage::float32
             ? 0.5
             : 3;  // swept, or another precision
}

}  // namespace

TimeLimit::TimeLimit(double seconds, Clock clock) : clock_(clock ? std::move(clock) : Clock(steady_seconds)) {
  end_ = clock_() + seconds;
}

double TimeLimit::left() const { return clock_ ? end_ - clock_() : std::numeric_limits<double>::infinity(); }

TimeLimit TimeLimit::part(double share) const {
  return clock_ ? TimeLimit(std::max(0.0, share * left()), clock_) : TimeLimit();
}

std::vector<double> distances_to_front(const std::vector<FirstLook>& looks) {
  std::vector<double> distances(looks.size(), 1);
  for (size_t i = 0; i < looks.size(); ++i) {
    double least = looks[i].ms;
    for (const FirstLook& other : looks) {
      if (looks[i].error && other.error && *other.error <= *looks[i].error) least = std::min(least, other.ms);
    }
    if (least > 0) distances[i] = looks[i].ms / least;
  }
  return distances;
}

std::vector<size_t> first_looks(const std::vector<Variation>& variations, const std::string& preset) {
  std::vector<const Technique*> known;
  std::vector<size_t> first;
  for (const bool only_base : {true, false}) {
    for (size_t i = 0; i < variations.size(); ++i) {
      const Variation& v = variations[i];
      if (std::find(known.begin(), known.end(), v.technique) != known.end() ||
          (only_base && !(v.variant.empty() && v.preset == preset)))
        continue;
      known.push_back(v.technique);
      first.push_back(i);
    }
  }
  return first;
}

std::vector<size_t> later_looks(const std::vector<Variation>& variations, const std::vector<size_t>& first,
                                const std::function<double(const Variation&)>& distance_of) {
  std::vector<std::pair<double, size_t>> later;
  for (size_t i = 0; i < variations.size(); ++i) {
    if (std::find(first.begin(), first.end(), i) != first.end()) continue;
    later.emplace_back(std::log2(std::max(1.0, distance_of(variations[i]))) + delay_of(variations[i]), i);
  }
  std::stable_sort(later.begin(), later.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<size_t> order;
  for (const auto& [key, index] : later) order.push_back(index);
  return order;
}

std::string time_words(double seconds) {
  const long long whole = std::llround(std::max(0.0, seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole % 60 == 0) return fmt::format("{} min", whole / 60);
  return fmt::format("{} min {} s", whole / 60, whole % 60);
}

}  // namespace gloam::bench
