// Damages an EXR file in its sensitive parts: a header's attributes and channels, the tables, the chunks.
#pragma once

#include <string>

#include "base/random.h"

namespace gloam::fuzz {

/// One change, or rarely another file instead.
std::string damaged_exr(const std::string& bytes, Random& random);

}  // namespace gloam::fuzz
