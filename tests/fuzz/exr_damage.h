// Damages an EXR file where it hurts: in a header's attributes and channels, in the tables, in the chunks.
#pragma once

#include <string>

#include "base/random.h"

namespace gloam::fuzz {

/// One change, or rarely another file altogether.
std::string damaged_exr(const std::string& bytes, Random& random);

}  // namespace gloam::fuzz
