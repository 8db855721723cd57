// Which planes of two images are compared, and figures of several views as one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gloam/metrics.h"

namespace gloam {

/// A plane of the test and the plane of the reference that it is measured against.
struct PlanePair {
  std::string test, reference;
};

/// Planes that techniques make, each with a plane that it can be measured against, best first. AO before a filter and AO after it
/// may be compared.
const std::vector<PlanePair>& result_pairs();

/// Those of some planes that techniques make.
std::vector<std::string> results_among(const std::vector<std::string>& planes);

/// Those that techniques do not make, the most informative first.
std::vector<std::string> inputs_among(const std::vector<std::string>& planes);

/// A reflection without its confidence, which is not part of its look, and has another meaning in a truth.
Plane without_confidence(Plane plane);

/// Pixels whose reflected surfaces are mostly visible in the frame, according to the truth; none if the truth does not tell.
std::optional<Mask> shown_pixels(const Plane& truth, const Mask& mask);

/// Metrics of several views as one: sums over all their pixels.
Metrics pooled(const std::vector<Metrics>& views);

}  // namespace gloam
