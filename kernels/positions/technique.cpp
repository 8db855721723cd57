#include "gloam/technique.h"

namespace gloam::techniques {

std::vector<Technique> positions() {
  return {{
      .name = "positions",
      .summary = "positions from depth, where a frame has none",
      .paper = "",
      .source = "positions/positions.cl",
      .reads = {"depth"},
      .writes = {"position"},
      .any_projection = true,
      .passes = [](const ParameterValues&) -> std::vector<Pass> {
        return {
            {.name = "positions", .kernel = "positions", .reads = {"depth"}, .writes = {"position"}, .projects = true}};
      },
  }};
}

}  // namespace gloam::techniques
