// A plan is what is left when one walks back from the outputs asked for to the planes at hand.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gloam/error.h"
#include "gloam/technique.h"

namespace gloam {

struct PlanRequest {
  /// Planes to be made; a technique's name stands for its outputs.
  std::vector<std::string> outputs = {};
  /// Of these, only the planes named here (all when empty); may name a technique's extras.
  std::vector<std::string> only = {};
  /// Extras of the techniques asked for to be made as well: "bent_normal".
  std::vector<std::string> with = {};
  /// Replaces every technique's `then`: a technique, "none", or empty for the default.
  std::string then = {};
  std::string preset = {};
  /// name = value, or technique.name = value. A bare name reaches every planned technique that has it.
  Settings settings = {};
  /// Radius in scene units of every technique that has one and gets none by `settings`; none: the parameter's own default, which
  /// knows nothing of the frame's unit (radius.h makes one from the frame).
  std::optional<double> radius = {};
  /// Restricts the techniques asked for and their filters to where it is above 0: a plane, or a technique that makes one.
  /// Filters cover the mask, estimates what these read of them. What is left out is open. Empty: everywhere.
  std::string mask = {};
  /// Technique that estimates where the mask is not above 0, instead of leaving that open. Filters cover the image then.
  std::string elsewhere = {};
  /// Masks asked for are put out as the cells that they are made of, one pixel for each (`Pass::repeats_cells`), under the
  /// cells' own name; at a lower resolution, all outputs as that resolution has them ("seen_by_both@4").
  bool as_cells = false;
  /// Every `resolution`-th pixel of every `resolution`-th row is estimated and filtered, and the rest is brought back by
  /// joint bilateral upsampling (resample.h): 1, 2 or 4.
  int resolution = 1;
  /// Preset of the first technique asked for where AO hardly varies, by a base pass of a fourth of the columns and rows and
  /// the preset low (kernels/adaptive). Empty or none: all of the image alike.
  std::string adaptive = {};
};

struct PlannedPass {
  const Technique* technique;
  Pass pass;
  ParameterValues values;
  int scale = 1;  ///< of the technique as a whole: the plan's resolution, or 1
  std::string label() const { return technique->name + "/" + pass.name; }
};

struct Plan {
  std::string technique;                                   ///< the first one asked for or found; names the run
  std::vector<std::string> outputs;                        ///< planes to hand over
  std::vector<std::string> inputs;                         ///< planes to take from the frame
  std::map<std::string, std::vector<std::string>> stacks;  ///< layers of each stack read: "peel" -> "peel.00", ...
  std::vector<PlannedPass> passes;                         ///< in order
  int resolution = 1;                                      ///< as asked for
  std::string mask;                                        ///< the plane that says what is wanted; empty: everything is
  std::string wanted;  ///< bits by which the estimate skips pixels (shared/lanes/wanted.h); empty: it skips none
  std::string rest;    ///< bits of pixels that a second estimate sees to; empty: there is none
  std::vector<std::pair<std::string, std::string>> skipped;  ///< what, why
  std::vector<std::string> depends_on_pixels;                ///< what only the pixel values will tell
};

/// Planes that neither the frame nor any technique provides.
class MissingPlanes : public Error {
 public:
  MissingPlanes(const std::string& message, std::vector<std::string> planes,
                std::map<std::string, std::string> instead = {})
      : Error("{}", message), planes(std::move(planes)), instead(std::move(instead)) {}
  std::vector<std::string> planes;
  /// Of some of these, what would be made of it and is all that it is needed for: "stochastic" by "peel". Having that does
  /// as well, and takes less.
  std::map<std::string, std::string> instead;
};

/// Throws MissingPlanes with all that is missing at once, UsageError for unknown names and values out of range.
/// `available`: planes the frame has; `holds`: words for the message on what the file does hold ("beauty.exr has only
/// R, G, B").
/// A stack (planes.h) is at hand when its first layer is, and has all layers up to the last one available: one that is
/// missing in between is a missing plane. A pass that reads a stack gets a define with the number of layers, named after
/// the argument: PEEL_LAYERS. A binding that says how many layers it reads gets the first so many; where there are fewer,
/// the last of them is a missing plane.
/// Where `resolution` is above 1, planes of that size have names that end in it: "depth@2".
Plan make_plan(const PlanRequest& request, const std::vector<std::string>& available, const std::string& holds);

/// Planes that a technique puts out, those that it leaves to its filter included.
const std::vector<std::string>& outputs_of(const Technique& technique);

/// Whether a technique reads what another writes.
bool reads_from(const Technique& reader, const Technique& writer);

/// The scale (`Pass::scale`) of every plane and stack that a plan's passes touch.
std::map<std::string, int> plane_scales(const Plan& plan);

}  // namespace gloam
