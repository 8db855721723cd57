// In which convention normals are stored: what is stated of it, and what the depth shows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gloam/conventions.h"
#include "normalise/normal_samples.h"

namespace gloam {

/// The convention of normals, settled: nothing in it is `automatic`.
struct NormalForm {
  NormalSpace space = NormalSpace::view;
  NormalRange range = NormalRange::signed_values;
  NormalAxes axes = plain_axes;
  bool operator==(const NormalForm&) const = default;
};

/// What is stated, and by what, for notes: "--normal-space", "'WorldNormal'".
struct StatedNormals {
  NormalConvention convention;
  std::string by;
  /// Of normals in memory: world space has to fit clearly better than view space, and only what departs from it is worth a note.
  bool expects_view = false;
};

/// Whether every part of a convention is stated.
bool is_whole(const NormalConvention& convention);
/// Whether any part of a convention is stated.
bool states_anything(const NormalConvention& convention);
/// A convention with what it leaves open taken from another.
NormalConvention with_unstated(NormalConvention convention, const NormalConvention& more);
NormalConvention convention_of(const NormalForm& form);
/// What is stated, and plain view space where nothing is.
NormalForm plain_form(const NormalConvention& stated);

/// The convention in which the pairs agree: of those that nothing stated rules out, the plainest that no other one clearly beats. Appends
/// to `notes` a sentence on what is taken, and on a convention that agrees much better than any that is not ruled out. Without a pose,
/// normals are `view` if they agree as view-space normals do (0.9; a world turned little reaches 0.86), else `world`.
NormalForm find_form(const std::vector<NormalPair>& pairs, const std::optional<Pose>& pose, const StatedNormals& stated,
                     std::vector<std::string>& notes);

/// How far a convention is from the plain one.
double departure_of(const NormalForm& form);

/// The convention in which the pairs agree best, of those that nothing stated rules out; none if it rules out all.
std::optional<NormalForm> best_agreeing_form(const std::vector<NormalPair>& pairs, const std::optional<Pose>& pose,
                                             const NormalConvention& stated);

/// The mean cosine between the normals, read in that convention, and those of the depth.
double agreement_of(const std::vector<NormalPair>& pairs, const NormalForm& form, const std::optional<Pose>& pose);

/// Whether the normals fit no convention, of which `form` is the best: they agree poorly with the depth, and their lengths
/// are neither 1 nor alike.
bool fit_no_convention(const std::vector<NormalPair>& pairs, const NormalForm& form, const std::optional<Pose>& pose);

/// A stored normal brought to view space, unit; zero where it is none.
glm::dvec3 view_normal(const glm::dvec3& stored, const NormalForm& form, const std::optional<Pose>& pose);

}  // namespace gloam
