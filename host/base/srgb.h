// The transfer function of sRGB (IEC 61966-2-1).
#pragma once

#include <cmath>

namespace gloam {

/// Linear light of a stored value from 0 to 1.
inline double linear_of_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// Stored value of linear light from 0 to 1.
inline double srgb(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

}  // namespace gloam
