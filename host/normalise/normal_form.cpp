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
#include "normalise/normal_candidates.h"

namespace gloam {
namespace {

using glm::dmat3;
using glm::dvec3;

/// So few pairs may agree badly by chance.
constexpr double most_of_chance = 256;
const char* word_for(NormalRange range) {
  return range == NormalRange::srgb_values ? "srgb" : range == NormalRange::unsigned_values ? "unsigned" : "signed";
}

const char* range_in_words(NormalRange range) {
  if (range == NormalRange::signed_values) return "taken";
  return range == NormalRange::srgb_values ? "decoded from sRGB and 0..1 and taken" : "decoded from 0..1 and taken";
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
  return fmt::format("{} as {} space{}", range_in_words(form.range), word_for(form.space),
                     form.axes == plain_axes ? "" : " with the axes " + in_words(form.axes));
}

/// Vectors longer than this are no unit vectors, whatever they were rounded to.
constexpr double longest_unit = 1.1, least_share_too_long = 0.1, most_spread_of_one_length = 0.05;
/// Normals of any length that agree better with the depth have directions that make sense.
constexpr double least_agreement_of_any_length = 0.95;

/// Of which range, by the lengths alone: vectors that are all of one length, or short enough.
bool may_be_unit(const std::vector<NormalPair>& pairs, NormalRange range) {
  double too_long = 0, sum = 0, squares = 0;
  for (const NormalPair& pair : pairs) {
    const double length = glm::length(decoded(pair.stored, range));
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
  if (form.range != other.range) flags.push_back(option("normal-range", word_for(form.range)));
  if (form.axes != other.axes) flags.push_back(option("normal-axes", in_words(form.axes)));
  return flags;
}

/// Whether the surfaces are so nearly one plane that any normals of one direction can be turned to theirs.
bool face_one_way(const std::vector<NormalPair>& pairs) {
  dvec3 sum(0.0);
  for (const NormalPair& pair : pairs) sum += pair.from_depth;
  return glm::length(sum) > most_one_way * double(pairs.size());
}

/// Of normals that fit no convention, but would if all of them were turned: of which the camera's pose is likely wrong, and not they.
/// `best`: how well they fit a convention. Returns whether they are such.
bool note_turned(const NormalCandidate& chosen, double best, const std::vector<NormalPair>& pairs,
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
bool note_strange(const NormalCandidate& best, const std::vector<NormalPair>& pairs, std::vector<std::string>& notes) {
  if (best.agreement >= least_agreement || double(pairs.size()) < most_of_chance) return false;
  notes.push_back(
      fmt::format("normals: they agree with depth to {:.2f} at best, in any convention: are they of this frame? ({} "
                  "makes them from the depth)",
                  best.agreement, channels_option("normal", "none")));
  return true;
}

/// Without a pose, for normals of which nothing states the space.
NormalForm form_without_pose(const NormalCandidate& chosen, const NormalCandidate& plain,
                             const std::vector<NormalPair>& pairs, const StatedNormals& stated,
                             std::vector<std::string>& notes) {
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
    return {NormalSpace::world, plain.form.range, plain.form.axes};
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

/// "; or with the axes -x,y,z to 0.97, which may be meant as well", of the convention that agrees best, where one that is neither that nor plain is taken.
std::string better_in_words(const NormalCandidate& chosen, const NormalCandidate& best) {
  constexpr double least_better = 0.001;
  if (best.agreement < chosen.agreement + least_better) return "";
  return fmt::format("; {} to {:.3f}, which may be meant as well",
                     fmt::join(differing_flags(best.form, chosen.form), " "), best.agreement);
}

/// For a camera with a pose, or normals whose space is stated.
void note_taken(const NormalCandidate& chosen, const NormalCandidate& plain,
                const std::vector<NormalCandidate>& candidates, const StatedNormals& stated,
                std::vector<std::string>& notes) {
  const bool is_space_stated = stated.convention.space != NormalSpace::automatic;
  if (chosen.form.range != plain.form.range || chosen.form.axes != plain.form.axes ||
      (stated.expects_view && chosen.form != plain.form)) {
    notes.push_back(fmt::format("normals: {}: they agree with depth to {:.2f}, {} to {:.2f}; {} says otherwise",
                                taken_in_words(chosen.form), chosen.agreement, taken_in_words(plain.form),
                                plain.agreement, fmt::join(differing_flags(plain.form, chosen.form), " ")) +
                    better_in_words(chosen, candidates.front()));
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
bool note_better(const NormalCandidate& chosen, const NormalCandidate& better,
                 const std::vector<NormalCandidate>& candidates, const std::vector<NormalPair>& pairs,
                 const std::optional<Pose>& pose, const StatedNormals& stated, std::vector<std::string>& notes) {
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

NormalConvention convention_of(const NormalForm& form) { return {form.space, form.range, form.axes}; }

NormalForm plain_form(const NormalConvention& stated) {
  return {stated.space == NormalSpace::world ? NormalSpace::world : NormalSpace::view,
          stated.range == NormalRange::automatic ? NormalRange::signed_values : stated.range,
          stated.axes.value_or(plain_axes)};
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
  const std::vector<NormalCandidate> candidates = candidates_of(pairs, pose, stated);
  std::vector<NormalCandidate> allowed = candidates;
  std::erase_if(allowed, [&](const NormalCandidate& c) { return !is_allowed(c.form, stated.convention); });
  const NormalCandidate of_all = chosen_of(candidates, pairs, pose);
  const NormalCandidate chosen = allowed.size() == candidates.size() ? of_all : chosen_of(allowed, pairs, pose);
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

double agreement_of(const std::vector<NormalPair>& pairs, const NormalForm& form, const std::optional<Pose>& pose) {
  double sum = 0;
  for (const NormalPair& pair : pairs) sum += glm::dot(view_normal(pair.stored, form, pose), pair.from_depth);
  return sum / double(pairs.size());
}

bool fit_no_convention(const std::vector<NormalPair>& pairs, const NormalForm& form, const std::optional<Pose>& pose) {
  if (double(pairs.size()) < most_of_chance ||
      std::any_of(std::begin(normal_ranges), std::end(normal_ranges),
                  [&](NormalRange range) { return may_be_unit(pairs, range); }))
    return false;
  return agreement_of(pairs, form, pose) < least_agreement_of_any_length;
}

}  // namespace gloam
