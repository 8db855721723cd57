// The values of tiles in words, for captions and headings.
#pragma once

#include <string>
#include <vector>

#include "picture/picture.h"
#include "picture/scale.h"
#include "picture/tile.h"

namespace gloam {

/// A number in three digits; never "-0".
std::string figure(double v);

/// Several wordings of one fact, the longest first.
using Wordings = std::vector<std::string>;

/// The values of tiles of one style and plane: their `own` ranges, and the `scale` on which they are drawn, which may cover more
/// tiles.
Wordings range_in_words(const std::vector<const Tile*>& tiles, const std::vector<Range>& own,
                        const std::vector<Range>& scale);

/// The longest wording that fits into `width`, else the last, shortened.
std::string fitting(const Wordings& wordings, double width, const TextStyle& style);

}  // namespace gloam
