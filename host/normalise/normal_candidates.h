// All conventions in which normals may be stored, by how well they agree with the depth.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "normalise/normal_form.h"

namespace gloam {

/// A convention, how well it agrees with the depth, and how far it is from the plain one.
struct NormalCandidate {
  NormalForm form;
  double agreement = 0;  ///< mean cosine
  double departure = 0;
};

/// No convention is found in normals that agree less with the depth, as those of another frame do.
inline constexpr double least_agreement = 0.7;
inline constexpr NormalRange normal_ranges[] = {NormalRange::signed_values, NormalRange::unsigned_values,
                                                NormalRange::srgb_values};

/// A stored normal with its range undone.
glm::dvec3 decoded(const glm::dvec3& stored, NormalRange range);

/// Every convention with its agreement, the best first.
std::vector<NormalCandidate> candidates_of(const std::vector<NormalPair>& pairs, const std::optional<Pose>& pose,
                                           const StatedNormals& stated);

bool is_allowed(const NormalForm& form, const NormalConvention& stated);

/// Whether so many pairs say so clearly that the first convention is meant.
bool clearly_beats(const NormalCandidate& best, const NormalCandidate& other, const std::vector<NormalPair>& pairs,
                   const std::optional<Pose>& pose);

/// The plainest candidate that the best one does not clearly beat. `candidates`: the best first.
NormalCandidate chosen_of(std::vector<NormalCandidate> candidates, const std::vector<NormalPair>& pairs,
                          const std::optional<Pose>& pose);

const NormalCandidate& of_form(const std::vector<NormalCandidate>& candidates, const NormalForm& form);

}  // namespace gloam
