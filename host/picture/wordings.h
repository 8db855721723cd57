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

/// Several ways to say it, the longest first.
using Wordings = std::vector<std::string>;

/// What the values of tiles of one style and plane are: their `own` ranges, and the `scale` that they are drawn on, of more
/// tiles perhaps.
Wordings range_in_words(const std::vector<const Tile*>& tiles, const std::vector<Range>& own,
                        const std::vector<Range>& scale);

/// The longest wording that fits into `width`, else the last, shortened.
std::string fitting(const Wordings& wordings, double width, const TextStyle& style);

}  // namespace gloam
