// A plan: the passes from the planes at hand to the outputs asked for.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gloam/error.h"
#include "gloam/technique.h"

namespace gloam {

struct PlanRequest {
  /// Planes to make; a technique's name stands for its outputs.
  std::vector<std::string> outputs = {};
  /// Of the outputs, only the planes named here (empty: all); may name a technique's extras.
  std::vector<std::string> only_outputs = {};
  /// Of the outputs, those that were filtered only as filtered: `ao` without `ao_raw`. Planes named by themselves are made all the same.
  bool only_filtered = false;
  /// Extras to make besides the outputs of the techniques asked for: "bent_normal".
  std::vector<std::string> with = {};
  /// Replaces every technique's `then`: a technique, "none", or empty for the default.
  std::string filter = {};
  std::string preset = {};
  /// name = value, or technique.name = value. A bare name applies to every planned technique that has the parameter.
  Settings settings = {};
  /// Radius in scene units, for every technique that has one and gets none by `settings`. None: the parameter's own default, which
  /// knows nothing of the frame's unit (radius.h makes one from the frame).
  std::optional<double> radius = {};
  /// Restricts the techniques asked for and their filters to pixels where this plane, or the plane that this technique makes, is
  /// above 0. Estimates also cover what filters read around these pixels. The other pixels are open. Empty: no restriction.
  std::string only = {};
  /// Technique for the pixels where the mask is not above 0, instead of leaving them open. Filters then cover the whole image.
  std::string elsewhere = {};
  /// Masks asked for are returned with one pixel per cell (`Pass::repeats_cells`), under the cells' own name; at a lower
  /// resolution, all outputs are returned at that resolution ("seen_by_both@4").
  bool as_cells = false;
  /// 1, 2 or 4: every `resolution`-th pixel of every `resolution`-th row is estimated and filtered; the others are filled in by
  /// joint bilateral upsampling (resample.h).
  int resolution = 1;
  /// Preset of the first technique asked for in tiles where AO hardly varies, found by a base pass with a fourth of the columns and
  /// rows and the preset low (kernels/adaptive). Empty or "none": the whole image is computed alike.
  std::string adaptive = {};
  /// Goes on from the frame before: raw AO or indirect light is accumulated over time (kernels/temporal) before it is filtered, and a technique with a
  /// form of its own for sequences (`Technique::over_time`) is run in that form. Needs the planes of a history (history.h).
  bool temporal = false;
};

struct PlannedPass {
  const Technique* technique;
  Pass pass;
  ParameterValues values;
  int scale = 1;  ///< scale of the whole technique: the plan's resolution, or 1
  std::string label() const { return technique->name + "/" + pass.name; }
};

struct Plan {
  std::string technique;             ///< the first technique; names the run
  std::vector<std::string> outputs;  ///< planes to return
  std::vector<std::string> inputs;   ///< planes to take from the frame
  std::map<std::string, std::vector<std::string>>
      stacks;                       ///< layers of each stack that is read: "peel" -> "peel.00", ...
  std::vector<PlannedPass> passes;  ///< in order
  int resolution = 1;               ///< as asked for
  std::string mask;                 ///< plane of the wanted pixels; empty: all are wanted
  std::string wanted;  ///< bits by which the estimate skips pixels (shared/lanes/wanted.h); empty: it skips none
  std::string rest;    ///< bits of the pixels that a second estimate computes; empty: there is none
  std::vector<std::pair<std::string, std::string>> skipped;  ///< what, why
  std::vector<std::string> depends_on_pixels;                ///< open questions that only the pixel values answer
};

/// Planes that neither the frame nor any technique provides.
class MissingPlanes : public Error {
 public:
  MissingPlanes(const std::string& message, std::vector<std::string> planes,
                std::map<std::string, std::string> instead = {})
      : Error("{}", message), planes(std::move(planes)), instead(std::move(instead)) {}
  std::vector<std::string> planes;
  /// For some of the missing planes, one that would do instead: "stochastic" can be made from "peel", which is needed for nothing
  /// else.
  std::map<std::string, std::string> instead;
};

/// Throws MissingPlanes with everything that is missing, UsageError for unknown names and values out of range. `available`:
/// planes of the frame; `holds`: text for the message about what the file does hold ("beauty.exr has only R, G, B").
/// A stack (planes.h) is available if its first layer is; a gap before its last layer is a missing plane. A pass that reads a stack
/// gets a define with the number of layers, named after the argument: PEEL_LAYERS. A binding with a number of layers reads the
/// first ones; if there are fewer, the last one is a missing plane.
/// With `resolution` above 1, names of planes at that resolution end in it: "depth@2".
Plan make_plan(const PlanRequest& request, const std::vector<std::string>& available, const std::string& holds);

/// Throws UsageError if a plan reads one view's stochastic depths for the other view, and those of the frame are of surfaces that are
/// relevant to their own view alone; of depths that the plan makes, make_plan does. `says`: the text of an attribute of the frame's header
/// (docs/gbuffer.md) by its name, empty without it.
void check_stored_map(const Plan& plan, const std::function<std::string(const std::string&)>& says);

/// The radius of a map of relevant surfaces that a run of stochastic-depth made, by the attribute gloamParameters; none of others.
std::optional<double> radius_of_relevant(const std::string& parameters);

/// A sentence if a plan reads a map of relevant surfaces that leaves out some that count: for a range beyond the radius, or a radius beyond
/// that of a map which the frame holds. `radius_of_stored`: of the latter, gloamStochasticRadius or gloamParameters in the frame's header;
/// none: it is of other surfaces. Else empty.
std::string warning_about_map(const Plan& plan, std::optional<double> radius_of_stored);

/// Planes that a technique returns, including those that it leaves to its filter.
const std::vector<std::string>& outputs_of(const Technique& technique);

/// Whether a technique is a form for sequences: it takes over the result of the frame before, as temporal-sssr does.
bool accumulates_by_itself(const Technique& technique);

/// Whether results of a technique can be accumulated over time (`PlanRequest::temporal`).
bool can_accumulate(const Technique& technique);

/// Throws UsageError for a technique that cannot, and for what cannot be asked for together with `PlanRequest::temporal`.
void check_temporal(const PlanRequest& request);

/// Whether a technique reads a plane that another writes.
bool reads_from(const Technique& reader, const Technique& writer);

/// The scale (`Pass::scale`) of every plane and stack that a plan's passes touch.
std::map<std::string, int> plane_scales(const Plan& plan);

}  // namespace gloam
