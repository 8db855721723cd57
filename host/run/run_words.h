// The words by which commands and the Python module name how a plan is run.
#pragma once

#include "base/words.h"
#include "gloam/run.h"

namespace gloam {

inline const Choices<Math> math_words = {{"precise", Math::precise}, {"fast", Math::fast}};
inline const Choices<Real> real_words = {{"float", Real::float32}, {"double", Real::float64}};
inline const Choices<int> resolution_words = {{"full", 1}, {"half", 2}, {"quarter", 4}};

}  // namespace gloam
