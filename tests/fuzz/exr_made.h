// Small EXR files of every kind that OpenEXR writes, except deep ones.
#pragma once

#include <string>

#include "base/random.h"

namespace gloam::fuzz {

/// A whole file: parts, views, windows, channels, compressions, cameras and values at random.
std::string made_exr(Random& random);

}  // namespace gloam::fuzz
