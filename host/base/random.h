// Random numbers that are the same on every machine for the same seed: the distributions of <random> are each library's own.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>

namespace gloam {

/// SplitMix64 (Steele, Lea, Flood 2014).
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  /// Each pair of seed and number gives a sequence of its own.
  Random(uint64_t seed, uint64_t number) : state_(seed * 0x100000001b3u + number) {}

  uint64_t next() {
    uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  /// 0 to n - 1; 0 for none.
  size_t below(size_t n) { return n == 0 ? 0 : size_t(next() % n); }
  /// Both ends included.
  int between(int low, int high) { return low + int(below(size_t(high - low) + 1)); }
  /// `low` to `high`.
  double uniform(double low, double high) { return low + (high - low) * double(next() >> 11) * 0x1p-53; }
  /// `low` to `high`, with a uniform logarithm.
  double of_any_size(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  bool one_in(size_t n) { return below(n) == 0; }
  template <typename List>
  const auto& pick(const List& list) {
    return *std::next(std::begin(list), std::ptrdiff_t(below(std::size(list))));
  }
  template <typename T>
  T pick(std::initializer_list<T> list) {
    return *std::next(list.begin(), std::ptrdiff_t(below(list.size())));
  }

 private:
  uint64_t state_;
};

}  // namespace gloam
