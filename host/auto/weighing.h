// The picture in gloam auto: what effects change in it, and what a budget is spent on.
#pragma once

#include <functional>

#include "auto/budget.h"

namespace gloam {

/// How an effect's probe is made on the frame at hand.
using ProbeFor = std::function<EffectProbe(const Candidate&)>;

/// Looks at all effects, or, if only that is asked for, at those that have to change the picture by some share to be wanted.
Glance glance_at(const Candidates& candidates, bool at_all, const ComposeOptions& composing, const ProbeFor& probe_for);

/// RMS change of the picture by an effect, with what completes it; NaN: the glance has not looked at it.
double change_by(const Technique& technique, const Glance& glance);

/// The planes of a picture that an effect makes, with what completes it.
std::vector<std::string> planes_of(const Technique& technique);

/// Of the picture that the outcomes make together.
ExpectedError expected_of(const std::vector<Outcome>& outcomes, const Glance& glance);

/// Spends the budget on the effects that are wanted; `result.outcomes` are those of `candidates.possible`, decided, in their order.
void spend_budget(const Candidates& candidates, const AutoSettings& settings, const Glance& glance,
                  const ProbeFor& probe_for, AutoResult& result);

}  // namespace gloam
