// The least value of a function of one number.
#pragma once

namespace gloam {

/// Where `value_at` is least between two numbers, if it has one minimum there: each step leaves 0.618 of the interval.
template <typename Function>
double least_between(double low, double high, int steps, const Function& value_at) {
  constexpr double golden = 0.6180339887498949;  // (sqrt 5 - 1) / 2
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double at_a = value_at(a), at_b = value_at(b);
  for (int i = 0; i < steps; ++i) {  // of the two places inside, one stays
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - golden * (high - low);
      if (i + 1 < steps) at_a = value_at(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + golden * (high - low);
      if (i + 1 < steps) at_b = value_at(b);
    }
  }
  return 0.5 * (low + high);
}

}  // namespace gloam
