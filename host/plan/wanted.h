// What a request asks for: planes, and the techniques that shall make them.
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

/// What a request asks for. Throws UsageError for names that mean nothing. `available`: planes that the frame has.
Wanted wanted_by(const PlanRequest& request, const std::vector<std::string>& available);

/// The plane that a request's mask names: the one that a technique of that name makes, or the name itself. What makes it joins
/// the makers. Empty where there is no mask.
std::string want_mask(Wanted& wanted, const std::string& mask, const std::vector<std::string>& available);

bool is_adaptive(const PlanRequest& request);

/// The technique that --elsewhere names: one that makes the same as the one asked for, before that one; null where none is
/// named.
const Technique* want_elsewhere(const PlanRequest& request, const Wanted& wanted);

/// The technique that makes a plane: one of the makers, else the one of the registry that says it is the default for it, else
/// the one that follows most others by default, else the one that reads the fewest planes (the first by name of these); never
/// the one that asks. Null where nothing makes it.
const Technique* maker_of(const std::string& plane, const Technique* asking, const Techniques& makers);

}  // namespace gloam
