// The words by which the command and the Python module name when a mask is used.
#pragma once

#include "base/words.h"
#include "gloam/auto.h"

namespace gloam {

inline const Choices<MaskUse> mask_words = {
    {"measured", MaskUse::measured}, {"always", MaskUse::always}, {"never", MaskUse::never}};

}  // namespace gloam
