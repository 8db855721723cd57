#include "gloam/technique.h"

namespace gloam::techniques {

std::vector<Technique> normals() {
  return {{
      .name = "normals",
      .summary = "view-space normals from depth, by the nearer neighbour on each axis",
      .paper = "",
      .source = "normals/normals.cl",
      .reads = {"depth"},
      .writes = {"normal"},
      .passes = [](const ParameterValues&) -> std::vector<Pass> {
        return {{.name = "differences", .kernel = "normals", .reads = {"depth"}, .writes = {"normal"}}};
      },
  }};
}

}  // namespace gloam::techniques
