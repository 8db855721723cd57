#include "technique/cell_masks.h"

namespace gloam {

std::vector<Pass> mask_of_cells(std::vector<Pass> passes) {
  const Pass find = passes.back();
  const std::string found = find.writes.front().plane, grown = found + ".grown";
  passes.push_back({.name = "grow",
                    .kernel = "cells_grow",
                    .reads = {{"found", found}},
                    .writes = {{"grown", grown}},
                    .defines = find.defines,
                    .scale = find.scale});
  passes.push_back({.name = "spread",
                    .kernel = "cells_spread",
                    .reads = {{"grown", grown}},
                    .writes = {{"result", "mask"}},
                    .defines = find.defines,
                    .repeats_cells = true});
  return passes;
}

}  // namespace gloam
