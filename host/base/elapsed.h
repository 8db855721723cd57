// How long something took, by the wall clock.
#pragma once

#include <chrono>

namespace gloam {

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace gloam
