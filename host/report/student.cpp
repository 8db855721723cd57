#include "report/student.h"

#include <cmath>

namespace gloam::report {
namespace {

/// The continued fraction of the incomplete beta function (DLMF 8.17.22), by the method of Lentz.
double fraction(double a, double b, double x) {
  constexpr int most_terms = 300;
  constexpr double converged = 1e-14;
  double c = 1, d = 1 / (1 - (a + b) * x / (a + 1)), product = d;
  for (int m = 1; m <= most_terms; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1 / (1 + even * d);
    c = 1 + even / c;
    product *= c * d;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / (1 + odd * d);
    c = 1 + odd / c;
    product *= c * d;
    if (std::fabs(c * d - 1) < converged) break;
  }
  return product;
}

/// The regularised incomplete beta function.
double incomplete_beta(double a, double b, double x) {
  if (x <= 0 || x >= 1) return x <= 0 ? 0 : 1;
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
  return x < (a + 1) / (a + b + 2) ? front * fraction(a, b, x) / a : 1 - front * fraction(b, a, 1 - x) / b;
}

}  // namespace

double two_sided(double t, double freedom) { return incomplete_beta(freedom / 2, 0.5, freedom / (freedom + t * t)); }

double two_sided_limit(double probability, double freedom) {
  double low = 0, high = 1;
  while (two_sided(high, freedom) > probability) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (two_sided(middle, freedom) > probability ? low : high) = middle;
  }
  return high;
}

}  // namespace gloam::report
