// The plans that the benchmarks run for a technique.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gloam/frame.h"
#include "gloam/plan.h"
#include "gloam/run.h"
#include "planner/plan_option.h"

namespace gloam::bench {

/// Whether a technique makes its plane only from the result that another technique with this output leaves to it.
bool is_filter(const Technique& technique);

/// The plane that the technique itself writes: `ao_raw` if a filter follows, else `ao`; of light `indirect_raw` and `indirect`.
std::string own_plane(const Technique& technique);

/// The depths among its inputs: "depth", and stacks such as "peel" and "stochastic".
std::vector<std::string> depths_of(const Technique& technique);

/// Whether it reads a stack of depth layers.
bool reads_layers(const Technique& technique);

/// Whether any of the techniques makes an image of only the first of two views.
bool any_makes_first_view_only(const std::vector<const Technique*>& techniques);

/// The technique over all peeled layers (`Technique::variant`): "dp-hbao+" for "hbao+"; itself if it reads them already. None if there is none.
const Technique* over_all_layers(const Technique& technique);

/// Precision of planes between input, passes and result. Kernels read and write floats: half only shows its cost in accuracy
/// (storage.h).
enum class Storage { float32, float16 };

/// A technique with its settings and options.
struct Variation {
  const Technique* technique = nullptr;
  std::string preset;  ///< empty: default settings
  double radius = 0.5;
  std::string variant;  ///< difference to the preset, in words: "half", "steps=9"; empty: none
  int resolution = 1;   ///< as in `PlanRequest`
  Math math = Math::fast;
  Real real = Real::float32;
  Storage storage = Storage::float32;
  Settings settings;      ///< override those of the preset
  bool temporal = false;  ///< goes on from the frame before, as `PlanRequest::temporal`
  std::string name() const { return preset.empty() ? "default" : preset; }
  RunOptions run_options() const;
};

/// What it asks a plan for.
PlanRequest request_for(const Variation& variation);

/// As an option among others: "gtao, medium, half" is its label.
PlanOption option_of(const Variation& variation);

/// The settings that mean the same for the same estimate over other layers (`over_all_layers`). The parameters of stochastic
/// depth do not: its `samples` are depths, not sample positions.
Settings settings_over_other_layers(const Settings& settings, const Technique& from, const Technique& to);

/// The names of a frame's planes that every view has.
std::vector<std::string> planes_of(const Frame& frame);

/// The whole plan for the measured plane (effects.h), with the filter; of one that goes on over time also the planes from which a history is made. Throws as
/// `make_plan` does.
Plan whole_plan(const Variation& variation, const std::vector<std::string>& available, const std::string& holds);

/// The plan without the filter, for `own_plane`. `more`: settings that override those of the preset.
Plan unfiltered_plan(const Variation& variation, const std::vector<std::string>& available, const std::string& holds,
                     const Settings& more = {});

/// The part of a whole plan after the technique's own passes, with their result as an input. No passes if nothing follows.
Plan filter_of(const Plan& whole, const Technique& technique);

/// Values of a technique's parameters in a plan; null if the plan does not use it.
const ParameterValues* values_of(const Plan& plan, const std::string& technique);

}  // namespace gloam::bench
