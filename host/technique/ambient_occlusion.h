// What techniques for ambient occlusion share: their rows in the registry, their estimate, and variants over layers.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gloam/technique.h"

struct StochasticParams;  // shared/sampling/ambient_occlusion.h

namespace gloam {

/// Name prefixes of techniques over all peeled layers and over stochastic depth.
inline constexpr std::string_view peeled_prefix = "dp-", stochastic_prefix = "sd-";

/// A technique with an estimate from depth and normals, followed by a bilateral filter of 5 x 5 pixels. The caller adds
/// parameters, passes, presets.
Technique ambient_occlusion(std::string name, std::string summary, std::string paper, std::string source);

/// Presets of 8, 18, 36 and 72 samples, for a technique with a parameter `samples`.
std::vector<Preset> presets_of_samples();

/// Samples per pixel: the parameter `samples`, or `directions` times `steps`.
int value_of_samples(const ParameterValues& values);
int directions_times_steps(const ParameterValues& values);

/// With the presets, the converged form and the number of samples of a search of slices (shared/sampling/slice_steps.h):
/// `directions` slices, `steps` samples on each side of a slice.
Technique over_slices(Technique technique);

/// The pass "estimate" over the depth alone, with the choices of REACH_PARAMS (shared/sampling/ambient_occlusion.h) besides
/// `defines`.
template <typename Params>
Pass ambient_occlusion_estimate(const Params& p, std::string kernel, Defines defines) {
  defines.insert(defines.end(), {{"JITTER", p.jitter}, {"OUTSIDE_OPEN", p.outside == Params::outside_values::open}});
  return {.name = "estimate",
          .kernel = std::move(kernel),
          .reads = {"depth", "normal"},
          .writes = {"ao_raw"},
          .defines = std::move(defines),
          .footprint = {.is_wide = true},
          .can_skip = true};
}

/// The cross-bilateral filter (shared/filter/bilateral_filter.h) from `source` to `result`, planes of one component or colours: along
/// rows and then along columns, in one pass up to a half width of 4, or over a square. `half_width`: taps on either side, pixels.
std::vector<Pass> bilateral_passes(int half_width, bool is_square, const std::string& source,
                                   const std::string& result);

/// The filter as one pass along rows and one along columns, whatever its width.
std::vector<Pass> bilateral_passes_along_axes(int half_width, const std::string& source, const std::string& result);

/// A variant of a technique with every layer of the peeled depth as an occluder: "dp-" before its name; its estimate also reads
/// the stack `occluders`.
Technique over_peeled_layers(Technique technique);

/// The pass "estimate" of `passes` with stochastic depths as occluders behind the depth, the last of its `reads`, and before it the pass
/// that sorts them for kernels (shared/sampling/hidden_depths.h).
std::vector<Pass> behind_depth(std::vector<Pass> passes, const StochasticParams& p);

/// The sorting pass for every `scale`-th pixel each way. Writes the depth of these pixels, and the hidden depths there.
Pass at_lower_resolution(Pass sort, int scale);

/// A variant of a technique with stochastic depths behind the depth: "sd-" before its name, STOCHASTIC_PARAMS after its parameters.
/// Since `samples` are stochastic depths there, a technique's own `samples` per pixel are called `points`.
Technique over_stochastic_depth(Technique technique);

}  // namespace gloam
