#include "gloam/technique.h"

#include "gaussian/params.h"

namespace gloam::techniques {
namespace {

std::vector<Pass> passes(const GaussianParams& p) {
  const std::vector<std::pair<std::string, int>> defines = {{"HALF_WIDTH", p.half_width}};
  return {{"horizontal",
           "gaussian_horizontal",
           {{"source", "ao_raw"}, "depth"},
           {{"sum", "gaussian_sum"}, {"weight", "gaussian_weight"}},
           defines},
          {"vertical",
           "gaussian_vertical",
           {{"sum", "gaussian_sum"}, {"weight", "gaussian_weight"}, "depth"},
           {{"result", "ao"}},
           defines}};
}

}  // namespace

std::vector<Technique> gaussian() {
  return {{
      .name = "gaussian",
      .summary = "Gaussian filter for raw AO without regard to edges; background has no weight",
      .paper = "Knutsson, Westin 1993",
      .source = "gaussian/gaussian.cl",
      .reads = {"ao_raw", "depth"},
      .writes = {"ao"},
      .parameters = GaussianParams::table(),
      .passes = passes_of(passes),
  }};
}

}  // namespace gloam::techniques
