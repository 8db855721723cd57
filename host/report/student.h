// Student's distribution.
#pragma once

namespace gloam::report {

/// The probability of a value at least as far from 0 as `t`, on either side.
double two_sided(double t, double freedom);

/// The value that is exceeded with this probability, on either side.
double two_sided_limit(double probability, double freedom);

}  // namespace gloam::report
