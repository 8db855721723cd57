#include "gloam/technique.h"

#include "shared/both/params.h"

#define GAUSSIAN_PARAMS(P)                                                   \
  P(float, sigma, 1.5f, 0, 64, "pixels", "standard deviation; 0: no filter") \
  P(int, half_width, 4, 0, 32, "pixels", "taps on either side of the pixel, along each axis")

PARAMS(GaussianParams, GAUSSIAN_PARAMS)

namespace gloam::techniques {
namespace {

std::vector<Pass> passes(const GaussianParams& p) {
  const Defines defines = {{"HALF_WIDTH", p.half_width}};
  return {{.name = "horizontal",
           .kernel = "gaussian_horizontal",
           .reads = {{"source", "ao_raw"}, "depth"},
           .writes = {{"sum", "gaussian_sum"}, {"weight", "gaussian_weight"}},
           .defines = defines,
           .footprint = {.columns = p.half_width},
           .can_skip = true},
          {.name = "vertical",
           .kernel = "gaussian_vertical",
           .reads = {{"sum", "gaussian_sum"}, {"weight", "gaussian_weight"}, "depth"},
           .writes = {{"result", "ao"}},
           .defines = defines,
           .footprint = {.rows = p.half_width},
           .can_skip = true}};
}

}  // namespace

std::vector<Technique> gaussian() {
  return {{
      .name = "gaussian",
      .summary = "Gaussian filter for raw AO that ignores edges; background has no weight",
      .paper = "Knutsson, Westin 1993",
      .source = "gaussian/gaussian.cl",
      .reads = {"ao_raw", "depth"},
      .writes = {"ao"},
      .any_projection = true,
      .parameters = GaussianParams::table(),
      .passes = passes_of(passes),
  }};
}

}  // namespace gloam::techniques
