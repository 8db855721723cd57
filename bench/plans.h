// The plans that the benchmarks run for a technique that makes `ao`.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gloam/frame.h"
#include "gloam/plan.h"
#include "gloam/run.h"

namespace gloam::bench {

/// Whether it makes `ao` only from what another technique that puts out `ao` leaves to it.
bool is_filter(const Technique& technique);

/// The plane of ambient occlusion that the technique itself writes: `ao_raw` where a filter follows, else `ao`.
std::string own_plane(const Technique& technique);

/// What of its input is depth: "depth", and stacks such as "peel" and "stochastic".
std::vector<std::string> depths_of(const Technique& technique);

/// Whether it reads a stack of depth layers.
bool reads_layers(const Technique& technique);

/// Whether any of them makes an image of the first of two views alone.
bool any_makes_first_view_only(const std::vector<const Technique*>& techniques);

/// The technique over all peeled layers: "dp-hbao+" for "hbao+", itself for one that reads layers already. None where the
/// registry has none.
const Technique* over_all_layers(const Technique& technique);

/// What planes are kept in between door, passes and result. Kernels read and write floats: half is what it would cost in
/// accuracy (storage.h).
enum class Storage { float32, float16 };

/// How a technique is asked for and run.
struct Variation {
  const Technique* technique = nullptr;
  std::string preset;  ///< empty: default settings
  double radius = 0.5;
  std::string variant;  ///< what is other than in the preset, in words: "half", "steps=9"; empty: nothing is
  int resolution = 1;   ///< as in `PlanRequest`
  Math math = Math::fast;
  Real real = Real::float32;
  Storage storage = Storage::float32;
  Settings settings;  ///< over those of the preset
  std::string name() const { return preset.empty() ? "default" : preset; }
  RunOptions run_options() const;
};

/// Of settings for a technique, those that mean the same for the same estimate over other layers (`over_all_layers`). The
/// parameters of stochastic depth do not: their `samples` are depths, not places that are looked at.
Settings settings_over_other_layers(const Settings& settings, const Technique& from, const Technique& to);

/// The names of a frame's planes that every view has.
std::vector<std::string> planes_of(const Frame& frame);

/// All that makes `ao`, the filter included. Throws what `make_plan` throws.
Plan whole_plan(const Variation& variation, const std::vector<std::string>& available, const std::string& holds);

/// Without the filter: makes `own_plane`. `more`: settings over those of the preset.
Plan unfiltered_plan(const Variation& variation, const std::vector<std::string>& available, const std::string& holds,
                     const Settings& more = {});

/// What of a whole plan comes after the technique's own passes, reading their result as an input. No passes where
/// nothing follows.
Plan filter_of(const Plan& whole, const Technique& technique);

/// Values of a technique's parameters in a plan; null where the plan does without it.
const ParameterValues* values_of(const Plan& plan, const std::string& technique);

}  // namespace gloam::bench
