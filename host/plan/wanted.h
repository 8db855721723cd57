// The wish behind a request: planes, and the techniques that make them.
#pragma once

#include <string>
#include <vector>

#include "gloam/plan.h"

namespace gloam {

using Techniques = std::vector<const Technique*>;

struct Wanted {
  std::vector<std::string> outputs;
  Techniques makers;  ///< in order of preference
};

/// Interprets a request. Throws UsageError for unknown names. `available`: planes of the frame.
Wanted wanted_by(const PlanRequest& request, const std::vector<std::string>& available);

/// The plane that a request's mask names: the one that a technique of that name makes, or the name itself. Its maker joins the
/// makers. Empty if there is no mask.
std::string want_mask(Wanted& wanted, const std::string& mask, const std::vector<std::string>& available);

bool is_adaptive(const PlanRequest& request);

/// The technique that --elsewhere names, which makes the same planes as the one asked for and runs before it; null if none is
/// named.
const Technique* want_elsewhere(const PlanRequest& request, const Wanted& wanted);

/// The technique that makes a plane: one of the makers, else the default for this plane in the registry, else the one that
/// follows most others by default, else the one that reads the fewest planes (of these, the first by name); never the one that
/// asks. Null if nothing makes it.
const Technique* maker_of(const std::string& plane, const Technique* asking, const Techniques& makers);

/// Whether a technique is the filter that others leave an image to, and reads an extra of this one.
bool filters_extra_of(const Technique& filter, const Technique& technique);

}  // namespace gloam
