// Attributes of headers in words, for people.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "exr/headers.h"

namespace gloam {

/// Names and values of the attributes of all parts, in file order; of further parts those that the first has not, or otherwise, after
/// the part's name. Long values are cut. Channels, and types that gloam does not know, are left out.
std::vector<std::pair<std::string, std::string>> attribute_texts(const Headers& headers);

}  // namespace gloam
