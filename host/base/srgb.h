// The transfer function of sRGB (IEC 61966-2-1).
#pragma once

#include <cmath>

namespace gloam {

/// Linear light of a stored value from 0 to 1.
inline double linear_of_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

}  // namespace gloam
