// Names and numbers in files that may trip up a reader.
#pragma once

#include <string>
#include <vector>

#include "base/random.h"

namespace gloam::fuzz {

/// Names of channels without layer and view, of attributes, views and parts: those that gloam knows, and others.
const std::vector<std::string>& channel_words();
const std::vector<std::string>& layer_words();
const std::vector<std::string>& view_words();

/// Numbers at the limits of types and formulas.
double odd_number(Random& random);
int odd_whole_number(Random& random);
/// A word of another list, an empty one, a long one, or one that no terminal may show.
std::string odd_word(Random& random);

}  // namespace gloam::fuzz
