// Whether the pixels of a file can be decoded at all.
#pragma once

#include <set>
#include <string>
#include <utility>

#include "exr/file.h"

namespace gloam {

/// Decodes the channels (part, name) that are not in `decoded` and drops them, a band of rows at a time: damage shows only
/// when pixels are read. Lets OpenEXR's exceptions through.
void decode_the_rest(const ExrFile& file, const std::set<std::pair<int, std::string>>& decoded);

}  // namespace gloam
