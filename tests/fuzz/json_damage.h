// Damages a JSON text: in its values and names, or as text.
#pragma once

#include <string>
#include <vector>

#include "base/random.h"

namespace gloam::fuzz {

/// One change. `starts`: texts that may replace this one, or give it a part; `words`: names of fields.
std::string damaged_json(const std::string& text, const std::vector<std::string>& starts,
                         const std::vector<std::string>& words, Random& random);

}  // namespace gloam::fuzz
