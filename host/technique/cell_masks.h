// Passes that masks of square cells share.
#pragma once

#include <vector>

#include "gloam/technique.h"

namespace gloam {

/// `passes`, of which the last writes one plane of cells, 1 where something is found; then each cell stands for those around it too,
/// and every pixel of `mask` gets what its cell has (kernels/shared/sampling/cells.h, which the technique's source includes).
std::vector<Pass> mask_of_cells(std::vector<Pass> passes);

}  // namespace gloam
