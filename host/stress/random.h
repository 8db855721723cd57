// Random numbers that are the same on every machine: the distributions of <random> are each library's own.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace gloam::stress {

class Random {
 public:
  /// Another sequence for each pair.
  Random(uint32_t seed, uint32_t number) {
    std::seed_seq sequence{seed, number};
    engine_.seed(sequence);
  }
  uint32_t bits() { return uint32_t(engine_()); }
  /// 0 to count - 1.
  int below(int count) { return int(bits() % uint32_t(count)); }
  /// 0 to 1, without 1.
  double uniform() { return double(bits()) * 0x1p-32; }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  /// Even over the powers of ten.
  double of_any_size(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  bool one_in(int count) { return below(count) == 0; }
  template <typename T>
  const T& of(const std::vector<T>& choices) {
    return choices[size_t(below(int(choices.size())))];
  }

 private:
  std::mt19937 engine_;
};

}  // namespace gloam::stress
