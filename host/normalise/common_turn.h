// Normals that would agree with the depth if all of them were turned alike.
#pragma once

#include <optional>
#include <vector>

#include "normalise/normal_form.h"

namespace gloam {

/// The turn that, applied to all normals, brings them nearest to those of the depth.
struct CommonTurn {
  double degrees = 0;
  double agreement = 0;   ///< of the turned normals
  double share_near = 0;  ///< of the pairs that the turn is of
};

/// A small turn, made of the pairs that lie near one another.
CommonTurn small_turn(const std::vector<NormalPair>& pairs, const NormalForm& form, const std::optional<Pose>& pose);
/// A turn of any size.
CommonTurn any_turn(const std::vector<NormalPair>& pairs, const NormalForm& form, const std::optional<Pose>& pose);

}  // namespace gloam
