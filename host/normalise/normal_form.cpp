#include "normalise/normal_form.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "gloam/error.h"
#include "gloam/option.h"
#include "normalise/common_turn.h"
#include "normalise/normal_axes.h"

namespace gloam {
namespace {

using glm::dmat3;
using glm::dvec3;

/// A convention, how well it agrees with the depth, and how far it is from the plain one.
struct Candidate {
  NormalForm form;
  double agreement = 0;  ///< mean cosine
  double departure = 0;
};

/// Pairs whose normals differ by more than this cosine between two conventions have a vote on them.
constexpr double most_alike = 0.99;
/// A convention clearly beats another if it leads by so much, by votes of so many pairs.
constexpr double least_lead = 0.5, least_share_voting = 0.005;
constexpr double fewest_votes = 24;
/// No convention is found in normals that agree less with the depth, as those of another frame do.
constexpr double least_agreement = 0.7;
/// A convention is the best one seen through noise only if it agrees less by no more than this share of what the best one lacks.
constexpr double share_of_noise = 0.5;
/// So few pairs may agree badly by chance.
constexpr double most_of_chance = 256;
/// Components of encoded normals below 0: a filter with negative lobes makes a few of them.
constexpr double most_below_zero = 0.01;

dvec3 decoded(const dvec3& stored, bool is_encoded) { return is_encoded ? 2.0 * stored - 1.0 : stored; }

dvec3 unit_or_zero(const dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : dvec3(0.0);
}

/// Sums of the products of components: in column a and row i axis a of the depth's normal with the stored component i.
dmat3 products_of(const std::vector<NormalPair>& pairs, bool is_encoded) {
  dmat3 sum(0.0);
  for (const NormalPair& pair : pairs)
    sum += glm::outerProduct(unit_or_zero(decoded(pair.stored, is_encoded)), pair.from_depth);
  return sum;
}

bool may_be_encoded(const std::vector<NormalPair>& pairs) {
  const auto below = std::count_if(pairs.begin(), pairs.end(), [](const NormalPair& pair) {
    return std::min({pair.stored.x, pair.stored.y, pair.stored.z}) < -most_below_zero;
  });
  return double(below) <= most_below_zero * double(pairs.size());
}

/// Every convention with its agreement, the best first.
std::vector<Candidate> candidates_of(const std::vector<NormalPair>& pairs, const std::optional<Pose>& pose,
                                     const StatedNormals& stated) {
  std::vector<Candidate> candidates;
  const bool may_decode = stated.convention.range == NormalRange::unsigned_values || may_be_encoded(pairs);
  const int ranges = may_decode ? 2 : 1;
  for (int range = 0; range < ranges; ++range) {
    const dmat3 in_view = products_of(pairs, range == 1);
    for (const NormalSpace space : {NormalSpace::view, NormalSpace::world}) {
      if (space == NormalSpace::world && !pose) continue;
      const dmat3 products = space == NormalSpace::world ? in_view * pose->world_to_view : in_view;
      for (const NormalAxes& axes : all_axes()) {
        Candidate candidate{{space, range == 1, axes}, 0, departure_of(axes) + 2 * range};
        const bool is_plain = range == 0 && axes == plain_axes;
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
                   [](const Candidate& a, const Candidate& b) { return a.agreement > b.agreement; });
  return candidates;
}

bool is_allowed(const NormalForm& form, const NormalConvention& stated) {
  return (stated.space == NormalSpace::automatic || stated.space == form.space) &&
         (stated.range == NormalRange::automatic ||
          (stated.range == NormalRange::unsigned_values) == form.is_encoded) &&
         (!stated.axes || *stated.axes == form.axes);
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

bool clearly_beats(const Candidate& best, const Candidate& other, const std::vector<NormalPair>& pairs,
                   const std::optional<Pose>& pose) {
  if (best.form == other.form || best.agreement < least_agreement) return false;
  const Votes votes = votes_between(best.form, other.form, pairs, pose);
  return votes.all >= std::max(fewest_votes, least_share_voting * double(pairs.size())) && votes.lead >= least_lead;
}

/// The plainest candidate that the best one does not clearly beat. `candidates`: the best first.
Candidate chosen_of(std::vector<Candidate> candidates, const std::vector<NormalPair>& pairs,
                    const std::optional<Pose>& pose) {
  const Candidate best = candidates.front();
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.departure < b.departure; });
  for (const Candidate& candidate : candidates) {
    const bool may_be_the_same =
        candidate.departure == candidates.front().departure ||
        candidate.agreement >= best.agreement - std::max(0.01, share_of_noise * (1 - best.agreement));
    if (may_be_the_same && !clearly_beats(best, candidate, pairs, pose)) return candidate;
  }
  return best;
}

/// Whether normals of a camera of unknown pose are in view space. In view space they agree with depth wherever the camera stands, and
/// are not turned: on the cameras of the built-in scenes at 640x360, to 0.90 and more but for leaves and hair; smaller images have more
/// edges, and agree less. In world space they agree to 0.94 at most where the camera is turned by 20 degrees. Where half of the pairs
/// are near one another, view-space normals appear turned by 3 degrees at most, world-space normals of a camera that is turned by 6
/// degrees or more by 5 at least.
constexpr double least_turn = 4;
/// Turned normals that agree less are not the surface's, wherever the camera stands.
constexpr double least_turned_agreement = 0.9;
/// A turn by 12 degrees. Smaller ones are noise where surfaces are rough.
constexpr double least_gain_by_turn = 0.02;
/// Length of the mean normal. That of a floor and a wall of like size is 0.7.
constexpr double most_one_way = 0.9;
bool are_in_view_space(double agreement, const CommonTurn& turn) {
  return agreement >= 0.9 || (turn.share_near >= 0.5 && turn.degrees < least_turn);
}

/// Whether the normals agree better if all of them are turned. A field of view that is wrong by a factor of 1.7 looks like a turn of up to
/// 11 degrees.
bool is_turned(double agreement, const CommonTurn& turn) {
  return turn.degrees >= least_turn && turn.agreement - agreement >= 0.5 * (1 - std::cos(glm::radians(turn.degrees)));
}

const char* word_for(NormalSpace space) { return space == NormalSpace::world ? "world" : "view"; }

/// "decoded from 0..1 and taken as view space with the axes x,-y,z"
std::string taken_in_words(const NormalForm& form) {
  return fmt::format("{} as {} space{}", form.is_encoded ? "decoded from 0..1 and taken" : "taken",
                     word_for(form.space), form.axes == plain_axes ? "" : " with the axes " + in_words(form.axes));
}

/// Vectors longer than this are no unit vectors, whatever they were rounded to.
constexpr double longest_unit = 1.1, least_share_too_long = 0.1, most_spread_of_one_length = 0.05;
/// Normals of any length that agree better with the depth have directions that make sense.
constexpr double least_agreement_of_any_length = 0.95;

/// Of which range, by the lengths alone: vectors that are all of one length, or short enough.
bool may_be_unit(const std::vector<NormalPair>& pairs, bool is_encoded) {
  double too_long = 0, sum = 0, squares = 0;
  for (const NormalPair& pair : pairs) {
    const double length = glm::length(decoded(pair.stored, is_encoded));
    too_long += length > longest_unit;
    sum += length;
    squares += length * length;
  }
  const double n = double(pairs.size()), mean = sum / n, spread = std::sqrt(std::max(0.0, squares / n - mean * mean));
  return too_long < least_share_too_long * n || spread < most_spread_of_one_length * mean;
}

/// The flags that differ between two conventions, with their words for the first.
std::vector<std::string> differing_flags(const NormalForm& form, const NormalForm& other) {
  std::vector<std::string> flags;
  if (form.space != other.space) flags.push_back(option("normal-space", word_for(form.space)));
  if (form.is_encoded != other.is_encoded)
    flags.push_back(option("normal-range", form.is_encoded ? "unsigned" : "signed"));
  if (form.axes != other.axes) flags.push_back(option("normal-axes", in_words(form.axes)));
  return flags;
}

const Candidate& of_form(const std::vector<Candidate>& candidates, const NormalForm& form) {
  return *std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& c) { return c.form == form; });
}

/// Whether the surfaces are so nearly one plane that any normals of one direction can be turned to theirs.
bool face_one_way(const std::vector<NormalPair>& pairs) {
  dvec3 sum(0.0);
  for (const NormalPair& pair : pairs) sum += pair.from_depth;
  return glm::length(sum) > most_one_way * double(pairs.size());
}

/// Of normals that fit no convention, but would if all of them were turned: of which the camera's pose is likely wrong, and not they.
/// `best`: how well they fit a convention. Returns whether they are such.
bool note_turned(const Candidate& chosen, double best, const std::vector<NormalPair>& pairs,
                 const std::optional<Pose>& pose, std::vector<std::string>& notes) {
  if (face_one_way(pairs)) return false;
  const CommonTurn turn = any_turn(pairs, chosen.form, pose);
  if (turn.agreement < std::max(least_turned_agreement, best + least_gain_by_turn) ||
      !is_turned(chosen.agreement, turn))
    return false;
  const bool is_world = chosen.form.space == NormalSpace::world;
  const std::string likely =
      !pose ? fmt::format("they are likely in world space, and the camera's pose is unknown ({} gives it)",
                          option("camera"))
      : is_world
          ? fmt::format("the camera's pose is likely wrong, and not the normals ({} gives another)", option("camera"))
          : fmt::format("they are likely those of another camera ({} says where they are)", option("normal-space"));
  notes.push_back(
      fmt::format("normals: as {} space they agree with depth only to {:.2f}, and to {:.2f} if all were "
                  "turned by {:.0f} degrees: {}",
                  word_for(chosen.form.space), chosen.agreement, turn.agreement, turn.degrees, likely));
  return true;
}

/// Of normals that are those of no surface here, or hardly, in any convention.
bool note_strange(const Candidate& best, const std::vector<NormalPair>& pairs, std::vector<std::string>& notes) {
  if (best.agreement >= least_agreement || double(pairs.size()) < most_of_chance) return false;
  notes.push_back(
      fmt::format("normals: they agree with depth to {:.2f} at best, in any convention: are they of this frame? ({} "
                  "makes them from the depth)",
                  best.agreement, channels_option("normal", "none")));
  return true;
}

/// Without a pose, for normals of which nothing states the space.
NormalForm form_without_pose(const Candidate& chosen, const Candidate& plain, const std::vector<NormalPair>& pairs,
                             const StatedNormals& stated, std::vector<std::string>& notes) {
  const CommonTurn turn = small_turn(pairs, chosen.form, {});
  if (!are_in_view_space(chosen.agreement, turn)) {
    if (stated.expects_view) {
      if (!note_turned(plain, plain.agreement, pairs, {}, notes))
        notes.push_back(
            fmt::format("normals: taken as {} space, but they agree with depth only to {:.2f}: if they are in world "
                        "space, a camera with a pose is needed",
                        word_for(plain.form.space), plain.agreement));
      return plain.form;
    }
    notes.push_back(fmt::format("normals: taken as world space: as view space they agree with depth only to {:.2f}",
                                plain.agreement));
    return {NormalSpace::world, plain.form.is_encoded, plain.form.axes};
  }
  std::string more;
  if (chosen.form != plain.form)
    more = fmt::format(", as {} to {:.2f}; {} says otherwise", word_for(plain.form.space), plain.agreement,
                       fmt::join(differing_flags(plain.form, chosen.form), " "));
  else if (is_turned(chosen.agreement, turn))
    more = fmt::format(
        ", to {:.2f} if all were turned by {:.0f} degrees: they may be in world space, or the field of view may be "
        "another ({} gives both)",
        turn.agreement, turn.degrees, option("camera"));
  if (!stated.expects_view || chosen.form != plain.form)
    notes.push_back(fmt::format("normals: {}: they agree with depth to {:.2f}{}", taken_in_words(chosen.form),
                                chosen.agreement, more));
  return chosen.form;
}

/// For a camera with a pose, or normals whose space is stated.
void note_taken(const Candidate& chosen, const Candidate& plain, const std::vector<Candidate>& candidates,
                const StatedNormals& stated, std::vector<std::string>& notes) {
  const bool is_space_stated = stated.convention.space != NormalSpace::automatic;
  if (chosen.form.is_encoded != plain.form.is_encoded || chosen.form.axes != plain.form.axes ||
      (stated.expects_view && chosen.form != plain.form)) {
    notes.push_back(fmt::format("normals: {}: they agree with depth to {:.2f}, {} to {:.2f}; {} says otherwise",
                                taken_in_words(chosen.form), chosen.agreement, taken_in_words(plain.form),
                                plain.agreement, fmt::join(differing_flags(plain.form, chosen.form), " ")));
  } else if (!is_space_stated && !stated.expects_view) {
    NormalForm other = chosen.form;
    other.space = chosen.form.space == NormalSpace::world ? NormalSpace::view : NormalSpace::world;
    notes.push_back(
        fmt::format("normals: {}: they agree with depth to {:.2f}, as {} space to {:.2f}; {} says otherwise",
                    taken_in_words(chosen.form), chosen.agreement, word_for(other.space),
                    of_form(candidates, other).agreement, option("normal-space")));
  }
}

/// Of a convention that a statement rules out, or of normals that fit no convention but would if all were turned. Returns whether there is
/// anything to say. `better`: chosen of all candidates.
bool note_better(const Candidate& chosen, const Candidate& better, const std::vector<Candidate>& candidates,
                 const std::vector<NormalPair>& pairs, const std::optional<Pose>& pose, const StatedNormals& stated,
                 std::vector<std::string>& notes) {
  const double best = std::max(better.agreement, chosen.agreement);
  if (pose && note_turned(chosen, best, pairs, pose, notes)) return true;
  if (!clearly_beats(better, chosen, pairs, pose)) return note_strange(candidates.front(), pairs, notes);
  notes.push_back(
      fmt::format("normals: {}, as {} says, and agree with depth only to {:.2f}; {} to {:.2f}: {} states that",
                  taken_in_words(chosen.form), stated.by, chosen.agreement, taken_in_words(better.form),
                  better.agreement, fmt::join(differing_flags(better.form, chosen.form), " ")));
  return true;
}

}  // namespace

bool states_anything(const NormalConvention& convention) {
  return convention.space != NormalSpace::automatic || convention.range != NormalRange::automatic || convention.axes;
}

bool is_whole(const NormalConvention& convention) {
  return convention.space != NormalSpace::automatic && convention.range != NormalRange::automatic && convention.axes;
}

NormalConvention with_unstated(NormalConvention convention, const NormalConvention& more) {
  if (convention.space == NormalSpace::automatic) convention.space = more.space;
  if (convention.range == NormalRange::automatic) convention.range = more.range;
  if (!convention.axes) convention.axes = more.axes;
  return convention;
}

NormalConvention convention_of(const NormalForm& form) {
  return {form.space, form.is_encoded ? NormalRange::unsigned_values : NormalRange::signed_values, form.axes};
}

NormalForm plain_form(const NormalConvention& stated) {
  return {stated.space == NormalSpace::world ? NormalSpace::world : NormalSpace::view,
          stated.range == NormalRange::unsigned_values, stated.axes.value_or(plain_axes)};
}

NormalForm find_form(const std::vector<NormalPair>& pairs, const std::optional<Pose>& pose, const StatedNormals& stated,
                     std::vector<std::string>& notes) {
  NormalForm plain = plain_form(stated.convention);
  const bool is_space_stated = stated.convention.space != NormalSpace::automatic;
  if (pairs.empty() || (plain.space == NormalSpace::world && !pose)) {
    if (!is_space_stated && !stated.expects_view)
      notes.push_back("normals: taken as view space, as no pixel has both a normal and a depth to compare it with; " +
                      option("normal-space") + " says otherwise");
    return plain;
  }
  const std::vector<Candidate> candidates = candidates_of(pairs, pose, stated);
  std::vector<Candidate> allowed = candidates;
  std::erase_if(allowed, [&](const Candidate& c) { return !is_allowed(c.form, stated.convention); });
  const Candidate of_all = chosen_of(candidates, pairs, pose);
  const Candidate chosen = allowed.size() == candidates.size() ? of_all : chosen_of(allowed, pairs, pose);
  if (fit_no_convention(pairs, of_all.form, pose)) {
    notes.push_back(
        fmt::format("normals: they fit no convention: at best, {}, they agree with depth to {:.2f}, and their lengths "
                    "are neither 1 "
                    "nor alike",
                    taken_in_words(chosen.form), chosen.agreement));
    return chosen.form;
  }
  if (!is_space_stated && !stated.expects_view) plain.space = chosen.form.space;
  if (!pose && !is_space_stated) return form_without_pose(chosen, of_form(candidates, plain), pairs, stated, notes);
  if (!note_better(chosen, of_all, candidates, pairs, pose, stated, notes))
    note_taken(chosen, of_form(candidates, plain), candidates, stated, notes);
  return chosen.form;
}

bool fit_no_convention(const std::vector<NormalPair>& pairs, const NormalForm& form, const std::optional<Pose>& pose) {
  if (double(pairs.size()) < most_of_chance || may_be_unit(pairs, false) || may_be_unit(pairs, true)) return false;
  double agreement = 0;
  for (const NormalPair& pair : pairs) agreement += glm::dot(view_normal(pair.stored, form, pose), pair.from_depth);
  return agreement < least_agreement_of_any_length * double(pairs.size());
}

dvec3 view_normal(const dvec3& stored, const NormalForm& form, const std::optional<Pose>& pose) {
  const dvec3 given = unit_or_zero(decoded(stored, form.is_encoded));
  dvec3 normal(0.0);
  for (size_t i = 0; i < 3; ++i) normal[std::abs(form.axes[i]) - 1] = (form.axes[i] < 0 ? -1 : 1) * given[int(i)];
  return form.space == NormalSpace::world && pose ? pose->world_to_view * normal : normal;
}

}  // namespace gloam
