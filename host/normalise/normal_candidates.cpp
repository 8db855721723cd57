#include "normalise/normal_candidates.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "base/srgb.h"
#include "normalise/normal_axes.h"

namespace gloam {
namespace {

using glm::dmat3;
using glm::dvec3;

/// Pairs whose normals differ by more than this cosine between two conventions have a vote on them.
constexpr double most_alike = 0.99;
/// A convention clearly beats another if it leads by so much, by votes of so many pairs.
constexpr double least_lead = 0.5, least_share_voting = 0.005;
constexpr double fewest_votes = 24;
/// A convention is the best one seen through noise only if it agrees less by no more than this share of what the best one lacks.
constexpr double share_of_noise = 0.5;
/// Components of encoded normals below 0: a filter with negative lobes makes a few of them.
constexpr double most_below_zero = 0.01;

dvec3 unit_or_zero(const dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : dvec3(0.0);
}

/// Sums of the products of components: in column a and row i axis a of the depth's normal with the stored component i.
dmat3 products_of(const std::vector<NormalPair>& pairs, NormalRange range) {
  dmat3 sum(0.0);
  for (const NormalPair& pair : pairs)
    sum += glm::outerProduct(unit_or_zero(decoded(pair.stored, range)), pair.from_depth);
  return sum;
}

bool may_be_encoded(const std::vector<NormalPair>& pairs) {
  const auto below = std::count_if(pairs.begin(), pairs.end(), [](const NormalPair& pair) {
    return std::min({pair.stored.x, pair.stored.y, pair.stored.z}) < -most_below_zero;
  });
  return double(below) <= most_below_zero * double(pairs.size());
}

/// What the pairs say that two conventions make differ.
struct Votes {
  double all = 0;
  double lead =
      0;  ///< 1: the depth's normals are those of the first convention, -1: of the second, 0: they lie between
};

Votes votes_between(const NormalForm& first, const NormalForm& second, const std::vector<NormalPair>& pairs,
                    const std::optional<Pose>& pose) {
  double all = 0, gain = 0, most = 0;
  for (const NormalPair& pair : pairs) {
    const dvec3 one = view_normal(pair.stored, first, pose), other = view_normal(pair.stored, second, pose);
    const double alike = glm::dot(one, other);
    if (!(alike < most_alike)) continue;
    ++all;
    gain += glm::dot(one - other, pair.from_depth);
    most += 1 - alike;
  }
  return {all, all > 0 ? gain / most : 0};
}

double departure_of_range(NormalRange range) {
  return range == NormalRange::srgb_values ? 4 : range == NormalRange::unsigned_values ? 2 : 0;
}

}  // namespace

dvec3 decoded(const dvec3& stored, NormalRange range) {
  if (range == NormalRange::signed_values) return stored;
  dvec3 share = stored;
  if (range == NormalRange::srgb_values)
    for (int i : {0, 1, 2}) share[i] = linear_of_srgb(stored[i]);
  return 2.0 * share - 1.0;
}

std::vector<NormalCandidate> candidates_of(const std::vector<NormalPair>& pairs, const std::optional<Pose>& pose,
                                           const StatedNormals& stated) {
  std::vector<NormalCandidate> candidates;
  const bool is_stated_encoded =
      stated.convention.range == NormalRange::unsigned_values || stated.convention.range == NormalRange::srgb_values;
  const bool may_decode = is_stated_encoded || may_be_encoded(pairs);
  for (const NormalRange range : normal_ranges) {
    if (range != NormalRange::signed_values && !may_decode) continue;
    const dmat3 in_view = products_of(pairs, range);
    for (const NormalSpace space : {NormalSpace::view, NormalSpace::world}) {
      if (space == NormalSpace::world && !pose) continue;
      const dmat3 products = space == NormalSpace::world ? in_view * pose->world_to_view : in_view;
      for (const NormalAxes& axes : all_axes()) {
        NormalCandidate candidate{{space, range, axes}, 0, 0};
        candidate.departure = departure_of(candidate.form);
        const bool is_plain = range == NormalRange::signed_values && axes == plain_axes;
        if (stated.expects_view && space == NormalSpace::world && is_plain) candidate.departure += 0.5;
        for (size_t i = 0; i < 3; ++i) {
          const int axis = std::abs(axes[i]) - 1;
          candidate.agreement += (axes[i] < 0 ? -1 : 1) * products[axis][int(i)];
        }
        // Rounded: conventions that differ by nothing but rounding are equal, and keep their order.
        candidate.agreement = std::round(1e9 * candidate.agreement / double(pairs.size())) / 1e9;
        candidates.push_back(candidate);
      }
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const NormalCandidate& a, const NormalCandidate& b) { return a.agreement > b.agreement; });
  return candidates;
}

bool is_allowed(const NormalForm& form, const NormalConvention& stated) {
  return (stated.space == NormalSpace::automatic || stated.space == form.space) &&
         (stated.range == NormalRange::automatic || stated.range == form.range) &&
         (!stated.axes || *stated.axes == form.axes);
}

bool clearly_beats(const NormalCandidate& best, const NormalCandidate& other, const std::vector<NormalPair>& pairs,
                   const std::optional<Pose>& pose) {
  if (best.form == other.form || best.agreement < least_agreement) return false;
  const Votes votes = votes_between(best.form, other.form, pairs, pose);
  return votes.all >= std::max(fewest_votes, least_share_voting * double(pairs.size())) && votes.lead >= least_lead;
}

NormalCandidate chosen_of(std::vector<NormalCandidate> candidates, const std::vector<NormalPair>& pairs,
                          const std::optional<Pose>& pose) {
  const NormalCandidate best = candidates.front();
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const NormalCandidate& a, const NormalCandidate& b) { return a.departure < b.departure; });
  for (const NormalCandidate& candidate : candidates) {
    const bool may_be_the_same =
        candidate.departure == candidates.front().departure ||
        candidate.agreement >= best.agreement - std::max(0.01, share_of_noise * (1 - best.agreement));
    if (may_be_the_same && !clearly_beats(best, candidate, pairs, pose)) return candidate;
  }
  return best;
}

const NormalCandidate& of_form(const std::vector<NormalCandidate>& candidates, const NormalForm& form) {
  return *std::find_if(candidates.begin(), candidates.end(), [&](const NormalCandidate& c) { return c.form == form; });
}

double departure_of(const NormalForm& form) { return departure_of(form.axes) + departure_of_range(form.range); }

std::optional<NormalForm> best_agreeing_form(const std::vector<NormalPair>& pairs, const std::optional<Pose>& pose,
                                             const NormalConvention& stated) {
  if (pairs.empty()) return {};
  const std::vector<NormalCandidate> candidates = candidates_of(pairs, pose, {stated, "", false});
  const auto found = std::find_if(candidates.begin(), candidates.end(),
                                  [&](const NormalCandidate& c) { return is_allowed(c.form, stated); });
  return found == candidates.end() ? std::nullopt : std::optional(found->form);
}

dvec3 view_normal(const dvec3& stored, const NormalForm& form, const std::optional<Pose>& pose) {
  const dvec3 given = unit_or_zero(decoded(stored, form.range));
  dvec3 normal(0.0);
  for (size_t i = 0; i < 3; ++i) normal[std::abs(form.axes[i]) - 1] = (form.axes[i] < 0 ? -1 : 1) * given[int(i)];
  return form.space == NormalSpace::world && pose ? pose->world_to_view * normal : normal;
}

}  // namespace gloam
