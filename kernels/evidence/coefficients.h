// Coefficients of evidence.cl: sets, each for what occluders are known by and for a number of slices and steps.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gloam {

/// Terms of a slice: t of evidence.cl.
constexpr int evidence_terms = 13;
/// Those that AO is fitted to: t, and t times r. Those that the error is fitted to: t, the roots of a and u, and 1.
constexpr int closed_terms = 2 * evidence_terms, error_terms = evidence_terms + 3;

/// What was fitted for one sampling.
struct EvidenceSet {
  std::string occluders;  ///< depth, back_depth, peel or stochastic
  int directions, steps;
  std::vector<float> closed, error;  ///< `closed_terms` and `error_terms` numbers
  /// By how much the error grows with the square of the share of samples that lie outside of the image; none in a file that was fitted
  /// without.
  std::optional<float> outside = {};
};

/// The sets of a JSON document: {"sets": [{"occluders", "directions", "steps", "closed", "error", "outside"}]}, where `outside` may be
/// missing. `name`: of the file, for messages. Throws UsageError for anything else.
std::vector<EvidenceSet> evidence_sets(const std::string& text, const std::string& name);

/// Those that script/fit has made.
const std::vector<EvidenceSet>& fitted_evidence_sets();

/// The set that was fitted with the most similar sampling, of those for the same occluders. Null if there is none.
const EvidenceSet* nearest_set(const std::vector<EvidenceSet>& sets, const std::string& occluders, int directions,
                               int steps);

}  // namespace gloam
