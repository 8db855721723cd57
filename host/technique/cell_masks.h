// Passes that masks of square cells share.
#pragma once

#include <vector>

#include "gloam/technique.h"

namespace gloam {

/// `passes`, the last of which writes one plane of cells, 1 where something is found, and two passes after them: each cell with
/// its neighbours is set, and every pixel of `mask` gets its cell's value (kernels/shared/sampling/cells.h, which the technique's
/// source includes).
std::vector<Pass> mask_of_cells(std::vector<Pass> passes);

}  // namespace gloam
