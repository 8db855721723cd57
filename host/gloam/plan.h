// A plan is what is left when one walks back from the outputs asked for to the planes at hand.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gloam/error.h"
#include "gloam/technique.h"

namespace gloam {

struct PlanRequest {
  /// Planes to be made; a technique's name stands for its outputs.
  std::vector<std::string> outputs;
  /// Of these, only the planes named here (all when empty).
  std::vector<std::string> only;
  /// Replaces every technique's `then`: a technique, "none", or empty for the default.
  std::string then;
  std::string preset;
  /// name = value, or technique.name = value. A bare name reaches every planned technique that has it.
  std::vector<std::pair<std::string, std::string>> settings;
};

struct PlannedPass {
  const Technique* technique;
  Pass pass;
  ParameterValues values;
  std::string label() const { return technique->name + "/" + pass.name; }
};

struct Plan {
  std::string technique;                                     ///< the first one asked for or found; names the run
  std::vector<std::string> outputs;                          ///< planes to hand over
  std::vector<std::string> inputs;                           ///< planes to take from the frame
  std::map<std::string, std::vector<std::string>> stacks;    ///< layers of each stack read: "peel" -> "peel.00", ...
  std::vector<PlannedPass> passes;                           ///< in order
  std::vector<std::pair<std::string, std::string>> skipped;  ///< what, why
  std::vector<std::string> depends_on_pixels;                ///< what only the pixel values will tell
};

/// Planes that neither the frame nor any technique provides.
class MissingPlanes : public Error {
 public:
  MissingPlanes(const std::string& message, std::vector<std::string> planes) : Error("{}", message), planes(planes) {}
  std::vector<std::string> planes;
};

/// Throws MissingPlanes with all that is missing at once, UsageError for unknown names and values out of range.
/// `available`: planes the frame has; `holds`: words for the message on what the file does hold ("beauty.exr has only
/// R, G, B").
/// A stack (planes.h) is at hand when its first layer is, and has all layers up to the last one available: one that is
/// missing in between is a missing plane. A pass that reads a stack gets a define with the number of layers, named after
/// the argument: PEEL_LAYERS.
Plan make_plan(const PlanRequest& request, const std::vector<std::string>& available, const std::string& holds);

}  // namespace gloam
